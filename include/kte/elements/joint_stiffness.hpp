#pragma once

#include <kte/elements/spring.hpp>

namespace kte {

namespace core {

/// A linear spring of stiffness k on a coordinate, at rest at q_0:
///
///   f -= k (q - q_0)          (1)
template <class Stiffness, class Rest>
struct joint_stiffness_gen {
  static constexpr type_name type{"joint_stiffness", kind::gen};
  static constexpr std::array<port, 1> ports{{{kind::gen, access::on, "coordinate"}}};

  Stiffness stiffness;
  Rest rest;

  template <class C>
  KTE_INLINE constexpr auto doForce(const C& c) const {
    return make_loads(-(stiffness * (c.q - rest)));  // (1)
  }
  /// J
  template <class C>
  KTE_INLINE constexpr auto potential_energy(const C& c) const {
    return detail::elastic_energy(c.q - rest, stiffness, zero);
  }
  constexpr void check(const parameter_check& where) const {
    where.not_negative(stiffness, "stiffness must be finite and not negative");
    where.finite(rest, "rest must be finite");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("stiffness", self.stiffness), visit("rest", self.rest);
  }
};

}  // namespace core

/// A spring on a coordinate: stiffness, N/m or Nm/rad, and the coordinate at rest, m or rad. `spring_gen` acts between
/// two coordinates.
template <class Q, entry Stiffness, entry Rest = zero_t>
[[nodiscard]] constexpr auto joint_stiffness_gen(const Q& coordinate, const Stiffness& stiffness,
                                                 const Rest& rest = {}) {
  return connect(
      core::joint_stiffness_gen<decltype(real(stiffness)), decltype(real(rest))>{real(stiffness), real(rest)},
      coordinate);
}

KTE_CALL(joint_stiffness_gen, "(coordinate, stiffness[, rest])")

}  // namespace kte
