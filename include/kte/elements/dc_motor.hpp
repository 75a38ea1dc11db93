#pragma once

#include <kte/contract/transmission.hpp>

namespace kte {

/// Parameters of a direct-current motor.
struct dc_motor_parameters {
  double resistance;       ///< R, Ohm; not negative
  double inductance;       ///< L, H; positive
  double torque_constant;  ///< k, Nm/A, which is Vs
  double ratio = 1;        ///< r, gear ratio: motor speed over joint rate; rad/m for a length
};

namespace core {

/// A direct-current motor that turns at w = r q' behind a gear without losses. Its voltage u, V, is a signal; its
/// current i, A, is an internal state:
///
///   L i' = u - R i - k w            (1)
///   f += r k i                      (2)
///
/// The electric power u i is the heat R i^2, the change of energy in the coil d(L i^2 / 2)/dt and the mechanical power
/// f q'. The motor has no inertia: its rotor is a `rotor_3D`.
struct dc_motor_gen {
  static constexpr type_name type{"dc_motor", kind::gen};
  static constexpr std::array<port, 3> ports{{{kind::gen, access::on, "coordinate"},
                                              {kind::input, access::in, "voltage"},
                                              {kind::internal, access::keep, "current"}}};
  static constexpr const char* arguments = "{resistance, inductance, torque_constant, ratio}";

  dc_motor_parameters p;

  template <class C, class U, class I>
  KTE_INLINE constexpr auto z_dot(const C& c, const U& u, const I& i) const {
    return (1 / p.inductance) * (u - p.resistance * i - (p.torque_constant * p.ratio) * c.q_dot);  // (1)
  }
  template <class C, class U, class I>
  KTE_INLINE constexpr auto doForce(const C&, const U&, const I& i) const {
    return make_loads((p.ratio * p.torque_constant) * i);  // (2)
  }
  constexpr void check(const parameter_check& where) const {
    where.not_negative(p.resistance, "resistance must be finite and not negative");
    where.positive(p.inductance, "inductance must be finite and positive");
    where.finite(p.torque_constant, "torque_constant must be finite");
    where.finite(p.ratio, "ratio must be finite");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("resistance", self.p.resistance), visit("inductance", self.p.inductance);
    visit("torque_constant", self.p.torque_constant), visit("ratio", self.p.ratio);
  }
};

}  // namespace core

/// A direct-current motor on a coordinate:
///
///   dc_motor_gen(q, volts, amperes, {.resistance = 0.6, .inductance = 1e-4, .torque_constant = 0.03, .ratio = 50})
template <class Q, class U, class I>
[[nodiscard]] constexpr auto dc_motor_gen(const Q& coordinate, const U& voltage, const I& current,
                                          const dc_motor_parameters& p) {
  return connect(core::dc_motor_gen{p}, coordinate, voltage, current);
}

KTE_CALL(dc_motor_gen, "(coordinate, voltage, current, parameters)")

}  // namespace kte
