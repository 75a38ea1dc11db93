#pragma once

#include <kte/elements/driving_actuator.hpp>

namespace kte {

namespace core {

/// An external load on a frame: signals u, N, and t, Nm, in axes of the world, at the origin of the frame:
///
///   F += R^T u,  T += R^T t          (1)
template <kind Dim>
struct external_force : no_parameters {
  static constexpr type_name type{"external_force", Dim};
  static constexpr auto ports = driving_actuator<Dim>::ports;
  static constexpr bool reads_positions = true;
  static constexpr bool is_load = true;

  template <class Frame, class U, class T>
  KTE_INLINE constexpr auto doForce(const Frame& x, const U& u, const T& t) const {
    const auto to_own = transpose(x.rotation);
    const auto in_world = detail::wrench_of_signals<Dim>(u, t);
    return make_loads(wrench{to_own * in_world.force, to_own * in_world.torque});  // (1)
  }
};

}  // namespace core

/// An external load on a frame in the plane: signals `force`, three numbers, N, and `torque`, a number, Nm, in axes of
/// the world.
template <class F, class U, class T>
[[nodiscard]] constexpr auto external_force_2D(const F& frame, const U& force, const T& torque) {
  return connect(core::external_force<kind::frame_2D>{}, frame, force, torque);
}
/// An external load on a frame in space: signals `force`, N, and `torque`, Nm, of three numbers each, in axes of the
/// world.
template <class F, class U, class T>
[[nodiscard]] constexpr auto external_force_3D(const F& frame, const U& force, const T& torque) {
  return connect(core::external_force<kind::frame_3D>{}, frame, force, torque);
}

KTE_CALL(external_force_2D, "(frame, force, torque)")
KTE_CALL(external_force_3D, "(frame, force, torque)")

}  // namespace kte
