#pragma once

#include <kte/dynamics.hpp>

#include <optional>
#include <string_view>

#include "chain/models.hpp"
#include "dynamics/small_chains.hpp"
#include "static_models/static_model.hpp"

namespace kte::test::static_models {

/// f(frame) of the frame of this name.
template <class Result, const auto&... Frames, class F>
Result of_frame(std::string_view name, const F& f) {
  std::optional<Result> result;
  ((Frames.name == name ? void(result = f(Frames)) : void()), ...);
  return result.value();
}

/// All bodies, with positions, rotations and velocities of their frames.
template <class S, class Chain>
auto bodies_of(const Chain& c, const typename static_model<S>::vector& q, const typename static_model<S>::vector& v) {
  auto s = make_state<S>(c);
  set_positions(s, q), set_velocities(s, v);
  c.doMotion(s);
  std::vector<std::pair<typename static_model<S>::body, frame_3D<S>>> all;
  boost::hana::for_each(c.elements(), [&]<class Core, class Key, class... Keys>(const element<Core, Key, Keys...>& e) {
    if constexpr (requires { e.core.body; }) {
      auto& [b, frame] = all.emplace_back();
      b = {as<S>(e.core.body.mass), as<S>(e.core.body.com), as<S>(e.core.body.inertia)};
      const auto& x = spatial(s[Key{}]);
      frame.position = as<S>(x.position), frame.rotation = as<S>(matrix(x.rotation));
      frame.velocity = as<S>(x.velocity), frame.ang_velocity = as<S>(x.ang_velocity);
    }
  });
  return all;
}

template <class S, const auto& C, const auto&... Frames>
static_model<S> model_of() {
  using X = typename static_model<S>::vector;
  using M = typename static_model<S>::matrix;
  using small_chains::eigen;
  static_model<S> m{};
  m.dofs = std::remove_cvref_t<decltype(C)>::dofs;
  m.gravity = as<double>(C.gravity());
  m.integrate = [](const X& q, const X& v, const S& t) -> X { return kte::integrate(C, q, v, t); };

  m.inverse_dynamics = [](const X& q, const X& v, const X& a) -> X { return kte::inverse_dynamics(C, q, v, a); };
  m.mass_matrix = [](const X& q) -> M { return kte::mass_matrix(C, q); };
  m.static_forces = [](const X& q) -> X { return kte::static_forces(C, q); };
  m.gravity_forces = [](const X& q) -> X { return kte::gravity_forces(C, q); };
  m.nonlinear_effects = [](const X& q, const X& v) -> X { return kte::nonlinear_effects(C, q, v); };
  m.coriolis_forces = [](const X& q, const X& v) -> X { return kte::coriolis_forces(C, q, v); };
  static const auto light = C.gravity(C.gravity() * 0.0);
  m.gravity_forces_without_gravity = [](const X& q) -> X { return kte::gravity_forces(light, q); };
  m.coriolis_forces_without_gravity = [](const X& q, const X& v) -> X { return kte::coriolis_forces(light, q, v); };

  m.potential_energy = [](const X& q) -> S { return kte::potential_energy(C, q); };
  m.kinetic_energy = [](const X& q, const X& v) -> S { return kte::kinetic_energy(C, q, v); };
  m.energy = [](const X& q, const X& v) -> energies<S> { return kte::energy(C, q, v); };
  m.generalized_momenta = [](const X& q, const X& v) -> X { return kte::generalized_momenta(C, q, v); };

  m.centre_of_mass = [](const X& q) -> mass_centre<S> { return kte::centre_of_mass(C, q); };
  m.centre_of_mass_velocity = [](const X& q, const X& v) -> X { return eigen(kte::centre_of_mass_velocity(C, q, v)); };
  m.centroidal_momentum = [](const X& q, const X& v) -> X { return eigen(kte::centroidal_momentum(C, q, v)); };
  m.centroidal_momentum_matrix = [](const X& q) -> M { return kte::centroidal_momentum_matrix(C, q); };
  m.bodies = [](const X& q, const X& v) { return bodies_of<S>(C, q, v); };

  m.forward_kinematics = [](const X& q, const char* frame) {
    using placed = typename static_model<S>::placed;
    return of_frame<placed, Frames...>(
        frame, [&](const auto& f) { return small_chains::in_space(kte::forward_kinematics(C, q, f)); });
  };
  m.jacobian = [](const X& q, const char* frame) {
    return of_frame<M, Frames...>(frame, [&](const auto& f) { return kte::jacobian(C, q, f); });
  };
  m.jacobian_in_world_axes = [](const X& q, const char* frame) {
    return of_frame<M, Frames...>(frame, [&](const auto& f) { return kte::jacobian(C, q, f, in_world_axes); });
  };
  m.frame_velocity = [](const X& q, const X& v, const char* frame) {
    return of_frame<X, Frames...>(frame, [&](const auto& f) { return eigen(kte::frame_velocity(C, q, v, f)); });
  };
  m.frame_acceleration = [](const X& q, const X& v, const X& a, const char* frame) {
    return of_frame<X, Frames...>(frame, [&](const auto& f) { return eigen(kte::frame_acceleration(C, q, v, a, f)); });
  };
  return m;
}

template <const auto& C, const auto&... Frames>
model made() {
  return {model_of<double, C, Frames...>(), model_of<digits50, C, Frames...>(), models::element_by_element(C)};
}

}  // namespace kte::test::static_models
