#pragma once

#include <kte/elements/dry_revolute_joint.hpp>
#include <kte/math/select.hpp>

namespace kte {

namespace core {

/// A `dry_revolute_joint` for controllers: tau of inverse dynamics overcomes the friction, also at rest, where it is
/// the breakaway torque. With the radial force N of the joint, the torque T of the joint about its axis, and s = q' /
/// sqrt(q'^2 + v^2):
///
///   f -= mu r N s                                          sliding             (1)
///   f += (1 - |s|) min(mu_s r N, |T|) sign(T)              at rest             (2)
///
/// so that tau = -f is the load plus the friction. (2) is not friction: it acts in the direction of the load.
template <kind Dim, class Axis>
struct vmc_revolute_joint : dry_revolute_joint<Dim, Axis>, transmission<vmc_revolute_joint<Dim, Axis>> {
  static constexpr type_name type{"vmc_revolute_joint", Dim};
  static constexpr bool power_dual = false;
  using dry = dry_revolute_joint<Dim, Axis>;
  using transmission<vmc_revolute_joint>::doMotion, transmission<vmc_revolute_joint>::doForce;
  using dry::axis, dry::friction_radius;

  double stiction_radius;  ///< mu_s r, m

  vmc_revolute_joint() = default;
  constexpr vmc_revolute_joint(const Axis& n, double sliding, double resting, double v)
      : dry(n, sliding, v), stiction_radius(resting) {}

  template <class C, class F, class T>
  KTE_INLINE constexpr auto friction(const C& c, const wrench<F, T>& end) const {
    const auto sign = this->direction(c);
    using S = std::remove_const_t<decltype(sign)>;
    const S across = this->template force_across<S>(end), load = as<S>(dot(axis, end.torque));
    const S most = S(stiction_radius) * across;
    const S held = select(load > most, most, select(load < S(-most), S(-most), load));
    const S still = S(1) - select(sign < S(0), S(-sign), sign);
    return S(still * held - S(friction_radius) * across * sign);  // (1), (2)
  }
  constexpr void check(const parameter_check& where) const {
    dry::check(where);
    where.finite(stiction_radius, "stiction_radius must be finite and not below friction_radius");
    where.require(stiction_radius >= friction_radius, "stiction_radius must be finite and not below friction_radius",
                  stiction_radius);
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    dry::joint::parameters(self, visit);
    visit("friction_radius", self.friction_radius), visit("stiction_radius", self.stiction_radius);
    visit("smoothing", self.smoothing);
  }
};

}  // namespace core

/// A revolute joint in the plane for controllers: inverse dynamics gives the torque that overcomes its dry friction.
/// `friction_radius`, `stiction_radius`: coefficients of sliding and static friction times radius of the bearing, m.
/// `smoothing`: the rate over which friction changes from static to sliding, rad/s.
template <class Q, class B, class E>
[[nodiscard]] constexpr auto vmc_revolute_joint_2D(const Q& coordinate, const B& base, const E& end,
                                                   double friction_radius, double stiction_radius,
                                                   double smoothing = 1e-3) {
  using out_of_plane = std::remove_const_t<decltype(axis::z)>;
  return connect(
      core::vmc_revolute_joint<kind::frame_2D, out_of_plane>(axis::z, friction_radius, stiction_radius, smoothing),
      coordinate, base, end);
}
/// A revolute joint in space for controllers; see `vmc_revolute_joint_2D`.
template <class Q, class B, class E, class X, class Y, class Z>
[[nodiscard]] constexpr auto vmc_revolute_joint_3D(const Q& coordinate, const B& base, const E& end,
                                                   const vec3<X, Y, Z>& axis, double friction_radius,
                                                   double stiction_radius, double smoothing = 1e-3) {
  return connect(
      core::vmc_revolute_joint<kind::frame_3D, vec3<X, Y, Z>>(axis, friction_radius, stiction_radius, smoothing),
      coordinate, base, end);
}

KTE_CALL(vmc_revolute_joint_2D, "(coordinate, base, end, friction_radius, stiction_radius[, smoothing])")
KTE_CALL(vmc_revolute_joint_3D, "(coordinate, base, end, axis, friction_radius, stiction_radius[, smoothing])")

}  // namespace kte
