#pragma once

#include <kte/dynamics/closed_loops/actuated_derivatives.hpp>
#include <kte/dynamics/closed_loops/assemblies.hpp>
#include <kte/dynamics/closed_loops/at_run_time.hpp>
#include <kte/dynamics/closed_loops/closure_derivatives.hpp>

/// Static chains with loops: the equations of motion in actuated coordinates, derivatives and all assemblies.
/// Arguments, results and errors as for runtime chains, without a state; `actuated` and `held` also accept keys.
namespace kte {

template <class Gravity, class... E, indexable Q, indexable V, indexable T>
[[nodiscard]] constrained_dynamics_derivatives_result constrained_dynamics_derivatives(
    const static_chain<Gravity, E...>& c, const Q& q, const V& v, const T& tau) {
  using chain = static_chain<Gravity, E...>;
  const auto x = detail::positions_at_run_time<chain>(q);
  const auto rates = detail::rates_at_run_time<chain>(v, "v"), forces = detail::rates_at_run_time<chain>(tau, "tau");
  return detail::at_run_time(
      c, [&](const auto& r, auto& s) { return constrained_dynamics_derivatives(r, s, x, rates, forces); });
}
template <class Gravity, class... E, indexable Q, indexable V, indexable T>
[[nodiscard]] closure_derivatives_result closure_derivatives(const static_chain<Gravity, E...>& c, const Q& q,
                                                             const V& v, const T& tau,
                                                             const std::vector<closure_parameter>& parameters,
                                                             const actuated_coordinates& by) {
  using chain = static_chain<Gravity, E...>;
  const auto x = detail::positions_at_run_time<chain>(q);
  const auto rates = detail::rates_at_run_time<chain>(v, "v"), forces = detail::rates_at_run_time<chain>(tau, "tau");
  return detail::at_run_time(
      c, [&](const auto& r, auto& s) { return closure_derivatives(r, s, x, rates, forces, parameters, by); });
}
template <class Gravity, class... E, indexable Q, indexable V, indexable T>
[[nodiscard]] actuated_dynamics_derivatives_result actuated_dynamics_derivatives(const static_chain<Gravity, E...>& c,
                                                                                 const Q& q, const V& v, const T& tau,
                                                                                 const actuated_coordinates& by) {
  using chain = static_chain<Gravity, E...>;
  const auto x = detail::positions_at_run_time<chain>(q);
  const auto rates = detail::rates_at_run_time<chain>(v, "v"), forces = detail::rates_at_run_time<chain>(tau, "tau");
  return detail::at_run_time(
      c, [&](const auto& r, auto& s) { return actuated_dynamics_derivatives(r, s, x, rates, forces, by); });
}
template <class Gravity, class... E, indexable Q>
[[nodiscard]] Eigen::MatrixXd mass_matrix(const static_chain<Gravity, E...>& c, const Q& q,
                                          const actuated_coordinates& by) {
  const auto x = detail::positions_at_run_time<static_chain<Gravity, E...>>(q);
  return detail::at_run_time(c, [&](const auto& r, auto& s) { return mass_matrix(r, s, x, by); });
}
template <class Gravity, class... E, indexable Q, indexable V>
[[nodiscard]] Eigen::VectorXd bias_acceleration(const static_chain<Gravity, E...>& c, const Q& q, const V& v,
                                                const actuated_coordinates& by) {
  const auto x = detail::positions_at_run_time<static_chain<Gravity, E...>>(q);
  const auto rates = detail::rates_at_run_time<static_chain<Gravity, E...>>(v, "v");
  return detail::at_run_time(c, [&](const auto& r, auto& s) { return bias_acceleration(r, s, x, rates, by); });
}
template <class Gravity, class... E, indexable Q, indexable V>
[[nodiscard]] Eigen::VectorXd nonlinear_effects(const static_chain<Gravity, E...>& c, const Q& q, const V& v,
                                                const actuated_coordinates& by) {
  const auto x = detail::positions_at_run_time<static_chain<Gravity, E...>>(q);
  const auto rates = detail::rates_at_run_time<static_chain<Gravity, E...>>(v, "v");
  return detail::at_run_time(c, [&](const auto& r, auto& s) { return nonlinear_effects(r, s, x, rates, by); });
}
template <class Gravity, class... E, indexable Q>
[[nodiscard]] Eigen::VectorXd gravity_forces(const static_chain<Gravity, E...>& c, const Q& q,
                                             const actuated_coordinates& by) {
  const auto x = detail::positions_at_run_time<static_chain<Gravity, E...>>(q);
  return detail::at_run_time(c, [&](const auto& r, auto& s) { return gravity_forces(r, s, x, by); });
}
/// `frame`: a key.
template <class Gravity, class... E, indexable Q, key_type Frame>
[[nodiscard]] Eigen::MatrixXd jacobian(const static_chain<Gravity, E...>& c, const Q& q, const Frame& frame,
                                       const actuated_coordinates& by) {
  const auto x = detail::positions_at_run_time<static_chain<Gravity, E...>>(q);
  return detail::at_run_time(
      c, [&](const auto& r, auto& s) { return jacobian(r, s, x, detail::text_of_name(frame), by); });
}
template <class Gravity, class... E, indexable Q, key_type Frame>
[[nodiscard]] Eigen::MatrixXd jacobian(const static_chain<Gravity, E...>& c, const Q& q, const Frame& frame,
                                       in_world_axes_t, const actuated_coordinates& by) {
  const auto x = detail::positions_at_run_time<static_chain<Gravity, E...>>(q);
  return detail::at_run_time(
      c, [&](const auto& r, auto& s) { return jacobian(r, s, x, detail::text_of_name(frame), in_world_axes, by); });
}
template <class Gravity, class... E, indexable Q>
[[nodiscard]] std::vector<Eigen::VectorXd> assemblies(const static_chain<Gravity, E...>& c, int n, const Q& q,
                                                      const held_coordinates& held) {
  const auto x = detail::positions_at_run_time<static_chain<Gravity, E...>>(q);
  return detail::at_run_time(c, [&](const auto& r, auto& s) { return assemblies(r, s, n, x, held); });
}
template <class Gravity, class... E>
[[nodiscard]] std::vector<Eigen::VectorXd> assemblies(const static_chain<Gravity, E...>& c, int n) {
  return assemblies(c, n, neutral_configuration(c), {});
}

}  // namespace kte
