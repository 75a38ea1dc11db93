#pragma once

#include <kte/contract/coordinate_lock.hpp>
#include <kte/elements/prismatic_joint.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/elements/spring.hpp>

namespace kte {

/// Parameters of dry friction of a joint that depends on the load on its bearings.
struct dry_friction_parameters {
  double friction;                    ///< mu, coefficient of sliding friction; not negative
  double static_friction = friction;  ///< mu_s, coefficient of static friction; not below mu
  double span = 0;                    ///< L, distance between two bearings, m; 0: moments have no effect
};

namespace core {

/// A revolute or prismatic joint with dry friction and a true state of rest. Its end carries a force F and, about its
/// origin, a moment M. The load normal to the axis n is
///
///   N = |F_n|,                     F_n = F - (n . F) n                        for one bearing         (1)
///   N = |F_n/2 + C| + |F_n/2 - C|, C = M x n / L            for two, at +-L/2 n from the origin        (2)
///
/// The mode of the element is the direction of sliding, d, or that the joint is locked (contract/coordinate_lock.hpp):
///
///   sliding   f -= mu r N d                                                                           (3)
///   locked    q'' = 0, while the holding force is at most mu_s r N                                    (4)
///
/// r: the radius of the bearing of a revolute joint; 1 for a prismatic joint.
template <class Joint>
struct sticking_joint : Joint, transmission<sticking_joint<Joint>>, coordinate_lock {
  static constexpr bool turns = Joint::ports[0].how == access::angle;
  static constexpr kind dim = Joint::ports[1].what;
  static constexpr auto type = [] {
    if constexpr (turns) {
      return type_name{"sticking_revolute_joint", dim};
    } else {
      return type_name{"sticking_prismatic_joint", dim};
    }
  }();
  static constexpr std::array<port, 4> ports{
      {Joint::ports[0], {kind::internal, access::keep, "mode"}, Joint::ports[1], Joint::ports[2]}};
  static constexpr const char* arguments = !turns                  ? "axis, {friction, static_friction, span}"
                                           : dim == kind::frame_2D ? "radius, {friction, static_friction}"
                                                                   : "axis, radius, {friction, static_friction, span}";
  static constexpr bool load_dependent_friction = true;
  using transmission<sticking_joint>::doMotion, transmission<sticking_joint>::doForce;
  using Joint::axis;

  double radius = 1;  ///< r, m; 1 of a guide
  dry_friction_parameters p{};

  sticking_joint() = default;
  constexpr sticking_joint(const Joint& joint, double r, const dry_friction_parameters& x)
      : Joint(joint), radius(r), p(x) {}

  template <class C, class Mode, class Wrench>
  KTE_INLINE constexpr auto friction(const C& c, const Mode& mode, const Wrench& end) const {
    using S = number<decltype(c.q_dot), Mode>;
    const S z = as<S>(mode);
    return unless_held(z, S(-(S(p.friction * radius) * pressing_force<S>(end) * direction(z, as<S>(c.q_dot)))));  // (3)
  }
  template <class C, class Mode, class Base, class Wrench>
  KTE_INLINE constexpr auto capacity(const C& c, const Mode&, const Base&, const Wrench& end) const {
    using S = number<decltype(c.q_dot), Mode>;
    return S(S(p.static_friction * radius) * pressing_force<S>(end));  // (4)
  }
  constexpr void check(const parameter_check& where) const {
    Joint::check(where);
    where.not_negative(radius, "radius must be finite and not negative");
    where.not_negative(p.friction, "friction must be finite and not negative");
    where.finite(p.static_friction, "static_friction must be finite and not below friction");
    where.require(p.static_friction >= p.friction, "static_friction must be finite and not below friction",
                  p.static_friction);
    where.not_negative(p.span, "span must be finite and not negative");
    if constexpr (!has_span)
      where.require(p.span == 0, "span must be 0: in the plane a moment turns the joint", p.span);
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    Joint::parameters(self, visit);
    if constexpr (turns) visit("radius", self.radius);
    visit("friction", self.p.friction), visit("static_friction", self.p.static_friction);
    if constexpr (has_span) visit("span", self.p.span);
  }

