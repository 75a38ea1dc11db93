#pragma once

#include <kte/contract/transmission.hpp>

#include <cmath>

namespace kte {

/// A spring of a coordinate with the force k_1 x + k_2 x^2 + k_3 x^3 at the deflection x, N or Nm.
struct cubic_stiffness_parameters {
  double stiffness = 0;  ///< k_1, N/m or Nm/rad; of any sign, as the others
  double quadratic = 0;  ///< k_2, N/m^2 or Nm/rad^2
  double cubic = 0;      ///< k_3, N/m^3 or Nm/rad^3
  double rest = 0;       ///< the coordinate where x is 0, m or rad
};
/// Damping of a coordinate with the force (d_1 + d_2 |v| + d_3 v^2) v at the rate v, N or Nm.
struct cubic_damping_parameters {
  double damping = 0;    ///< d_1, N s/m or Nm s/rad; of any sign, as the others
  double quadratic = 0;  ///< d_2, N s^2/m^2 or Nm s^2/rad^2
  double cubic = 0;      ///< d_3, N s^3/m^3 or Nm s^3/rad^3
};

namespace core {

/// A spring on a coordinate, at rest at q_0, whose force is a cubic polynomial of its deflection x:
///
///   x = q - q_0                                       (1)
///   f -= k_1 x + k_2 x^2 + k_3 x^3                    (2)
///   V = k_1 x^2/2 + k_2 x^3/3 + k_3 x^4/4             (3)
struct joint_cubic_stiffness_gen {
  static constexpr type_name type{"joint_cubic_stiffness", kind::gen};
  static constexpr std::array<port, 1> ports{{{kind::gen, access::on, "coordinate"}}};
  static constexpr const char* arguments = "{stiffness, quadratic, cubic, rest}";

  cubic_stiffness_parameters p;

  template <class C>
  KTE_INLINE constexpr auto doForce(const C& c) const {
    const auto x = c.q - p.rest;                                                // (1)
    return make_loads(-(x * (p.stiffness + x * (p.quadratic + x * p.cubic))));  // (2)
  }
  /// J
  template <class C>
  KTE_INLINE constexpr auto potential_energy(const C& c) const {
    const auto x = c.q - p.rest;
    return x * x * (p.stiffness / 2 + x * (p.quadratic / 3 + x * (p.cubic / 4)));  // (3)
  }
  constexpr void check(const parameter_check& where) const {
    where.finite(p.stiffness, "stiffness must be finite");
    where.finite(p.quadratic, "quadratic must be finite");
    where.finite(p.cubic, "cubic must be finite");
    where.finite(p.rest, "rest must be finite");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("stiffness", self.p.stiffness), visit("quadratic", self.p.quadratic), visit("cubic", self.p.cubic);
    visit("rest", self.p.rest);
  }
};

/// Damping of a coordinate by a cubic polynomial of its rate v, odd by |v|:
///
///   f -= d_1 v + d_2 |v| v + d_3 v^3          (1)
///
/// It is smooth at rest, where its slope is d_1. It dissipates energy at all rates if no coefficient is negative.
struct joint_cubic_damping_gen {
  static constexpr type_name type{"joint_cubic_damping", kind::gen};
  static constexpr std::array<port, 1> ports{{{kind::gen, access::on, "coordinate"}}};
  static constexpr const char* arguments = "{damping, quadratic, cubic}";

  cubic_damping_parameters p;

  template <class C>
  KTE_INLINE constexpr auto doForce(const C& c) const {
    return make_loads(force(c.q_dot));
  }
  constexpr void check(const parameter_check& where) const {
    where.finite(p.damping, "damping must be finite");
    where.finite(p.quadratic, "quadratic must be finite");
    where.finite(p.cubic, "cubic must be finite");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("damping", self.p.damping), visit("quadratic", self.p.quadratic), visit("cubic", self.p.cubic);
  }

 private:
  template <class V>
  KTE_INLINE constexpr auto force(const V& v) const {
    using std::abs;
    if constexpr (std::is_same_v<V, zero_t>) {
      return zero;
    } else {
      const V rate = abs(v);
      return V(-(v * (p.damping + rate * (p.quadratic + rate * p.cubic))));  // (1)
    }
  }
};

}  // namespace core

/// A spring with a cubic law on a coordinate:
///
///   joint_cubic_stiffness_gen(q, {.stiffness = -1, .cubic = 4})
template <class Q>
[[nodiscard]] constexpr auto joint_cubic_stiffness_gen(const Q& coordinate, const cubic_stiffness_parameters& p) {
  return connect(core::joint_cubic_stiffness_gen{p}, coordinate);
}
/// Damping of a coordinate by a cubic law:
///
///   joint_cubic_damping_gen(q, {.damping = 0.1, .quadratic = 0.02})
template <class Q>
[[nodiscard]] constexpr auto joint_cubic_damping_gen(const Q& coordinate, const cubic_damping_parameters& p) {
  return connect(core::joint_cubic_damping_gen{p}, coordinate);
}

KTE_CALL(joint_cubic_stiffness_gen, "(coordinate, parameters)")
KTE_CALL(joint_cubic_damping_gen, "(coordinate, parameters)")

}  // namespace kte
