#pragma once

#include <kte/contract/transmission.hpp>

namespace kte {

namespace core {

/// The spin of a motor's rotor, or of a flywheel, that turns r times as fast as a coordinate about an axis n of the
/// frame on which it is mounted. J is its inertia about n, which the body of this frame does not include (its mass and
/// its other moments of inertia belong to that body):
///
///   s = n . w + r q',   s' = n . al + r q''                 (1)
///   T = - J (s' n + s w x n),   f = - r J s'                (2)
///
/// It has the reflected inertia r^2 J, exerts a reaction on its housing, and acts as a gyroscope. (Featherstone, Rigid
/// Body Dynamics Algorithms, 2008, section 9.6.)
template <class Axis, class Ratio, class Inertia>
struct rotor {
  static constexpr type_name type{"rotor", kind::frame_3D};
  static constexpr std::array<port, 2> ports{
      {{kind::gen, access::on, "coordinate"}, {kind::frame_3D, access::on, "frame"}}};
  static constexpr bool distributed_mass = true;

  Axis axis;
  Ratio ratio;
  Inertia inertia;

  template <class C, class Frame>
  KTE_INLINE constexpr auto mass_loads(const C& c, const Frame& x) const {
    const auto torque = -(inertia * (dot(axis, x.ang_acceleration) + ratio * c.q_ddot));
    return make_loads(ratio * torque, wrench{zero3{}, torque * axis});
  }
  template <class C, class Frame>
  KTE_INLINE constexpr auto doForce(const C& c, const Frame& x) const {
    const auto torque = -(inertia * (dot(axis, x.ang_acceleration) + ratio * c.q_ddot));
    const auto momentum = inertia * (dot(axis, x.ang_velocity) + ratio * c.q_dot);
    return make_loads(ratio * torque, wrench{zero3{}, torque * axis + cross(momentum * axis, x.ang_velocity)});  // (2)
  }
  /// J s^2 / 2
  template <class C, class Frame>
  KTE_INLINE constexpr auto kinetic_energy(const C& c, const Frame& x) const {
    const auto s = dot(axis, x.ang_velocity) + ratio * c.q_dot;  // (1)
    return detail::half(inertia * (s * s));
  }
  constexpr void check(const parameter_check& where) const {
    where.unit(axis, "axis must have length 1");
    where.finite(ratio, "ratio must be finite");
    where.not_negative(inertia, "inertia must be finite and not negative");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("axis", self.axis), visit("ratio", self.ratio), visit("inertia", self.inertia);
  }
};

}  // namespace core

/// A rotor mounted on `frame`, with an inertia about its axis, kg m^2. `ratio`: gear ratio, rotor speed over joint
/// rate. The body of the frame includes the mass of the rotor and its inertia about axes normal to its axis.
template <class Q, class F, class X, class Y, class Z, entry Ratio, entry Inertia>
[[nodiscard]] constexpr auto rotor_3D(const Q& coordinate, const F& frame, const vec3<X, Y, Z>& axis,
                                      const Ratio& ratio, const Inertia& inertia) {
  return connect(
      core::rotor<vec3<X, Y, Z>, decltype(real(ratio)), decltype(real(inertia))>{axis, real(ratio), real(inertia)},
      coordinate, frame);
}

KTE_CALL(rotor_3D, "(coordinate, frame, axis, ratio, inertia)")

}  // namespace kte
