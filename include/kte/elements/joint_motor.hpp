#pragma once

#include <kte/contract/transmission.hpp>
#include <kte/math/select.hpp>

#include <limits>

namespace kte {

/// The law of a motor of a joint: its force as a function of command and motion, and the limits of both. By default the
/// force is the command. `none` is the absence of a limit.
struct motor_law {
  static constexpr double none = std::numeric_limits<double>::infinity();

  double gain = 1;                                     ///< a, force of a command of 1
  double offset = 0;                                   ///< b, N or Nm
  double stiffness = 0;                                ///< k, N/m or Nm/rad
  double damping = 0;                                  ///< c, N s/m or Nm s/rad
  double lower = -none, upper = none;                  ///< limits of the force, N or Nm
  double lower_command = -none, upper_command = none;  ///< limits of the command
  bool operator==(const motor_law&) const = default;
};

namespace core {

/// A motor of a joint, as robot files describe it, with the command u:
///
///   w = a [u] + b - k q - c q_dot,   f += [w]          (1)
///
/// where [] limits a number to its range. With a = k it is a servo whose command is the desired position.
struct joint_motor_gen {
  static constexpr type_name type{"joint_motor", kind::gen};
  static constexpr std::array<port, 2> ports{
      {{kind::gen, access::on, "coordinate"}, {kind::input, access::in, "command"}}};
  static constexpr const char* arguments =
      "{gain, offset, stiffness, damping, lower, upper, lower_command, upper_command}";

  motor_law p;

  template <class C, class U>
  KTE_INLINE constexpr auto doForce(const C& c, const U& command) const {
    return make_loads(kept(wanted(c, command), p.lower, p.upper));  // (1)
  }
  /// Zero where the force reaches an end of its range.
  template <class C, class U>
  KTE_INLINE constexpr auto switching(const C& c, const U& command) const {
    const auto w = wanted(c, command);
    using S = std::remove_const_t<decltype(w)>;
    if (p.lower == -motor_law::none && p.upper == motor_law::none) return S(1);
    const S below = S(p.upper) - w, above = w - S(p.lower);
    return S(select(below < above, below, above));
  }
  constexpr void check(const parameter_check& where) const {
    where.finite(p.gain, "gain must be finite");
    where.finite(p.offset, "offset must be finite");
    where.finite(p.stiffness, "stiffness must be finite");
    where.finite(p.damping, "damping must be finite");
    where.require(p.lower <= p.upper, "lower must not be above upper", p.lower);
    where.require(p.lower_command <= p.upper_command, "lower_command must not be above upper_command", p.lower_command);
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("gain", self.p.gain), visit("offset", self.p.offset);
    visit("stiffness", self.p.stiffness), visit("damping", self.p.damping);
    visit("lower", self.p.lower), visit("upper", self.p.upper);
    visit("lower_command", self.p.lower_command), visit("upper_command", self.p.upper_command);
  }

 private:
  template <class C, class U>
  KTE_INLINE constexpr auto wanted(const C& c, const U& command) const {
    const auto u = kept(detail::as_number(command), p.lower_command, p.upper_command);
    return detail::as_number(p.gain * u + p.offset - p.stiffness * c.q - p.damping * c.q_dot);
  }
  template <class S>
  KTE_INLINE static constexpr S kept(const S& x, double lower, double upper) {
    const S least(lower), most(upper);
    return select(x > most, most, select(x < least, least, x));
  }
};

}  // namespace core

/// A motor of a joint, within its limits:
///
///   joint_motor_gen(q, torque, {.lower = -40, .upper = 40})
///   joint_motor_gen(q, desired, {.gain = 300, .stiffness = 300, .damping = 20, .lower = -40, .upper = 40})  // a servo
template <class Q, class U>
[[nodiscard]] constexpr auto joint_motor_gen(const Q& coordinate, const U& command, const motor_law& law = {}) {
  return connect(core::joint_motor_gen{law}, coordinate, command);
}

KTE_CALL(joint_motor_gen, "(coordinate, command[, law]); a law is {.lower = -40, .upper = 40}")

}  // namespace kte
