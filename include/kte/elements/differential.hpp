#pragma once

#include <kte/contract/transmission.hpp>

namespace kte {

namespace core {

/// A coordinate that is a weighted sum of two others: a differential, a planetary gear.
///
///   q_e = a q_1 + b q_2,   f_1 += a f_e,   f_2 += b f_e          (1)
template <class A, class B>
struct differential {
  static constexpr type_name type{"differential", kind::gen};
  static constexpr std::array<port, 3> ports{
      {{kind::gen, access::in, "base1"}, {kind::gen, access::in, "base2"}, {kind::gen, access::out, "end"}}};

  A ratio1;
  B ratio2;

  template <class C1, class C2>
  KTE_INLINE constexpr auto doMotion(const C1& c1, const C2& c2) const {
    return coordinate{ratio1 * c1.q + ratio2 * c2.q, ratio1 * c1.q_dot + ratio2 * c2.q_dot,
                      ratio1 * c1.q_ddot + ratio2 * c2.q_ddot, skip{}, skip{}};
  }
  template <class C1, class C2, class F>
  KTE_INLINE constexpr auto doForce(const C1&, const C2&, const F& f) const {
    return make_loads(ratio1 * f, ratio2 * f);
  }
  constexpr void check(const parameter_check& where) const {
    where.finite(ratio1, "ratio1 must be finite");
    where.finite(ratio2, "ratio2 must be finite");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("ratio1", self.ratio1), visit("ratio2", self.ratio2);
  }
};

}  // namespace core

/// A coordinate `end` = ratio1 base1 + ratio2 base2. The cage of a differential turns by half the sum of its shafts:
/// ratios 0.5 and 0.5. A wrist driven by two belts has two of these.
template <class B1, class B2, class E, entry Ratio1, entry Ratio2>
[[nodiscard]] constexpr auto differential_gen(const B1& base1, const B2& base2, const E& end, const Ratio1& ratio1,
                                              const Ratio2& ratio2) {
  return connect(core::differential<decltype(real(ratio1)), decltype(real(ratio2))>{real(ratio1), real(ratio2)}, base1,
                 base2, end);
}

KTE_CALL(differential_gen, "(base1, base2, end, ratio1, ratio2)")

}  // namespace kte
