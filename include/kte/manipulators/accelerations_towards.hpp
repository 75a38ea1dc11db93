#pragma once

#include <kte/manipulators/rates_towards.hpp>

namespace kte {

/// The result of `accelerations_towards`: the accelerations `a`, the `status`, and bounds and errors.
template <class S, int N>
struct acceleration_step {
  joint_vector<S, N> a;
  joint_vector<S, N> v;                       ///< v + a dt, for q' = integrate(arm, q, v, dt)
  Eigen::Matrix<signed char, N, 1> at_bound;  ///< -1, 1: held by the lower or upper bound of its rate; 0: free
  rate_status status;
  S linear, angular;  ///< largest errors of the tools' accelerations, m/s^2 and rad/s^2
};

/// One step of differential inverse kinematics by accelerations: the accelerations a that bring those of the tools
/// closest to the desired ones, within the limits of positions, rates and accelerations. v' = v + a dt minimizes,
/// within the limits of `rates_towards`,
///
///   |J v' - (J v + dt (desired - dJ/dt v))|_W^2 + eps |v' - v - dt a_desired|^2,   a = (v' - v)/dt      (1)
///
/// `desired`: acceleration (classical) and angular acceleration of each tool, at its origin in axes of the world, as in
/// `getDependentAccelerations`. To stay on a path, add gains times the errors of velocity and of pose (`pose_error`).
/// `a_desired`, 0 if omitted, is the desired acceleration in the null space of the tools: -k v damps motions there.
/// Throws what `rates_towards` throws.
template <class Arm, indexable Q, indexable V, indexable T, indexable W>
[[nodiscard]] auto accelerations_towards(const Arm& arm, const Q& q, const V& v, const T& desired, value_of<Q> dt,
                                         const rate_options& options, const W& a_desired) {
  using S = value_of<Q>;
  constexpr int n = detail::arm_dofs<Arm>;
  const auto size = detail::dofs_of(arm);
  detail::check_twists_of(arm, desired, "desired", "a desired acceleration");
  detail::check_rates_of(arm, v, "v", "a rate");
  detail::check_rates_of(arm, a_desired, "a_desired", "a desired acceleration");
  const auto m = static_cast<Eigen::Index>(size);
  joint_vector<S, n> now(m), aim(m);
  for (Eigen::Index i = 0; i < m; ++i) {
    now[i] = S(v[static_cast<std::size_t>(i)]);
    aim[i] = now[i] + dt * S(a_desired[static_cast<std::size_t>(i)]);
  }
  auto twist = arm.getDependentVelocities(q, now);
  const auto bias = arm.getDependentAccelerations(q, now, joint_vector<S, n>(joint_vector<S, n>::Zero(m)));
  for (Eigen::Index r = 0; r < twist.size(); ++r) twist[r] += dt * (S(desired[static_cast<std::size_t>(r)]) - bias[r]);
  const auto step = rates_towards(arm, q, now, twist, dt, options, aim);
  return acceleration_step<S, n>{(step.v - now) / dt, step.v,           step.at_bound,
                                 step.status,         step.linear / dt, step.angular / dt};
}
template <class Arm, indexable Q, indexable V, indexable T>
[[nodiscard]] auto accelerations_towards(const Arm& arm, const Q& q, const V& v, const T& desired, value_of<Q> dt,
                                         const rate_options& options = {}) {
  using vector = joint_vector<value_of<Q>, detail::arm_dofs<Arm>>;
  return accelerations_towards(arm, q, v, desired, dt, options,
                               vector(vector::Zero(static_cast<Eigen::Index>(detail::dofs_of(arm)))));
}

}  // namespace kte
