#pragma once

#include <kte/contract/transmission.hpp>
#include <kte/math/select.hpp>

#include <limits>

namespace kte {

/// Gains of a PID controller whose output is a force, N or Nm, on a coordinate in m or rad.
struct pid_gains {
  double proportional;                                     ///< P, N/m or Nm/rad
  double integral = 0;                                     ///< I, N/(m s) or Nm/(rad s)
  double derivative = 0;                                   ///< D, Ns/m or Nms/rad
  double limit = std::numeric_limits<double>::infinity();  ///< limit of the output, N or Nm; positive
  double tracking = 0;  ///< b, gain of back-calculation at the limit, m/N or rad/Nm; not negative
};

namespace core {

/// A PID controller: it writes a signal u from a coordinate q and the signal r of its desired value. The integral of
/// the error is an internal state z, m s or rad s:
///
///   w = P (r - q) + I z - D q'                                  (1)
///   u = w limited to [-limit, limit]                            (2)
///   z' = r - q - b (w - u)                                      (3)
///
/// The last term is anti-windup by back-calculation (Astrom and Hagglund, Advanced PID Control, 2006, section 3.5); b =
/// 1/P is a common choice.
struct pid_control_gen {
  static constexpr type_name type{"pid_control", kind::gen};
  static constexpr std::array<port, 4> ports{{{kind::gen, access::on, "coordinate"},
                                              {kind::input, access::in, "wanted"},
                                              {kind::internal, access::keep, "integral"},
                                              {kind::input, access::out, "output"}}};
  static constexpr const char* arguments = "{proportional, integral, derivative, limit, tracking}";

  pid_gains p;

  template <class C, class R, class Z>
  KTE_INLINE constexpr auto doMotion(const C& c, const R& wanted, const Z& z) const {
    return limited(unlimited(c, wanted, z));
  }
  template <class C, class R, class Z>
  KTE_INLINE constexpr auto z_dot(const C& c, const R& wanted, const Z& z) const {
    const auto w = unlimited(c, wanted, z);
    return wanted - c.q - p.tracking * (w - limited(w));  // (3)
  }
  constexpr void check(const parameter_check& where) const {
    where.finite(p.proportional, "proportional must be finite");
    where.finite(p.integral, "integral must be finite");
    where.finite(p.derivative, "derivative must be finite");
    where.require(p.limit > 0, "limit must be positive", p.limit);
    where.not_negative(p.tracking, "tracking must be finite and not negative");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("proportional", self.p.proportional), visit("integral", self.p.integral);
    visit("derivative", self.p.derivative), visit("limit", self.p.limit), visit("tracking", self.p.tracking);
  }

 private:
  template <class C, class R, class Z>
  KTE_INLINE constexpr auto unlimited(const C& c, const R& wanted, const Z& z) const {
    return detail::as_number(p.proportional * (wanted - c.q) + p.integral * z - p.derivative * c.q_dot);  // (1)
  }
  template <class W>
  KTE_INLINE constexpr W limited(const W& w) const {
    const W most(p.limit), least(-p.limit);
    return select(w > most, most, select(w < least, least, w));  // (2)
  }
};

}  // namespace core

/// A PID controller of a coordinate, with an internal state `integral`, that writes the signal `output`:
///
///   pid_control_gen(q, desired, integral, output, {.proportional = 80, .integral = 40, .derivative = 6, .limit = 20,
///                                                 .tracking = 1 / 80.0})
template <class Q, class R, class Z, class Y>
[[nodiscard]] constexpr auto pid_control_gen(const Q& coordinate, const R& wanted, const Z& integral, const Y& output,
                                             const pid_gains& gains) {
  return connect(core::pid_control_gen{gains}, coordinate, wanted, integral, output);
}

KTE_CALL(pid_control_gen, "(coordinate, wanted, integral, output, gains)")

}  // namespace kte