 private:
  static constexpr bool has_span = !turns || dim == kind::frame_3D;

  template <class S, class F, class T>
  KTE_INLINE constexpr S pressing_force(const wrench<F, T>& end) const {
    const auto length = [](const auto& x) { return as<S>(detail::to_polar(x).length); };
    const auto across = end.force - dot(axis, end.force) * axis;
    if (p.span == 0) return length(across);  // (1)
    const auto half = 0.5 * across;
    const auto couple = 1 / p.span * cross(end.torque, axis);
    return S(length(half + couple) + length(half - couple));  // (2)
  }
};

}  // namespace core

/// A revolute joint in the plane on a bearing of a radius, m, with dry friction that sticks. `mode` is an internal
/// state that events switch (docs/events.md).
template <class Q, class Z, class B, class E>
[[nodiscard]] constexpr auto sticking_revolute_joint_2D(const Q& coordinate, const Z& mode, const B& base, const E& end,
                                                        double radius, const dry_friction_parameters& friction) {
  using joint = core::revolute_joint<kind::frame_2D, std::remove_const_t<decltype(axis::z)>>;
  return connect(core::sticking_joint<joint>(joint(axis::z), radius, friction), coordinate, mode, base, end);
}
/// A revolute joint in space on a bearing of a radius, m, with dry friction that sticks. `mode` is an internal state
/// that events switch (docs/events.md).
template <class Q, class Z, class B, class E, class X, class Y, class W>
[[nodiscard]] constexpr auto sticking_revolute_joint_3D(const Q& coordinate, const Z& mode, const B& base, const E& end,
                                                        const vec3<X, Y, W>& axis, double radius,
                                                        const dry_friction_parameters& friction) {
  using joint = core::revolute_joint<kind::frame_3D, vec3<X, Y, W>>;
  return connect(core::sticking_joint<joint>(joint(axis), radius, friction), coordinate, mode, base, end);
}
/// A prismatic joint in the plane with dry friction that sticks, along a unit axis in base axes. `mode` is an internal
/// state that events switch.
template <class Q, class Z, class B, class E, geometric Axis>
[[nodiscard]] constexpr auto sticking_prismatic_joint_2D(const Q& coordinate, const Z& mode, const B& base,
                                                         const E& end, const Axis& axis,
                                                         const dry_friction_parameters& friction) {
  const auto n = detail::planar(axis);
  using joint = core::prismatic_joint<kind::frame_2D, std::remove_const_t<decltype(n)>>;
  return connect(core::sticking_joint<joint>(joint(n), 1, friction), coordinate, mode, base, end);
}
/// A prismatic joint in space with dry friction that sticks, along a unit axis in base axes. `mode` is an internal
/// state that events switch.
template <class Q, class Z, class B, class E, class X, class Y, class W>
[[nodiscard]] constexpr auto sticking_prismatic_joint_3D(const Q& coordinate, const Z& mode, const B& base,
                                                         const E& end, const vec3<X, Y, W>& axis,
                                                         const dry_friction_parameters& friction) {
  using joint = core::prismatic_joint<kind::frame_3D, vec3<X, Y, W>>;
  return connect(core::sticking_joint<joint>(joint(axis), 1, friction), coordinate, mode, base, end);
}

KTE_CALL(sticking_revolute_joint_2D, "(coordinate, mode, base, end, radius, {friction[, static_friction]})")
KTE_CALL(sticking_revolute_joint_3D, "(coordinate, mode, base, end, axis, radius, {friction[, static_friction, span]})")
KTE_CALL(sticking_prismatic_joint_2D, "(coordinate, mode, base, end, axis, {friction[, static_friction, span]})")
KTE_CALL(sticking_prismatic_joint_3D, "(coordinate, mode, base, end, axis, {friction[, static_friction, span]})")

}  // namespace kte
