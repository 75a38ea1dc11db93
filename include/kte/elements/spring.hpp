#pragma once

#include <kte/chain/transmission.hpp>

#include <algorithm>

namespace kte {

namespace core {

/// A linear spring between two coordinates, of stiffness k and rest length L:
///
///   s = k (q_2 - q_1 - L)                               (1)
///   f_1 += s,  f_2 -= s                                 (2)
///
/// with |s| limited to the saturation force where there is one (a typed zero: none). Its energy is k/2 (q_2 - q_1 -
/// L)^2.
template <class Rest, class Stiffness, class Saturation>
struct spring_gen {
  static constexpr type_name type{"spring", kind::gen};
  static constexpr std::array<port, 2> ports{{{kind::gen, access::on, "anchor1"}, {kind::gen, access::on, "anchor2"}}};

  Rest rest_length;
  Stiffness stiffness;
  Saturation saturation;

  template <class C1, class C2>
  KTE_INLINE constexpr auto doForce(const C1& c1, const C2& c2) const {
    const auto s = limited(stiffness * ((c2.q - c1.q) - rest_length));  // (1)
    return make_loads(s, -s);                                           // (2)
  }
  constexpr void check(const parameter_check& where) const {
    where.finite(rest_length, "rest length must be finite");
    where.not_negative(stiffness, "stiffness must be finite and not negative");
    where.not_negative(saturation, "saturation must be finite and not negative");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("rest_length", self.rest_length);
    visit("stiffness", self.stiffness);
    visit("saturation", self.saturation);
  }

 private:
  template <class S>
  KTE_INLINE constexpr S limited(const S& s) const {
    if constexpr (typed_constant<Saturation> || typed_constant<S>) {
      return s;
    } else {  // in this order NaN stays NaN
      using std::max;
      using std::min;
      return saturation == 0 ? s : S(max(S(min(s, S(saturation))), S(-saturation)));
    }
  }
};

}  // namespace core

/// A spring between two coordinates: rest length (m, rad), stiffness (N/m, Nm/rad), and optionally the force at which
/// it saturates (N, Nm).
template <class Q1, class Q2, entry Rest, entry Stiffness, entry Saturation = zero_t>
constexpr auto spring_gen(const Q1& anchor1, const Q2& anchor2, const Rest& rest_length, const Stiffness& stiffness,
                          const Saturation& saturation = {}) {
  using core_type =
      core::spring_gen<decltype(real(rest_length)), decltype(real(stiffness)), decltype(real(saturation))>;
  return connect(core_type{real(rest_length), real(stiffness), real(saturation)}, anchor1, anchor2);
}

}  // namespace kte
