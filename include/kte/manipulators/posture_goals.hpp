#pragma once

#include <kte/dynamics/configuration_space.hpp>
#include <kte/manipulators/detail/goal_sums.hpp>

#include <cmath>
#include <vector>

namespace kte {

namespace detail {
/// e_i = w_i (q_desired - q)_i, in the tangent space of the configuration.
template <class Numbers>
struct posture_goal {
  static constexpr bool hard = false;
  Numbers wanted;
  std::vector<double> weights;  // of squares; empty: all 1

  template <class At, class Sum>
  void add_to(const At& at, Sum& sum) const {
    using S = typename At::scalar;
    typename At::configuration to(at.q.size());
    check_size(static_cast<std::size_t>(at.q.size()), wanted, "a desired posture", "numbers of a configuration");
    for (Eigen::Index i = 0; i < to.size(); ++i) to[i] = S(wanted[static_cast<std::size_t>(i)]);
    const auto e = difference(at.arm, at.q, to);
    if (!weights.empty()) check_size(static_cast<std::size_t>(e.size()), weights, "weights of a posture");
    for (Eigen::Index i = 0; i < e.size(); ++i)
      sum(S(e[i]), weights.empty() ? S(1) : S(weights[static_cast<std::size_t>(i)]),
          [i](Eigen::Index k) { return k == i ? S(1) : S(0); });
  }
};

/// e_i = (middle_i - q_i)/(half range)_i, for coordinates with both limits.
struct away_from_limits_goal {
  static constexpr bool hard = false;
  template <class At, class Sum>
  void add_to(const At& at, Sum& sum) const {
    using S = typename At::scalar;
    const auto& limits = at.arm.limits();
    for_each_freedom_of(at.arm, [&](const freedom& f) {
      const auto i = static_cast<std::size_t>(f.v);
      const S half = S(limits.upper[i] - limits.lower[i]) / S(2), middle = S(limits.upper[i] + limits.lower[i]) / S(2);
      if (f.what != kind::gen || !(half > S(0)) || half - half != S(0)) return;
      sum(S((middle - at.q[f.q]) / half), S(1), [&](Eigen::Index k) { return k == f.v ? S(S(1) / half) : S(0); });
    });
  }
};

/// e = -1/(1 + m), m = sqrt(det(J W J^T)) (Yoshikawa, Int. J. of Robotics Research 4, 1985), or with J^T W J if there
/// are fewer coordinates than rows. W scales rad to lengths. Derivatives of m are central differences.
struct manipulability_goal {
  static constexpr bool hard = false;
  template <class J, class S>
  static S measure(const J& j, const S& length) {
    const bool wide = j.cols() >= j.rows();
    const Eigen::Index n = wide ? j.rows() : j.cols();
    Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> gram(n, n);
    for (Eigen::Index a = 0; a < n; ++a)
      for (Eigen::Index b = 0; b <= a; ++b) {
        S sum(0);
        const auto unit = [&](Eigen::Index r) { return r % 6 < 3 ? S(1) : length; };
        if (wide)
          for (Eigen::Index k = 0; k < j.cols(); ++k) sum += j(a, k) * j(b, k) * unit(a) * unit(b);
        else
          for (Eigen::Index r = 0; r < j.rows(); ++r) sum += j(r, a) * j(r, b) * unit(r) * unit(r);
        gram(a, b) = sum;
      }
    S product(1);  // of the diagonal of the Cholesky factor
    for (Eigen::Index a = 0; a < n; ++a) {
      for (Eigen::Index b = 0; b <= a; ++b) {
        for (Eigen::Index k = 0; k < b; ++k) gram(a, b) -= gram(a, k) * gram(b, k);
        if (b < a) gram(a, b) /= gram(b, b);
      }
      if (!(gram(a, a) > S(0))) return S(0);
      using std::sqrt;
      product *= gram(a, a) = sqrt(gram(a, a));
    }
    return product;
  }
  template <class At, class Sum>
  void add_to(const At& at, Sum& sum) const {
    using S = typename At::scalar;
    const S m = measure(at.arm.getJacobianMatrix(at.q), at.length);
    using std::cbrt;
    const S step = cbrt(std::numeric_limits<S>::epsilon());
    const auto moved = [&](Eigen::Index k, const S& by) {
      joint_vector<S, At::n> v = joint_vector<S, At::n>::Zero(static_cast<Eigen::Index>(dofs_of(at.arm)));
      v[k] = by;
      return measure(at.arm.getJacobianMatrix(integrate(at.arm, at.q, v, S(1))), at.length);
    };
    sum(S(S(-1) / (S(1) + m)), S(1), [&](Eigen::Index k) {
      return (moved(k, S(-step)) - moved(k, step)) / (S(2) * step * (S(1) + m) * (S(1) + m));
    });
  }
};
}  // namespace detail

/// A soft goal of `numerical_inverse_kinematics`: a configuration near q. `weights` of the squares, one for each number
/// of v, or empty.
template <indexable Q>
[[nodiscard]] auto posture(const Q& q, std::vector<double> weights = {}) {
  return detail::posture_goal<Q>{q, std::move(weights)};
}
/// A soft goal: coordinates near the middle of their limits.
[[nodiscard]] inline auto away_from_limits() { return detail::away_from_limits_goal{}; }
/// A soft goal: far from singular configurations, by the manipulability measure of Yoshikawa.
[[nodiscard]] inline auto manipulability() { return detail::manipulability_goal{}; }

}  // namespace kte
