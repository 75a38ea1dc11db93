#pragma once

#include <kte/errors.hpp>
#include <kte/kernels/eigen_decomposition.hpp>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <cmath>
#include <complex>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>

/// Algebraic Riccati equations, see control/riccati.hpp. Real numbers only, because Eigen's complex decompositions take
/// a minute to compile.
namespace kte::detail {

inline Eigen::MatrixXd symmetric_part(const Eigen::MatrixXd& m) { return (m + m.transpose()) / 2; }
/// A bound of the rounding errors in an n x n matrix of this norm.
inline double rounding_of(Eigen::Index n, double norm) {
  return 16 * static_cast<double>(n) * std::numeric_limits<double>::epsilon() * norm;
}
inline std::string text_of(const std::complex<double>& z) {
  char both[80];
  std::snprintf(both, sizeof both, "%.6g %+.6gi", z.real(), z.imag());
  return both;
}
/// The smallest pivot of a complex matrix re + i im, which is small if the rank is not full.
inline double smallest_pivot(const Eigen::MatrixXd& re, const Eigen::MatrixXd& im) {
  Eigen::MatrixXd both(2 * re.rows(), 2 * re.cols());
  both << re, -im, im, re;
  return Eigen::FullPivLU<Eigen::MatrixXd>(both).matrixLU().diagonal().cwiseAbs().minCoeff();
}
inline Eigen::VectorXcd eigenvalues_of(const Eigen::MatrixXd& m) { return eigen_decomposition_of(m, false).values; }

/// A balanced problem without N. With R = L L',
///
///   G = B R^-1 B',   A - B R^-1 N',   Q - N R^-1 N'          (1)
///
/// in coordinates D^-1 x, where D consists of powers of two that balance rows and columns of the Hamiltonian matrix:
///
///   D^-1 A D,   D^-1 G D^-1,   D Q D,   X = D^-1 X_balanced D^-1
struct riccati_problem {
  std::string name;
  Eigen::MatrixXd A, G, Q;
  Eigen::VectorXd D;

  /// `least`: refuses costs without a minimum.
  riccati_problem(const char* who, const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, const Eigen::MatrixXd& q,
                  const Eigen::MatrixXd& r, const Eigen::MatrixXd& n, bool least = false)
      : name(std::string("kte: ") + who + ": ") {
    const Eigen::Index states = a.rows(), inputs = b.cols();
    const auto fits = [this](const Eigen::MatrixXd& m, Eigen::Index rows, Eigen::Index cols, const char* what) {
      if (m.rows() != rows || m.cols() != cols)
        raise<bad_argument>(name + what + " is " + std::to_string(m.rows()) + " x " + std::to_string(m.cols()) +
                            ", not " + std::to_string(rows) + " x " + std::to_string(cols));
      if (!m.allFinite()) raise<bad_argument>(name + "a number of " + what + " is not finite");
    };
    const bool mixed = n.size() != 0;
    if (states == 0 || inputs == 0) raise<bad_argument>(name + "there are no states, or no inputs");
    fits(a, states, states, "A"), fits(b, states, inputs, "B"), fits(q, states, states, "Q");
    fits(r, inputs, inputs, "R");
    if (mixed) fits(n, states, inputs, "N");
    check_symmetric(q, "Q"), check_symmetric(r, "R");
    const Eigen::LLT<Eigen::MatrixXd> factors(symmetric_part(r));
    if (factors.info() != Eigen::Success) raise<bad_argument>(name + "R is not positive definite");
    const auto by_root = [&](const Eigen::MatrixXd& m) {  // m L^-T
      return Eigen::MatrixXd(factors.matrixL().solve(m.transpose()).transpose());
    };
    const Eigen::MatrixXd bs = by_root(b);
    A = a, G = bs * bs.transpose(), Q = symmetric_part(q);
    if (mixed) {
      const Eigen::MatrixXd ns = by_root(n);
      A -= bs * ns.transpose(), Q -= ns * ns.transpose();  // (1)
    }
    if (!A.allFinite() || !G.allFinite() || !Q.allFinite())
      raise<bad_argument>(name + "B R^-1 B' is too large: R is nearly singular");
    if (least && !(Q.ldlt().vectorD().minCoeff() >= -rounding_of(states, q.norm())))
      raise<bad_argument>(name + (mixed ? "Q - N R^-1 N'" : "Q") + " is not positive semidefinite");
    balance();
  }
  Eigen::MatrixXd unbalanced(const Eigen::MatrixXd& x) const {
    const Eigen::VectorXd inverse = D.cwiseInverse();
    return symmetric_part(inverse.asDiagonal() * x * inverse.asDiagonal());
  }
  Eigen::Index size() const { return A.rows(); }

