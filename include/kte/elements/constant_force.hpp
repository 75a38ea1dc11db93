#pragma once

#include <kte/contract/transmission.hpp>

namespace kte {

namespace core {

/// Parameters of constant loads: a force F, N, and a torque T, Nm.
template <kind Dim, class Force, class Torque>
struct load_parameters {
  Force force;
  Torque torque;

  constexpr void check(const parameter_check& where) const {
    where.finite(force, "force must be finite");
    where.finite(torque, "torque must be finite");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("force", self.force);
    if constexpr (Dim == kind::frame_2D) {
      visit("torque", self.torque.z);
    } else {
      visit("torque", self.torque);
    }
  }
};

/// A dead load: F and T are constant in axes of the world, and act at the origin of the frame:
///
///   F_frame += R^T F,  T_frame += R^T T          (1)
///
/// The force has the potential V = -F . p. The torque has none: in space its work depends on the path.
template <kind Dim, class Force, class Torque>
struct constant_force : load_parameters<Dim, Force, Torque> {
  static constexpr type_name type{"constant_force", Dim};
  static constexpr std::array<port, 1> ports{{{Dim, access::on, "frame"}}};
  static constexpr bool reads_positions = true;
  static constexpr bool is_load = true;

  template <class Frame>
  KTE_INLINE constexpr auto doForce(const Frame& x) const {
    const auto to_own = transpose(x.rotation);
    return make_loads(wrench{to_own * this->force, to_own * this->torque});  // (1)
  }
  /// The potential energy of the force, zero at the origin of the world, J.
  template <class Frame>
  KTE_INLINE constexpr auto potential_energy(const Frame& x) const {
    return -dot(this->force, x.position);
  }
};

/// A follower load: F and T are constant in axes of the frame, and act at its origin, as those of a thruster. It has no
/// potential.
template <kind Dim, class Force, class Torque>
struct follower_force : load_parameters<Dim, Force, Torque> {
  static constexpr type_name type{"follower_force", Dim};
  static constexpr std::array<port, 1> ports{{{Dim, access::on, "frame"}}};
  static constexpr bool is_load = true;

  template <class Frame>
  KTE_INLINE constexpr auto doForce(const Frame&) const {
    return make_loads(wrench{this->force, this->torque});
  }
};

}  // namespace core

/// A constant force, N, and optionally a torque, Nm, on a frame in the plane, in axes of the world: `along_y(-2.0)`,
/// `vec2`.
template <class F, geometric Force, entry Torque = zero_t>
[[nodiscard]] constexpr auto constant_force_2D(const F& frame, const Force& force, const Torque& torque = {}) {
  const auto f = detail::planar(force);
  const vec3 t{zero, zero, real(torque)};
  return connect(
      core::constant_force<kind::frame_2D, std::remove_const_t<decltype(f)>, std::remove_const_t<decltype(t)>>{{f, t}},
      frame);
}
/// A constant force, N, and optionally a torque, Nm, on a frame in space, in axes of the world.
template <class F, class X, class Y, class Z, class TX = zero_t, class TY = TX, class TZ = TY>
[[nodiscard]] constexpr auto constant_force_3D(const F& frame, const vec3<X, Y, Z>& force,
                                               const vec3<TX, TY, TZ>& torque = {}) {
  return connect(core::constant_force<kind::frame_3D, vec3<X, Y, Z>, vec3<TX, TY, TZ>>{{force, torque}}, frame);
}
/// A constant force, N, and optionally a torque, Nm, on a frame in the plane, in axes of the frame.
template <class F, geometric Force, entry Torque = zero_t>
[[nodiscard]] constexpr auto follower_force_2D(const F& frame, const Force& force, const Torque& torque = {}) {
  const auto f = detail::planar(force);
  const vec3 t{zero, zero, real(torque)};
  return connect(
      core::follower_force<kind::frame_2D, std::remove_const_t<decltype(f)>, std::remove_const_t<decltype(t)>>{{f, t}},
      frame);
}
/// A constant force, N, and optionally a torque, Nm, on a frame in space, in axes of the frame.
template <class F, class X, class Y, class Z, class TX = zero_t, class TY = TX, class TZ = TY>
[[nodiscard]] constexpr auto follower_force_3D(const F& frame, const vec3<X, Y, Z>& force,
                                               const vec3<TX, TY, TZ>& torque = {}) {
  return connect(core::follower_force<kind::frame_3D, vec3<X, Y, Z>, vec3<TX, TY, TZ>>{{force, torque}}, frame);
}

KTE_CALL(constant_force_2D, "(frame, force[, torque]); a force is a vector, such as kte::along_y(-2.0)")
KTE_CALL(constant_force_3D, "(frame, force[, torque]); both are vectors, such as kte::along_z(-2.0)")
KTE_CALL(follower_force_2D, "(frame, force[, torque]); a force is a vector, such as kte::along_y(-2.0)")
KTE_CALL(follower_force_3D, "(frame, force[, torque]); both are vectors, such as kte::along_z(-2.0)")

}  // namespace kte
