#pragma once

#include <kte/math/pack.hpp>

#include <Eigen/Core>

#include <vector>

namespace kte::detail {

/// A contact of friction problems in packs S: numbers that are 1 or 0 tell the modes of lanes.
template <class S>
struct friction_contact_in_lanes {
  int first = 0, rows = 3;  ///< its rows (n, t_1, t_2), in the plane (n, t_1)
  S friction;
  S closed;  ///< 1: it is closed, otherwise open
  S slides;  ///< 1: it slides along t_1, or has no friction; otherwise it sticks
};

/// Friction problems u' = W lambda + b in packs S, one in each lane, in modes that are given. One elimination, without
/// exchange of rows, solves the equations of all lanes:
///
///   open        lambda = 0                                    (1)
///   slides      u_n' = 0,   lambda_t = (-mu lambda_n, 0)      (2)
///   sticks      u' = 0                                        (3)
///
/// They solve the problem of a lane if lambda_n > 0, and |lambda_t| < mu lambda_n where contacts stick.
template <class S>
class friction_in_lanes {
 public:
  using contact = friction_contact_in_lanes<S>;
  using matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  using vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  static constexpr double tolerance = 1e-12;  ///< of the residual, relative, as for friction_solver

  /// Writes lambda. Returns 1 in lanes whose problem it solves. Others do not satisfy the laws, have several solutions,
  /// or equations that are nearly singular or badly scaled.
  template <class W, class B, class Lambda>
  S solve(const W& w, const B& b, const std::vector<contact>& contacts, Lambda& lambda) {
    const auto n = b.size();
    a_.resize(n, n), x_.resize(n), inverse_.resize(n);
    S trace(0), most(0), least(0);
    for (Eigen::Index k = 0; k < n; ++k) trace += w(k, k);
    bool symmetric = true;
    auto good = S(0) == S(0);
    for (const auto& c : contacts) {
      const auto closed = c.closed > S(0.5), slides = c.slides > S(0.5);
      symmetric = symmetric && all(closed) && !any(slides);
      const S own = select(closed, w(c.first, c.first), most);
      most = max(most, own), least = select(closed & ((own < least) | (least == S(0))), own, least);
      // W_nn - mu W_nt <= 0: sliding may be jammed, or have several solutions (Painleve)
      good &= (w(c.first, c.first) > c.friction * w(c.first, c.first + 1)) | !(closed & slides);
    }
    good &= most <= S(1e4) * least;
    for (const auto& c : contacts) put_equations(w, b, c);
    good &= eliminate(symmetric, trace * S(1e-7 / static_cast<double>(n)));
    for (Eigen::Index k = n; k-- > 0;) {
      S sum = x_[k];
      for (Eigen::Index j = k + 1; j < n; ++j) sum -= a_(j, k) * lambda[j];
      lambda[k] = sum * inverse_[k];
    }
    good &= satisfies_laws(contacts, lambda) & (residual(w, b, contacts, lambda) <= S(tolerance));
    return select(good, S(1), S(0));
  }

 private:
  using mask = typename S::mask;
  /// Row i of the equations is column i of `a_`.
  template <class W, class B>
  void put_equations(const W& w, const B& b, const contact& c) {
    const auto closed = c.closed > S(0.5), slides = c.slides > S(0.5);
    const auto n = a_.rows();
    for (int k = 0; k < c.rows; ++k) {
      const Eigen::Index i = c.first + k;
      const auto of_motion = k == 0 ? closed : closed & !slides;
      if (all(of_motion)) {
        for (Eigen::Index j = 0; j < n; ++j) a_(j, i) = w(j, i);
        x_[i] = -b[i];
        continue;
      }
      for (Eigen::Index j = 0; j < n; ++j) a_(j, i) = select(of_motion, w(j, i), S(0));
      a_(i, i) = w(i, i), x_[i] = select(of_motion, -b[i], S(0));
      if (k == 1) a_(c.first, i) = select(closed & slides, c.friction * w(i, i), a_(c.first, i));
    }
  }
  /// Returns the lanes whose pivots are above `least`.
  mask eliminate(bool symmetric, const S& least) {
    const auto n = a_.rows();
    mask good = S(0) == S(0);
    for (Eigen::Index k = 0; k < n; ++k) {
      const S* const own = &a_(0, k);
      good &= own[k] > least;
      inverse_[k] = S(1) / own[k];
      for (Eigen::Index i = k + 1; i < n; ++i) {
        S* const to = &a_(0, i);
        const S factor = (symmetric ? own[i] : to[k]) * inverse_[k];
        for (Eigen::Index j = symmetric ? i : k + 1; j < n; ++j) to[j] -= factor * own[j];
        x_[i] -= factor * x_[k];
      }
    }
    return good;
  }
  template <class Lambda>
  static mask satisfies_laws(const std::vector<contact>& contacts, const Lambda& lambda) {
    S largest(0);
    for (const auto& c : contacts) largest = max(largest, lambda[c.first]);
    mask good = S(0) == S(0);
    for (const auto& c : contacts) {
      const auto closed = c.closed > S(0.5), sticks = closed & !(c.slides > S(0.5));
      const S normal = lambda[c.first], t1 = lambda[c.first + 1], t2 = c.rows == 3 ? lambda[c.first + 2] : S(0);
      good &= (normal > S(1e-10) * largest) | !closed;
      good &= (sqrt(t1 * t1 + t2 * t2) < c.friction * normal * S(1 - 1e-9)) | !sticks;
    }
    return good;
  }
  /// The largest u' that must be zero, as a change of lambda, relative to the largest force.
  template <class W, class B, class Lambda>
  static S residual(const W& w, const B& b, const std::vector<contact>& contacts, const Lambda& lambda) {
    S scale(0), worst(0);
    for (const auto& c : contacts) {
      const auto closed = c.closed > S(0.5), sticks = closed & !(c.slides > S(0.5));
      for (int k = 0; k < c.rows; ++k) {
        const Eigen::Index i = c.first + k;
        S u = b[i];
        for (Eigen::Index j = 0; j < b.size(); ++j) u += w(j, i) * lambda[j];
        const auto counts = k == 0 ? closed : sticks;
        scale = max(scale, select(counts, max(abs(lambda[i]), abs(S(b[i] / w(i, i)))), S(0)));
        worst = max(worst, select(counts, abs(S(u / w(i, i))), S(0)));
      }
    }
    return worst / select(scale > S(0), scale, S(1));
  }

  matrix a_;            ///< equations, a column each
  vector x_, inverse_;  ///< right sides; 1/pivots
};

}  // namespace kte::detail