  /// Throws `no_solution` if inputs do not reach an eigenvalue z of A that does not decay: rank [A - z, G] < n, up to
  /// `tolerance` (Popov, Belevitch, Hautus).
  template <class Stays>
  void refuse_unreached(const Stays& stays, double tolerance) const {
    Eigen::MatrixXd re(size(), 2 * size()), im = Eigen::MatrixXd::Zero(size(), 2 * size());
    for (const std::complex<double>& z : eigenvalues_of(A)) {
      if (!stays(z)) continue;
      re << A, G;
      re.diagonal().array() -= z.real();
      im.diagonal().setConstant(-z.imag());
      if (smallest_pivot(re, im) <= tolerance) [[unlikely]]
        raise<no_solution>(name + "(A, B) is not stabilisable: inputs do not reach the mode of A with the eigenvalue " +
                           text_of(z));
    }
  }
  /// Throws `no_solution` with the reason.
  template <class Stays>
  [[noreturn]] void fail(const Stays& stays, const std::string& why) const {
    const double root = std::sqrt(std::numeric_limits<double>::epsilon());
    refuse_unreached(stays, root * (A.norm() + G.norm()));
    raise<no_solution>(name + why + ", for example because Q does not weight a mode that neither grows nor decays");
  }

 private:
  void check_symmetric(const Eigen::MatrixXd& m, const char* what) const {
    if ((m - m.transpose()).cwiseAbs().maxCoeff() > rounding_of(m.rows(), m.cwiseAbs().maxCoeff()))
      raise<bad_argument>(name + what + " is not symmetric");
  }
  void balance() {
    D.setOnes(size());
    bool changes = true;
    for (int sweep = 0; changes && sweep < 20; ++sweep) {
      changes = false;
      for (Eigen::Index i = 0; i < size(); ++i) {
        const double diagonal = std::abs(A(i, i));
        const double grows = A.col(i).cwiseAbs().sum() - diagonal + Q.row(i).cwiseAbs().sum();
        const double falls = A.row(i).cwiseAbs().sum() - diagonal + G.row(i).cwiseAbs().sum();
        if (!(grows > 0) || !(falls > 0)) continue;
        const int power = static_cast<int>(std::lround(std::log2(falls / grows) / 4));
        if (power == 0) continue;
        const double f = std::ldexp(1.0, power);
        A.col(i) *= f, A.row(i) /= f;
        Q.col(i) *= f, Q.row(i) *= f;
        G.col(i) /= f, G.row(i) /= f;
        D[i] *= f;
        changes = true;
      }
    }
  }
};

/// Solves X = A'X (1 + G X)^-1 A + Q by structured doubling; empty if it does not converge.
inline std::optional<Eigen::MatrixXd> by_doubling(Eigen::MatrixXd a, Eigen::MatrixXd g, Eigen::MatrixXd x) {
  const Eigen::Index n = a.rows();
  for (int i = 0; i < 60 && x.allFinite(); ++i) {
    const Eigen::PartialPivLU<Eigen::MatrixXd> w(Eigen::MatrixXd::Identity(n, n) + g * x);
    const Eigen::MatrixXd wa = w.solve(a), wg = w.solve(g);
    const Eigen::MatrixXd change = symmetric_part(a.transpose() * x * wa);
    g = symmetric_part(g + a * wg * a.transpose());
    a = (a * wa).eval();
    x += change;
    if (change.norm() <= rounding_of(n, x.norm()) / 64) return x;
  }
  return {};
}
/// Solves A'X + X A - X G X + Q = 0 by the equivalent problem in discrete time, with structured doubling,
///
///   W = (A - c)' + Q (A - c)^-1 G,   1 + 2c W^-T,   2c (A - c)^-1 G W^-1,   2c W^-1 Q (A - c)^-1          (2)
///
/// with c large enough that A - c and W are regular (Chu, Fan and Lin, Linear Algebra Appl. 396, 2005).
inline std::optional<Eigen::MatrixXd> by_cayley_doubling(const Eigen::MatrixXd& a, const Eigen::MatrixXd& g,
                                                         const Eigen::MatrixXd& q) {
  const Eigen::Index n = a.rows();
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(n, n);
  const double c = a.norm() + 2 * std::sqrt(g.norm() * q.norm());
  const Eigen::MatrixXd inverse = Eigen::PartialPivLU<Eigen::MatrixXd>(a - c * one).inverse();
  const Eigen::MatrixXd w = (a - c * one).transpose() + q * inverse * g;
  const Eigen::MatrixXd twice = 2 * c * Eigen::PartialPivLU<Eigen::MatrixXd>(w).inverse();
  return by_doubling(one + twice.transpose(), symmetric_part(inverse * g * twice), symmetric_part(twice * q * inverse));
}

inline Eigen::MatrixXd solve_continuous(const riccati_problem& p) {
  const Eigen::Index n = p.size();
  const auto stays = [&](const std::complex<double>& z) { return z.real() >= -rounding_of(n, p.A.norm()); };
  p.refuse_unreached(stays, rounding_of(n, p.A.norm() + p.G.norm()));
  Eigen::MatrixXd h(2 * n, 2 * n);
  h << p.A, -p.G, -p.Q, -p.A.transpose();
  const std::string axis = "the Hamiltonian matrix has, up to rounding, an eigenvalue on the imaginary axis";
  const double norm = h.norm(), close = 8 * std::sqrt(std::numeric_limits<double>::epsilon()) * norm;
  for (const std::complex<double>& z : eigenvalues_of(h))
    if (std::abs(z.real()) <= close &&
        smallest_pivot(h, -z.imag() * Eigen::MatrixXd::Identity(2 * n, 2 * n)) <= rounding_of(2 * n, norm))
      p.fail(stays, axis + ", " + text_of({0, z.imag()}));
  auto x = by_cayley_doubling(p.A, p.G, p.Q);
  if (!x) p.fail(stays, axis);
  // Newton-Kleinman: A_c' E + E A_c = -residual(X), next X + E
  Eigen::MatrixXd best = *x;
  for (double last = std::numeric_limits<double>::infinity(); x;) {
    const Eigen::MatrixXd closed = p.A - p.G * *x;
    const Eigen::MatrixXd residual = symmetric_part(p.Q + *x * closed + p.A.transpose() * *x);
    const double size = residual.norm();
    if (!(size < last)) break;
    if (!(eigenvalues_of(closed).real().maxCoeff() < 0)) p.fail(stays, axis);
    best = *x;
    if (!(size < last / 2) || size == 0) break;
    last = size;
    x = by_cayley_doubling(closed, Eigen::MatrixXd::Zero(n, n), residual);
    if (x) *x += best;
  }
  return p.unbalanced(best);
}

inline Eigen::MatrixXd solve_discrete(const riccati_problem& p) {
  const Eigen::Index n = p.size();
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(n, n);
  const auto stays = [&](const std::complex<double>& z) { return std::abs(z) >= 1 - rounding_of(n, p.A.norm()); };
  p.refuse_unreached(stays, rounding_of(n, p.A.norm() + p.G.norm()));
  const std::string circle = "the symplectic pencil has, up to rounding, an eigenvalue on the unit circle";
  const auto x = by_doubling(p.A, p.G, p.Q);
  if (!x) p.fail(stays, circle);
  Eigen::MatrixXd m(2 * n, 2 * n), l(2 * n, 2 * n);
  m << p.A, Eigen::MatrixXd::Zero(n, n), -p.Q, one;
  l << one, p.G, Eigen::MatrixXd::Zero(n, n), p.A.transpose();
  const double norm = m.norm() + l.norm(), close = 8 * std::sqrt(std::numeric_limits<double>::epsilon()) * norm;
  for (const std::complex<double>& z :
       eigenvalues_of(Eigen::PartialPivLU<Eigen::MatrixXd>(one + p.G * *x).solve(p.A))) {
    const double size = std::abs(z);
    if (size < 0.5 || size < 1 - close) continue;
    const std::complex<double> at = z / size;
    if (!(size < 1) || smallest_pivot(m - at.real() * l, -at.imag() * l) <= rounding_of(2 * n, norm))
      p.fail(stays, circle + ", " + text_of(at));
  }
  return p.unbalanced(*x);
}

}  // namespace kte::detail
