#pragma once

#include <kte/chain/transmission.hpp>

namespace kte {

namespace core {

/// A linear damper between two coordinates, of damping c:
///
///   s = c (q_dot_2 - q_dot_1)           (1)
///   f_1 += s,  f_2 -= s                 (2)
template <class Damping>
struct damper_gen {
  static constexpr type_name type{"damper", kind::gen};
  static constexpr std::array<port, 2> ports{{{kind::gen, access::on, "anchor1"}, {kind::gen, access::on, "anchor2"}}};

  Damping damping;

  template <class C1, class C2>
  KTE_INLINE constexpr auto doForce(const C1& c1, const C2& c2) const {
    const auto s = damping * (c2.q_dot - c1.q_dot);  // (1)
    return make_loads(s, -s);                        // (2)
  }
  constexpr void check(const parameter_check& where) const {
    where.not_negative(damping, "damping must be finite and not negative");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("damping", self.damping);
  }
};

}  // namespace core

/// A damper between two coordinates: damping in N s/m, Nm s/rad.
template <class Q1, class Q2, entry Damping>
constexpr auto damper_gen(const Q1& anchor1, const Q2& anchor2, const Damping& damping) {
  return connect(core::damper_gen<decltype(real(damping))>{real(damping)}, anchor1, anchor2);
}

}  // namespace kte
