#pragma once

#include <kte/dynamics/derivatives.hpp>
#include <kte/runtime_chain.hpp>

#ifdef KTE_FUNCTION
#  include <kte/kernels/eigen_decomposition.hpp>

#  include <Eigen/Cholesky>
#  include <Eigen/Eigenvalues>

#  include <algorithm>
#  include <cmath>
#  include <complex>
#  include <limits>
#  include <vector>
#endif

namespace kte {

/// Small motions about an equilibrium: sums of x = Re(shape exp(root t)), with shapes along the numbers of v, in
/// ascending order of frequency. Modes without a restoring force have frequency 0.
struct natural_modes_result {
  Eigen::VectorXd frequency;  ///< |root|, rad/s: the undamped frequency of the mode
  Eigen::VectorXd damping;    ///< damping ratio -Re(root)/|root|: below 1 oscillating, 1 overdamped, below 0 unstable
  Eigen::VectorXcd root;      ///< 1/s; for a conjugate pair the root with Im > 0
  Eigen::MatrixXcd shape;     ///< a column per mode; its largest number is 1
};

#ifdef KTE_FUNCTION
namespace detail {

/// Whether A + shift B has a Cholesky factorization without pivots lost in rounding.
inline bool is_well_positive(const Eigen::MatrixXd& a) {
  const Eigen::LLT<Eigen::MatrixXd> factors(a);
  if (factors.info() != Eigen::Success) return false;
  const Eigen::MatrixXd& l = factors.matrixLLT();
  for (Eigen::Index i = 0; i < a.rows(); ++i)
    if (!(l(i, i) * l(i, i) > 1e-11 * a(i, i))) return false;
  return true;
}
/// Undamped modes: columns x with x^T M x = 1, and squares of frequencies (negative for unstable directions of K).
struct undamped_modes {
  Eigen::MatrixXd shape;
  Eigen::VectorXd square;
};
/// Solves M x = m (K + shift M) x with m = 1/(w^2 + shift), largest m first, which gives low modes with full accuracy.
/// High modes use Rayleigh quotients. Directions without mass have m = 0 and no mode.
inline undamped_modes solve_undamped(const Eigen::MatrixXd& m, const Eigen::MatrixXd& k) {
  const Eigen::Index n = m.rows();
  Eigen::MatrixXd b = k;
  double shift = 0, least = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < n; ++i)
    if (k(i, i) > 0 && m(i, i) > 0) least = (std::min)(least, k(i, i) / m(i, i));
  for (int tries = 0; !is_well_positive(b); ++tries) {
    if (tries > 100)
      raise<no_solution>("kte: natural_modes: a direction has neither mass nor stiffness, or too little of both");
    shift = tries > 0 ? 10 * shift : std::isfinite(least) ? 1e-3 * least : 1;
    b = k + shift * m;
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> both(m, b);
  const Eigen::VectorXd& inverse = both.eigenvalues();
  const double epsilon = std::numeric_limits<double>::epsilon();
  Eigen::Index count = 0;
  while (count < n && inverse[n - 1 - count] > static_cast<double>(n) * epsilon * inverse[n - 1]) ++count;
  undamped_modes x{Eigen::MatrixXd(n, count), Eigen::VectorXd(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const double y = inverse[n - 1 - i];
    x.shape.col(i) = both.eigenvectors().col(n - 1 - i) / std::sqrt(y);
    x.square[i] = 1 / y - shift;
    if (y < std::sqrt(epsilon) * inverse[n - 1]) x.square[i] = x.shape.col(i).dot(k * x.shape.col(i));
    if (std::abs(x.square[i]) < 1e-9 * shift) x.square[i] = 0;
  }
  return x;
}
/// Roots and shapes in the space of the undamped modes. Modes that damping and forces without a potential do not couple
/// are unchanged. The others are those of the matrix  (0, 1; -K', -C').
inline void solve_damped(const undamped_modes& modes, const Eigen::MatrixXd& k, const Eigen::MatrixXd& c,
                         std::vector<std::complex<double>>& roots, std::vector<Eigen::VectorXcd>& shapes) {
  const Eigen::MatrixXd by_rate = modes.shape.transpose() * c * modes.shape;
  Eigen::MatrixXd stiff = modes.shape.transpose() * k * modes.shape;
  const double tiny = 1e-12 * (std::max)(by_rate.cwiseAbs().maxCoeff(), 1e-300);
  const double small_stiff = 1e-10 * (std::max)(stiff.cwiseAbs().maxCoeff(), 1e-300);
  std::vector<Eigen::Index> coupled;
  for (Eigen::Index i = 0; i < modes.square.size(); ++i) {
    stiff(i, i) = 0;
    const bool alone = by_rate.row(i).cwiseAbs().maxCoeff() <= tiny && by_rate.col(i).cwiseAbs().maxCoeff() <= tiny &&
                       stiff.row(i).cwiseAbs().maxCoeff() <= small_stiff &&
                       stiff.col(i).cwiseAbs().maxCoeff() <= small_stiff;
    if (!alone) {
      coupled.push_back(i);
      continue;
    }
    const double w = modes.square[i];
    roots.push_back(w >= 0 ? std::complex<double>(0, std::sqrt(w)) : std::complex<double>(std::sqrt(-w), 0));
    shapes.push_back(modes.shape.col(i).cast<std::complex<double>>());
  }
  const auto n = static_cast<Eigen::Index>(coupled.size());
  if (n == 0) return;
  Eigen::MatrixXd rates = Eigen::MatrixXd::Zero(2 * n, 2 * n), basis(modes.shape.rows(), n);
  rates.topRightCorner(n, n).setIdentity();
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index from = coupled[static_cast<std::size_t>(i)];
    basis.col(i) = modes.shape.col(from);
    for (Eigen::Index j = 0; j < n; ++j) {
      const Eigen::Index to = coupled[static_cast<std::size_t>(j)];
      rates(n + i, j) = i == j ? -modes.square[from] : std::abs(stiff(from, to)) > small_stiff ? -stiff(from, to) : 0;
      rates(n + i, n + j) = -by_rate(from, to);
    }
  }
  const eigen_decomposition all = eigen_decomposition_of(rates, true);
  for (Eigen::Index i = 0; i < 2 * n; ++i) {
    const std::complex<double> root = all.values[i];
    if (root.imag() < 0) continue;
    roots.push_back(root);
    shapes.push_back(basis * all.vectors.col(i).head(n));
  }
}

}  // namespace detail

/// The modes of M x'' + C x' + K x = 0; see `natural_modes`.
KTE_FUNCTION natural_modes_result natural_modes_of(const Eigen::MatrixXd& m, const Eigen::MatrixXd& k,
                                                   const Eigen::MatrixXd& c) {
  using namespace detail;
  std::vector<std::complex<double>> roots;
  std::vector<Eigen::VectorXcd> shapes;
  const Eigen::MatrixXd symmetric = 0.5 * (k + k.transpose());
  if (m.rows() > 0) {
    const undamped_modes modes = solve_undamped(m, symmetric);
    if (modes.square.size() < m.rows() && c.cwiseAbs().maxCoeff() > 0)
      raise<singular_mass_matrix>(
          "kte: natural_modes: damped modes need masses that move with every degree of freedom");
    solve_damped(modes, k, c, roots, shapes);
  }
  std::vector<std::size_t> order(roots.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&roots](std::size_t i, std::size_t j) { return std::abs(roots[i]) < std::abs(roots[j]); });
  const auto n = static_cast<Eigen::Index>(order.size());
  natural_modes_result x{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXcd(n), Eigen::MatrixXcd(m.rows(), n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t from = order[static_cast<std::size_t>(i)];
    x.root[i] = roots[from];
    x.frequency[i] = std::abs(roots[from]);
    x.damping[i] = x.frequency[i] > 0 ? -roots[from].real() / x.frequency[i] : 0;
    Eigen::Index largest = 0;
    shapes[from].cwiseAbs().maxCoeff(&largest);
    x.shape.col(i) = shapes[from] / shapes[from][largest];
  }
  return x;
}
#else
[[nodiscard]] natural_modes_result natural_modes_of(const Eigen::MatrixXd& m, const Eigen::MatrixXd& k,
                                                    const Eigen::MatrixXd& c);
#endif

namespace detail {
/// Throws `bad_argument` if forces would move the chain by more than 1e-6 rad or m.
template <class Derived, class Layout>
const Derived& check_at_rest(const Derived& d, const Layout& layout) {
  for (Eigen::Index i = 0; i < d.tau.size(); ++i)
    if (!(std::abs(d.tau[i]) <= 1e-6 * d.by_q.row(i).cwiseAbs().sum()))
      raise<bad_argument>("kte: natural_modes: the chain is not in equilibrium, '" +
                          std::string(name_of_row(layout, static_cast<int>(i))) + "' is held by " + number(d.tau[i]) +
                          "; see static_equilibrium");
  return d;
}
}  // namespace detail

/// Natural frequencies, damping ratios and shapes of small motions about an equilibrium q,
///
///   M x'' + C x' + K x = 0,   K, C, M: derivatives of inverse dynamics by q, v and a at rest          (1)
///
/// Without damping, n modes of the generalized symmetric eigenproblem. With damping, or with forces without a
/// potential, modes of the 2 n roots of the quadratic eigenproblem: one mode per conjugate pair, one per real root.
/// Degrees of freedom that move no mass follow the others. K is the tangent under the inputs of the state. Dense
/// matrices: O(n^3).
///
///   const auto modes = kte::natural_modes(beam, s, r.q);
///   modes.frequency[0] / (2 * std::numbers::pi)  // Hz
///
/// Throws `bad_argument` if q is not an equilibrium, `singular_mass_matrix` for degrees of freedom without mass if
/// there is damping, `no_solution` for degrees of freedom without mass and stiffness.
template <indexable Q>
natural_modes_result natural_modes(const runtime_chain& c, runtime_state& s, const Q& q) {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(s.dofs());
  const auto& d = detail::check_at_rest(inverse_dynamics_derivatives(c, s, q, none, none), detail::layout_of_state(s));
  return natural_modes_of(d.by_a, d.by_q, d.by_v);
}
/// The natural modes of a static chain, with inputs 0.
template <class Gravity, class... E, indexable Q>
[[nodiscard]] natural_modes_result natural_modes(const static_chain<Gravity, E...>& c, const Q& q) {
  const joint_vector<double, static_chain<Gravity, E...>::dofs> none =
      joint_vector<double, static_chain<Gravity, E...>::dofs>::Zero();
  const auto d = inverse_dynamics_derivatives(c, q, none, none);
  detail::check_at_rest(d, layout(c));
  return natural_modes_of(d.by_a, d.by_q, d.by_v);
}

}  // namespace kte
