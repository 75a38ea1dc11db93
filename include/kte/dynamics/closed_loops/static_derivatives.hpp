#pragma once

#include <kte/dynamics/closed_loops/actuated_derivatives.hpp>
#include <kte/dynamics/closed_loops/assemblies.hpp>
#include <kte/dynamics/closed_loops/closure_derivatives.hpp>
#include <kte/dynamics/runtime/at_run_time.hpp>

/// Static chains with loops: the equations of motion in actuated coordinates, derivatives and all assemblies.
/// Arguments, results and errors as for runtime chains, without a state; `actuated` and `held` also accept keys.
namespace kte {

template <class Gravity, class... E, indexable Q, indexable V, indexable T>
[[nodiscard]] constrained_dynamics_derivatives_result constrained_dynamics_derivatives(
    const static_chain<Gravity, E...>& c, const Q& q, const V& v, const T& tau) {
  return detail::at_run_time(c, q, v, tau, [&](auto&... at) { return constrained_dynamics_derivatives(at...); });
}
template <class Gravity, class... E, indexable Q, indexable V, indexable T>
[[nodiscard]] closure_derivatives_result closure_derivatives(const static_chain<Gravity, E...>& c, const Q& q,
                                                             const V& v, const T& tau,
                                                             const std::vector<closure_parameter>& parameters,
                                                             const actuated_coordinates& by) {
  return detail::at_run_time(c, q, v, tau, [&](auto&... at) { return closure_derivatives(at..., parameters, by); });
}
template <class Gravity, class... E, indexable Q, indexable V, indexable T>
[[nodiscard]] actuated_dynamics_derivatives_result actuated_dynamics_derivatives(const static_chain<Gravity, E...>& c,
                                                                                 const Q& q, const V& v, const T& tau,
                                                                                 const actuated_coordinates& by) {
  return detail::at_run_time(c, q, v, tau, [&](auto&... at) { return actuated_dynamics_derivatives(at..., by); });
}
template <class Gravity, class... E, indexable Q>
[[nodiscard]] Eigen::MatrixXd mass_matrix(const static_chain<Gravity, E...>& c, const Q& q,
                                          const actuated_coordinates& by) {
  return detail::at_run_time(c, q, [&](auto&... at) { return mass_matrix(at..., by); });
}
template <class Gravity, class... E, indexable Q, indexable V>
[[nodiscard]] Eigen::VectorXd bias_acceleration(const static_chain<Gravity, E...>& c, const Q& q, const V& v,
                                                const actuated_coordinates& by) {
  return detail::at_run_time(c, q, v, [&](auto&... at) { return bias_acceleration(at..., by); });
}
template <class Gravity, class... E, indexable Q, indexable V>
[[nodiscard]] Eigen::VectorXd nonlinear_effects(const static_chain<Gravity, E...>& c, const Q& q, const V& v,
                                                const actuated_coordinates& by) {
  return detail::at_run_time(c, q, v, [&](auto&... at) { return nonlinear_effects(at..., by); });
}
template <class Gravity, class... E, indexable Q>
[[nodiscard]] Eigen::VectorXd gravity_forces(const static_chain<Gravity, E...>& c, const Q& q,
                                             const actuated_coordinates& by) {
  return detail::at_run_time(c, q, [&](auto&... at) { return gravity_forces(at..., by); });
}
/// `frame`: a key.
template <class Gravity, class... E, indexable Q, key_type Frame>
[[nodiscard]] Eigen::MatrixXd jacobian(const static_chain<Gravity, E...>& c, const Q& q, const Frame& frame,
                                       const actuated_coordinates& by) {
  return detail::at_run_time(c, q, [&](auto&... at) { return jacobian(at..., detail::text_of_name(frame), by); });
}
template <class Gravity, class... E, indexable Q, key_type Frame>
[[nodiscard]] Eigen::MatrixXd jacobian(const static_chain<Gravity, E...>& c, const Q& q, const Frame& frame,
                                       in_world_axes_t, const actuated_coordinates& by) {
  return detail::at_run_time(
      c, q, [&](auto&... at) { return jacobian(at..., detail::text_of_name(frame), in_world_axes, by); });
}
template <class Gravity, class... E, indexable Q>
[[nodiscard]] std::vector<Eigen::VectorXd> assemblies(const static_chain<Gravity, E...>& c, int n, const Q& q,
                                                      const held_coordinates& held) {
  return detail::at_run_time(c, q, [&](const auto& r, auto& s, const auto& x) { return assemblies(r, s, n, x, held); });
}
template <class Gravity, class... E>
[[nodiscard]] std::vector<Eigen::VectorXd> assemblies(const static_chain<Gravity, E...>& c, int n) {
  return assemblies(c, n, neutral_configuration(c), {});
}

}  // namespace kte
