#pragma once

#include <kte/contract/transmission.hpp>
#include <kte/kernels/force_laws.hpp>

namespace kte {

/// Parameters of smooth friction: forces, N, for a length, torques, Nm, for an angle.
struct friction_parameters {
  double viscous = 0;            ///< b, Ns/m or Nms/rad; not negative
  double coulomb = 0;            ///< Fc, force of fast sliding, N or Nm; not negative
  double stiction = 0;           ///< Fs, largest force at slow sliding, N or Nm; not below Fc; 0 means Fc
  double stribeck_velocity = 1;  ///< vs, rate over which the force falls from Fs to Fc, m/s or rad/s; positive
  double smoothing_velocity =
      0;  ///< v0, rate over which dry friction changes its sign, m/s or rad/s; positive if there is dry friction
};

namespace core {

/// Viscous and dry friction of a joint, a smooth function of its rate v:
///
///   g(v) = Fc + (Fs - Fc) exp(-(v/vs)^2)          (1)
///   f -= g(v) tanh(v/v0) + b v                    (2)
///
/// It dissipates energy and never sticks: under a load F < Fs the joint creeps at about v0 F/Fs. `joint_lugre_gen` and
/// `joint_elasto_plastic_gen` stick, by an internal state. A v0 above about vs/2 flattens the peak at Fs. The slope at
/// rest is Fs/v0 + b; the fastest rate of the system is this slope over the mass.
struct joint_friction_gen {
  static constexpr type_name type{"joint_friction", kind::gen};
  static constexpr std::array<port, 1> ports{{{kind::gen, access::on, "coordinate"}}};
  static constexpr const char* arguments = "{viscous, coulomb, stiction, stribeck_velocity, smoothing_velocity}";

  friction_parameters p;

  template <class C>
  KTE_INLINE constexpr auto doForce(const C& c) const {
    return make_loads(force(c.q_dot));
  }
  constexpr void check(const parameter_check& where) const {
    where.not_negative(p.viscous, "viscous must be finite and not negative");
    where.not_negative(p.coulomb, "coulomb must be finite and not negative");
    where.not_negative(p.stiction, "stiction must be finite and not negative");
    where.require(p.stiction == 0 || p.stiction >= p.coulomb, "stiction must be 0 or not below coulomb", p.stiction);
    where.positive(p.stribeck_velocity, "stribeck_velocity must be finite and positive");
    if (is_dry())
      where.positive(p.smoothing_velocity, "smoothing_velocity must be finite and positive with dry friction");
    else
      where.not_negative(p.smoothing_velocity, "smoothing_velocity must be finite and not negative");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("viscous", self.p.viscous), visit("coulomb", self.p.coulomb), visit("stiction", self.p.stiction);
    visit("stribeck_velocity", self.p.stribeck_velocity), visit("smoothing_velocity", self.p.smoothing_velocity);
  }

 private:
  constexpr bool is_dry() const { return p.coulomb != 0 || p.stiction != 0; }
  template <class V>
  KTE_INLINE constexpr auto force(const V& v) const {
    using std::tanh;
    if constexpr (std::is_same_v<V, zero_t>) {
      return zero;
    } else {
      using number = std::remove_cvref_t<decltype(v / p.smoothing_velocity)>;
      if (!is_dry()) return number(-(p.viscous * v));
      const double stiction = p.stiction > 0 ? p.stiction : p.coulomb;
      const auto g = detail::stribeck_force(v, p.coulomb, stiction, p.stribeck_velocity);    // (1)
      return number(-(g * number(tanh(number(v / p.smoothing_velocity))) + p.viscous * v));  // (2)
    }
  }
};

}  // namespace core

/// Smooth friction on a coordinate:
///
///   joint_friction_gen(q, {.viscous = 0.1, .coulomb = 1.0, .stiction = 1.5, .stribeck_velocity = 0.01,
///                          .smoothing_velocity = 0.001})
///   joint_friction_gen(q, {.viscous = 0.1})
///
/// Dry friction needs a `smoothing_velocity`.
template <class Q>
[[nodiscard]] constexpr auto joint_friction_gen(const Q& coordinate, const friction_parameters& p) {
  return connect(core::joint_friction_gen{p}, coordinate);
}

KTE_CALL(joint_friction_gen, "(coordinate, parameters)")

}  // namespace kte
