#pragma once

#include <kte/contract/transmission.hpp>
#include <kte/kernels/force_laws.hpp>

#include <limits>

namespace kte {

/// The range of a joint and the stops at its ends. Without `lower` or `upper` there is a stop at one end.
struct joint_stops {
  double lower = -std::numeric_limits<double>::infinity();  ///< end of the range, m or rad
  double upper = std::numeric_limits<double>::infinity();   ///< end of the range, m or rad
  double stiffness;                                         ///< N/m or Nm/rad
  double damping = 0;                                       ///< Ns/m or Nms/rad
};

namespace core {

/// Elastic stops at the ends of the range of a coordinate, of stiffness k and damping c:
///
///   d = q - upper for q > upper,  q - lower for q < lower,  else 0                     (1)
///   f -= k d + c q_dot in contact, limited so that a stop does not pull                 (2)
struct joint_limit_gen {
  static constexpr type_name type{"joint_limit", kind::gen};
  static constexpr std::array<port, 1> ports{{{kind::gen, access::on, "coordinate"}}};
  static constexpr const char* arguments = "{lower, upper, stiffness, damping}";

  joint_stops p;

  template <class C>
  KTE_INLINE constexpr auto doForce(const C& x) const {
    const auto d = pressed(x);
    using T = std::remove_const_t<decltype(d)>;
    return make_loads(T(-detail::stop_force(d, as<T>(x.q_dot), T(p.stiffness), T(p.damping))));  // (2)
  }
  /// J
  template <class C>
  KTE_INLINE constexpr auto potential_energy(const C& x) const {
    const auto d = pressed(x);
    using T = std::remove_const_t<decltype(d)>;
    return T(T(0.5) * T(p.stiffness) * d * d);
  }
  /// Zero at the ends of the range: where a stop comes into contact, and without damping where it separates. (For an
  /// empty range it passes through zero, where -|q| would only touch zero.)
  template <class C>
  KTE_INLINE constexpr auto switching(const C& x) const {
    const auto q = detail::as_number(x.q);
    using T = std::remove_const_t<decltype(q)>;
    const T above = q - T(p.lower), below = T(p.upper) - q;
    return p.lower < p.upper ? T(select(above < below, above, below)) : above;
  }
  constexpr void check(const parameter_check& where) const {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    where.require(p.lower <= p.upper, "lower must not be above upper", p.lower);
    where.require(p.lower > -infinite || p.upper < infinite, "one of lower and upper must be finite", p.lower);
    where.not_negative(p.stiffness, "stiffness must be finite and not negative");
    where.not_negative(p.damping, "damping must be finite and not negative");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("lower", self.p.lower), visit("upper", self.p.upper);
    visit("stiffness", self.p.stiffness), visit("damping", self.p.damping);
  }

 private:
  template <class C>
  KTE_INLINE constexpr auto pressed(const C& x) const {  // (1)
    const auto q = detail::as_number(x.q);
    using T = std::remove_const_t<decltype(q)>;
    return detail::beyond(q, T(p.lower), T(p.upper));
  }
};

}  // namespace core

/// Elastic stops at one or both ends of the range of a coordinate:
///
///   joint_limit_gen(q, {.lower = -1.5, .upper = 1.5, .stiffness = 1e4, .damping = 20})
///   joint_limit_gen(height, {.lower = 0, .stiffness = 1e5})
template <class Q>
[[nodiscard]] constexpr auto joint_limit_gen(const Q& coordinate, const joint_stops& limits) {
  return connect(core::joint_limit_gen{limits}, coordinate);
}

KTE_CALL(joint_limit_gen, "(coordinate, limits); limits are {.lower = -1.0, .upper = 1.0, .stiffness = 1e4}")

}  // namespace kte
