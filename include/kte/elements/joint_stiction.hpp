#pragma once

#include <kte/contract/coordinate_lock.hpp>
#include <kte/kernels/force_laws.hpp>

namespace kte {

/// Parameters of friction with sticking: forces, N, for a length, torques, Nm, for an angle.
struct stiction_parameters {
  double coulomb;                ///< Fc, force of fast sliding; not negative
  double stiction;               ///< Fs, force at which sliding begins; not below Fc
  double stribeck_velocity = 1;  ///< vs, rate over which the force falls from Fs to Fc, m/s or rad/s; 0: immediately
  double viscous = 0;            ///< b, Ns/m or Nms/rad; not negative
};

namespace core {

/// Dry friction of a joint with sticking. The mode of the element is the direction of sliding, d, or that the joint is
/// locked (contract/coordinate_lock.hpp):
///
///   sliding   f -= (Fc + (Fs - Fc) exp(-(v/vs)^2)) d + b v          (1)
///   locked    v' = 0, while the holding force is at most Fs         (2)
///
/// (Stribeck 1902; Armstrong-Helouvry, Dupont and Canudas de Wit, Automatica 30 (1994), section 3.)
struct joint_stiction_gen : coordinate_lock {
  static constexpr type_name type{"joint_stiction", kind::gen};
  static constexpr std::array<port, 2> ports{
      {{kind::gen, access::on, "coordinate"}, {kind::internal, access::keep, "mode"}}};
  static constexpr const char* arguments = "{coulomb, stiction, stribeck_velocity, viscous}";

  stiction_parameters p;

  joint_stiction_gen() = default;
  constexpr explicit joint_stiction_gen(const stiction_parameters& x) : p(x) {}

  template <class C, class Z>
  KTE_INLINE constexpr auto doForce(const C& c, const Z& mode) const {
    using S = number<decltype(c.q_dot), Z>;
    const S v = as<S>(c.q_dot), z = as<S>(mode);
    const S dry(p.stribeck_velocity > 0 ? S(detail::stribeck_force(v, p.coulomb, p.stiction, p.stribeck_velocity))
                                        : S(p.coulomb));
    return make_loads(unless_held(z, S(-(dry * direction(z, v) + S(p.viscous) * v))));  // (1)
  }
  template <class C, class Z>
  KTE_INLINE constexpr auto capacity(const C&, const Z&) const {
    return p.stiction;
  }
  constexpr void check(const parameter_check& where) const {
    where.not_negative(p.coulomb, "coulomb must be finite and not negative");
    where.finite(p.stiction, "stiction must be finite and not below coulomb");
    where.require(p.stiction >= p.coulomb, "stiction must be finite and not below coulomb", p.stiction);
    where.not_negative(p.stribeck_velocity, "stribeck_velocity must be finite and not negative");
    where.not_negative(p.viscous, "viscous must be finite and not negative");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("coulomb", self.p.coulomb), visit("stiction", self.p.stiction);
    visit("stribeck_velocity", self.p.stribeck_velocity), visit("viscous", self.p.viscous);
  }
};

/// A brake or clutch on a coordinate, pressed by a signal u: it holds, or slides with, a force of up to u. It is open
/// for u <= 0.
struct brake_gen : coordinate_lock {
  static constexpr type_name type{"brake", kind::gen};
  static constexpr std::array<port, 3> ports{{{kind::gen, access::on, "coordinate"},
                                              {kind::internal, access::keep, "mode"},
                                              {kind::input, access::in, "force"}}};

  template <class C, class Z, class U>
  KTE_INLINE constexpr auto doForce(const C& c, const Z& mode, const U& force) const {
    using S = number<decltype(c.q_dot), Z, U>;
    const S z = as<S>(mode);
    return make_loads(unless_held(z, S(-(pressure(as<S>(force)) * direction(z, as<S>(c.q_dot))))));
  }
  template <class C, class Z, class U>
  KTE_INLINE constexpr auto capacity(const C&, const Z&, const U& force) const {
    return pressure(as<number<Z, U>>(force));
  }
  constexpr void check(const parameter_check&) const {}
  template <class Self, class Visit>
  static constexpr void parameters(Self&, Visit&&) {}

 private:
  /// The pressure, at least 0; NaN stays NaN.
  template <class S>
  KTE_INLINE static constexpr S pressure(const S& force) {
    return select(force < S(0), S(0), force);
  }
};

}  // namespace core

/// Dry friction on a coordinate, with sticking. `mode` is an internal state that events switch (docs/events.md).
template <class Q, class Z>
[[nodiscard]] constexpr auto joint_stiction_gen(const Q& coordinate, const Z& mode,
                                                const stiction_parameters& parameters) {
  return connect(core::joint_stiction_gen(parameters), coordinate, mode);
}
/// A brake on a coordinate that holds up to the signal `force`, N or Nm; negative values count as 0.
template <class Q, class Z, class U>
[[nodiscard]] constexpr auto brake_gen(const Q& coordinate, const Z& mode, const U& force) {
  return connect(core::brake_gen{}, coordinate, mode, force);
}

KTE_CALL(joint_stiction_gen, "(coordinate, mode, {coulomb, stiction[, stribeck_velocity, viscous]})")
KTE_CALL(brake_gen, "(coordinate, mode, force)")

}  // namespace kte
