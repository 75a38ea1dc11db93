#pragma once

#include <kte/manipulators/box_quadratic_program.hpp>
#include <kte/manipulators/detail/arm_coordinates.hpp>
#include <kte/manipulators/rate_bounds.hpp>

namespace kte {

/// Weights of `rates_towards`.
struct rate_options {
  double length = 0.3;    ///< l of (1), m: m/s per rad/s
  double damping = 1e-6;  ///< eps of (1), relative to the largest diagonal element of J^T W J; positive
};

/// How limits affect the rates.
enum class rate_status {
  free,       ///< no coordinate is at a bound: the tools move as desired, as far as J permits
  limited,    ///< some coordinates are at bounds of their rates
  recovering  ///< some are outside their limits, or were too fast to keep them: they brake or return at full
              ///< acceleration
};

/// The result of `rates_towards`, with the `status`.
template <class S, int N>
struct rate_step {
  joint_vector<S, N> v;                       ///< for q' = integrate(arm, q, v, dt)
  Eigen::Matrix<signed char, N, 1> at_bound;  ///< -1, 1: held by the lower or upper bound of its rate; 0: free
  rate_status status;
  S linear, angular;  ///< largest errors |J v - twist| of the tools, m/s and rad/s
};

namespace detail {
/// Computes the bounds of the rates of all coordinates; returns whether some are recovering.
template <class S, class Arm, class Q, class V, int N>
bool put_rate_bounds(const Arm& arm, const Q& q, const V& v_now, const S& dt, joint_vector<S, N>& lower,
                     joint_vector<S, N>& upper) {
  const auto& limits = arm.limits();
  bool recovering = false;
  for_each_freedom_of(arm, [&](const freedom& f) {
    for (int k = 0; k < nv_of(f.what); ++k) {
      const auto i = static_cast<std::size_t>(f.v + k);
      const bool number = f.what == kind::gen;  // other coordinates have no position limits
      const auto b = rate_bounds(number ? S(q[static_cast<std::size_t>(f.q)]) : S(0), S(v_now[i]), S(limits.lower[i]),
                                 S(limits.upper[i]), S(limits.rate[i]), S(limits.acceleration[i]), dt);
      lower[f.v + k] = b.lower, upper[f.v + k] = b.upper, recovering |= b.recovering;
    }
  });
  return recovering;
}
}  // namespace detail

/// One step of differential inverse kinematics: the rates v that bring the twists of the tools closest to the desired
/// ones, within the limits of positions, rates and accelerations (`rate_bounds`). The next configuration is
/// integrate(arm, q, v, dt). Limits of jerk and effort are ignored.
///
///   minimize  |J v - twist|_W^2 + eps |v - v_desired|^2,   lower <= v <= upper,   W = (1, 1, 1, l^2, l^2, l^2)     (1)
///
/// `twist`: velocity and angular velocity of each tool, at its origin in axes of the world, as in
/// `getDependentVelocities`. v_now: the rates of the previous step. `v_desired`, 0 if omitted: the desired rates in the
/// null space of the tools, with weight eps. To return to a path, add K e to the twist, with e of `pose_error`. A
/// solution always exists. Throws `bad_argument` for arguments that are not finite or of wrong size and for dt <= 0,
/// `bad_parameter` for position limits of a rotation or pose. Nothing is allocated for static chains.
template <class Arm, indexable Q, indexable V, indexable T, indexable W>
[[nodiscard]] auto rates_towards(const Arm& arm, const Q& q, const V& v_now, const T& twist, value_of<Q> dt,
                                 const rate_options& options, const W& v_desired) {
  using S = value_of<Q>;
  constexpr int n = detail::arm_dofs<Arm>;
  const auto size = detail::dofs_of(arm);
  const Eigen::Index m = static_cast<Eigen::Index>(size);
  detail::check_twists_of(arm, twist, "twist", "a twist");
  detail::check_rates_of(arm, v_now, "v_now", "a rate");
  detail::check_rates_of(arm, v_desired, "v_desired", "a desired rate");
  if (!(dt > S(0)) || !(dt - dt == S(0)))
    detail::raise<bad_argument>("kte: the time dt of a step must be finite and positive");
  for (const double x : {options.length, options.damping})
    if (!(x > 0 && x <= (std::numeric_limits<double>::max)()))
      detail::raise<bad_argument>("kte: length and damping of rates must be finite and positive, got " +
                                  detail::number(x));
  detail::check_limits_of_poses(arm);

  const auto j = arm.getJacobianMatrix(q);
  joint_matrix<S, n> h = joint_matrix<S, n>::Zero(m, m);
  joint_vector<S, n> g = joint_vector<S, n>::Zero(m), lower(m), upper(m);
  const S turns = S(options.length * options.length);
  S largest(0);
  for (Eigen::Index a = 0; a < m; ++a)
    for (Eigen::Index r = 0; r < j.rows(); ++r) {
      const S weighted = r % 6 < 3 ? S(j(r, a)) : S(turns * j(r, a));
      g[a] += weighted * S(twist[static_cast<std::size_t>(r)]);
      for (Eigen::Index b = 0; b <= a; ++b) h(a, b) += weighted * j(r, b);
      if (r + 1 == j.rows()) largest = (std::max)(largest, h(a, a));
    }
  const S eps = largest > S(0) ? S(options.damping) * largest : S(1);
  for (Eigen::Index a = 0; a < m; ++a) {
    g[a] += eps * S(v_desired[static_cast<std::size_t>(a)]), h(a, a) += eps;
    for (Eigen::Index b = 0; b < a; ++b) h(b, a) = h(a, b);
  }
  const bool recovering = detail::put_rate_bounds(arm, q, v_now, dt, lower, upper);
  const auto least = minimise_in_box(h, g, lower, upper);

  rate_step<S, n> out{least.x, least.at, rate_status::free, S(0), S(0)};
  for (Eigen::Index a = 0; a < m; ++a)
    if (least.at[a] != 0) out.status = rate_status::limited;
  if (recovering) out.status = rate_status::recovering;
  for (Eigen::Index r = 0; r < j.rows(); r += 3) {
    S missed(0);
    for (Eigen::Index k = r; k < r + 3; ++k) {
      S difference = -S(twist[static_cast<std::size_t>(k)]);
      for (Eigen::Index a = 0; a < m; ++a) difference += j(k, a) * least.x[a];
      missed += difference * difference;
    }
    S& most = r % 6 == 0 ? out.linear : out.angular;
    using std::sqrt;
    most = (std::max)(most, S(sqrt(missed)));
    if (!(most < std::numeric_limits<S>::infinity()))
      detail::raise<bad_argument>(
          "kte: the error of a twist is not finite: a twist, a rate or a Jacobian is too large");
  }
  return out;
}
template <class Arm, indexable Q, indexable V, indexable T>
[[nodiscard]] auto rates_towards(const Arm& arm, const Q& q, const V& v_now, const T& twist, value_of<Q> dt,
                                 const rate_options& options = {}) {
  using S = value_of<Q>;
  const auto n = static_cast<Eigen::Index>(detail::dofs_of(arm));
  return rates_towards(arm, q, v_now, twist, dt, options,
                       joint_vector<S, detail::arm_dofs<Arm>>(joint_vector<S, detail::arm_dofs<Arm>>::Zero(n)));
}

}  // namespace kte
