#pragma once

#include <kte/contract/transmission.hpp>
#include <kte/math/select.hpp>

namespace kte {

/// The torque-speed line of a motor.
struct torque_speed_line {
  double max_torque;  ///< at standstill and in braking, Nm or N; positive
  double max_speed;   ///< speed at which the driving force is zero, rad/s or m/s; positive
};

namespace core {

/// A motor whose force, N or Nm, is the command u within its torque-speed line. The limit decreases with the speed in
/// the direction of the force; in braking it is the full force.
///
///   f += u limited to [-t s(-v), t s(v)],   s(v) = 1 - v / v_max between 0 and 1          (1)
struct torque_speed_motor_gen {
  static constexpr type_name type{"torque_speed_motor", kind::gen};
  static constexpr std::array<port, 2> ports{
      {{kind::gen, access::on, "coordinate"}, {kind::input, access::in, "command"}}};
  static constexpr const char* arguments = "{max_torque, max_speed}";

  torque_speed_line line;

  template <class C, class U>
  KTE_INLINE constexpr auto doForce(const C& c, const U& command) const {
    const auto x = limits(c.q_dot, command);
    return make_loads(select(x.u > x.most, x.most, select(x.u < x.least, x.least, x.u)));  // (1)
  }
  /// Zero where the line begins to limit it.
  template <class C, class U>
  KTE_INLINE constexpr auto switching(const C& c, const U& command) const {
    const auto x = limits(c.q_dot, command);
    using S = decltype(x.u);
    const S below = x.most - x.u, above = x.u - x.least;
    return S(select(below < above, below, above));
  }
  constexpr void check(const parameter_check& where) const {
    where.positive(line.max_torque, "max_torque must be finite and positive");
    where.positive(line.max_speed, "max_speed must be finite and positive");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("max_torque", self.line.max_torque), visit("max_speed", self.line.max_speed);
  }

 private:
  template <class S>
  struct command_and_limits {
    S u, least, most;
  };
  template <class V, class U>
  KTE_INLINE constexpr auto limits(const V& rate, const U& command) const {
    using S = std::remove_cvref_t<decltype(detail::as_number(rate) + detail::as_number(command))>;
    const S v = as<S>(rate) / S(line.max_speed);
    const auto share = [](const S& part) KTE_INLINE_LAMBDA {
      const S rest = S(1) - part;
      return S(select(rest < S(0), S(0), select(rest > S(1), S(1), rest)));
    };
    return command_and_limits<S>{as<S>(command), S(-(S(line.max_torque) * share(S(-v)))),
                                 S(S(line.max_torque) * share(v))};
  }
};

}  // namespace core

/// A motor on a coordinate that follows a command within its torque-speed line. Torque and speed are those of the
/// coordinate: with a gear, the motor torque times the ratio, and the motor speed divided by it.
///
///   torque_speed_motor_gen(q, command, {.max_torque = 40, .max_speed = 6})
template <class Q, class U>
[[nodiscard]] constexpr auto torque_speed_motor_gen(const Q& coordinate, const U& command,
                                                    const torque_speed_line& line) {
  return connect(core::torque_speed_motor_gen{line}, coordinate, command);
}

KTE_CALL(torque_speed_motor_gen, "(coordinate, command, line); a line is {.max_torque = 40, .max_speed = 6}")

}  // namespace kte
