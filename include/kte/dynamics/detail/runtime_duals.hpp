#pragma once

#include <kte/dynamics/detail/dual_derivatives.hpp>
#include <kte/dynamics/detail/runtime_algorithms.hpp>

/// Derivatives of inverse dynamics of runtime chains by dual numbers, where forces act between frames or coordinates
/// follow others. Templates, though of double alone: who does not call them does not compile loops over dual numbers.
namespace kte::detail {

/// A state with derivatives of the same chain.
template <std::same_as<double> S>
derivative_state& state_with_derivatives(const kte_map_chain& c, basic_runtime_state<S>& s) {
  auto& d = s.with_derivatives.template get<derivative_state>([&c] { return c.make_state<derivative_number>(); });
  if (d.made_for()->layout != s.made_for()->layout) d = c.make_state<derivative_number>();
  return d;
}
/// All that is given from outside but coordinates that are free, as constants.
template <std::same_as<double> S>
void take_given(basic_runtime_state<S>& s, derivative_state& d) {
  const auto take = [](auto& to, const auto& x) {
    set_motion(to, motion{x.position, x.rotation, x.velocity, x.ang_velocity, x.acceleration, x.ang_acceleration});
  };
  for (const auto& [k, i] : s.tree().plan.bases) {
    if (k == kind::frame_2D)
      take(d.get<kind::frame_2D>(i), spatial(s.template get<kind::frame_2D>(i)));
    else
      take(d.get<kind::frame_3D>(i), s.template get<kind::frame_3D>(i));
  }
  const auto& row = s.tree().plan.row_of_gen;
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (row[i] < s.dofs()) continue;
    const auto& from = s.template get<kind::gen>(static_cast<int>(i));
    auto& to = d.get<kind::gen>(static_cast<int>(i));
    to.q = from.q, to.q_dot = from.q_dot, to.q_ddot = from.q_ddot;
  }
  const auto& names = s.made_for()->names;
  for (int i = 0; i < static_cast<int>(names[static_cast<std::size_t>(kind::input)].size()); ++i)
    d.get<kind::input>(i) = s.template get<kind::input>(i);
  for (int i = 0; i < static_cast<int>(names[static_cast<std::size_t>(kind::internal)].size()); ++i)
    d.get<kind::internal>(i).z = s.template get<kind::internal>(i).z;
}

/// By q and v at what the state has, into `of_forces`; by_a is the mass matrix.
template <std::same_as<double> S>
void derive_forces_by_duals(const kte_map_chain& c, basic_runtime_state<S>& s) {
  using numbers = std::vector<derivative_number>;
  auto& r = s.work.of_forces;
  const Eigen::Index n = s.dofs();
  r.by_q.setZero(n, n), r.by_v.setZero(n, n);
  derivative_state& d = state_with_derivatives(c, s);
  take_given(s, d);
  const auto constants = [](const Eigen::VectorXd& x) { return numbers(x.begin(), x.end()); };
  numbers q = constants(positions(s)), v = constants(velocities(s));
  const numbers a = constants(accelerations(s));
  const auto evaluate = [&]() -> const auto& {
    take(c, d, q, v, a);
    forces_on_coordinates(runtime_elements{c}, d, acting::all);
    take_needed_forces(d);
    return d.work.forces;
  };
  derive_by_duals(d.freedoms(), std::span(q), std::span(v), evaluate, r);
  mass_of_coordinates(runtime_elements{c}, s);
  r.by_a = s.work.mass;
}

}  // namespace kte::detail
