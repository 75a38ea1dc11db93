#pragma once

#include <kte/elements/revolute_joint.hpp>
#include <kte/elements/spring.hpp>

namespace kte {

namespace core {

/// A revolute joint on a bearing with dry friction proportional to the radial load on the bearing. With the force F of
/// the joint, the axis n, the coefficient of friction mu and the radius r, m:
///
///   f -= mu r |F - (n . F) n| q' / sqrt(q'^2 + v^2)          (1)
///
/// The friction is smoothed below the rate v, rad/s.
template <kind Dim, class Axis>
struct dry_revolute_joint : revolute_joint<Dim, Axis>, transmission<dry_revolute_joint<Dim, Axis>> {
  static constexpr type_name type{"dry_revolute_joint", Dim};
  static constexpr bool load_dependent_friction = true;
  using joint = revolute_joint<Dim, Axis>;
  using transmission<dry_revolute_joint>::doMotion, transmission<dry_revolute_joint>::doForce;
  using joint::axis;

  double friction_radius;  ///< mu r, m
  double smoothing;        ///< v, rad/s

  dry_revolute_joint() = default;
  constexpr dry_revolute_joint(const Axis& n, double radius, double v)
      : joint(n), friction_radius(radius), smoothing(v) {}

  template <class C, class F, class T>
  KTE_INLINE constexpr auto friction(const C& c, const wrench<F, T>& end) const {
    const auto sign = direction(c);
    using S = std::remove_const_t<decltype(sign)>;
    return S(-(S(friction_radius) * force_across<S>(end) * sign));  // (1)
  }
  constexpr void check(const parameter_check& where) const {
    joint::check(where);
    where.not_negative(friction_radius, "friction_radius must be finite and not negative");
    where.finite(smoothing, "smoothing must be finite and positive");
    where.require(smoothing > 0, "smoothing must be finite and positive", smoothing);
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    joint::parameters(self, visit);
    visit("friction_radius", self.friction_radius), visit("smoothing", self.smoothing);
  }

 protected:
  /// The direction of sliding, smoothed, from -1 to 1.
  template <class C>
  KTE_INLINE constexpr auto direction(const C& c) const {
    using std::sqrt;
    const auto rate = detail::as_number(c.q_dot);
    using S = std::remove_const_t<decltype(rate)>;
    return S(rate / S(sqrt(S(rate * rate + S(smoothing * smoothing)))));
  }
  /// |F - (n . F) n|, N
  template <class S, class F, class T>
  KTE_INLINE constexpr S force_across(const wrench<F, T>& end) const {
    return as<S>(detail::to_polar(end.force - dot(axis, end.force) * axis).length);
  }
};

}  // namespace core

/// A revolute joint in the plane with dry friction by the load on its bearing. `friction_radius`: coefficient of
/// friction times radius of the bearing, m. `smoothing`: the rate below which the friction is smoothed, rad/s.
template <class Q, class B, class E>
[[nodiscard]] constexpr auto dry_revolute_joint_2D(const Q& coordinate, const B& base, const E& end,
                                                   double friction_radius, double smoothing = 1e-3) {
  using out_of_plane = std::remove_const_t<decltype(axis::z)>;
  return connect(core::dry_revolute_joint<kind::frame_2D, out_of_plane>(axis::z, friction_radius, smoothing),
                 coordinate, base, end);
}
/// A revolute joint in space with dry friction by the radial load on its bearing. Parameters: see
/// `dry_revolute_joint_2D`.
template <class Q, class B, class E, class X, class Y, class Z>
[[nodiscard]] constexpr auto dry_revolute_joint_3D(const Q& coordinate, const B& base, const E& end,
                                                   const vec3<X, Y, Z>& axis, double friction_radius,
                                                   double smoothing = 1e-3) {
  return connect(core::dry_revolute_joint<kind::frame_3D, vec3<X, Y, Z>>(axis, friction_radius, smoothing), coordinate,
                 base, end);
}

KTE_CALL(dry_revolute_joint_2D, "(coordinate, base, end, friction_radius[, smoothing])")
KTE_CALL(dry_revolute_joint_3D, "(coordinate, base, end, axis, friction_radius[, smoothing])")

}  // namespace kte
