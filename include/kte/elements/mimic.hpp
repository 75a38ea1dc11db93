#pragma once

#include <kte/contract/transmission.hpp>

namespace kte {

namespace core {

/// A coordinate that follows another: by a gear, a rack, a belt, a parallel finger.
///
///   q_e = r q_b + c,   f_b += r f_e          (1)
template <class Ratio, class Offset>
struct mimic {
  static constexpr type_name type{"mimic", kind::gen};
  static constexpr std::array<port, 2> ports{{{kind::gen, access::in, "base"}, {kind::gen, access::out, "end"}}};

  Ratio ratio;
  Offset offset;

  template <class C>
  KTE_INLINE constexpr auto doMotion(const C& c) const {
    return coordinate{ratio * c.q + offset, ratio * c.q_dot, ratio * c.q_ddot, skip{}, skip{}};
  }
  template <class C, class F>
  KTE_INLINE constexpr auto doForce(const C&, const F& f) const {
    return make_loads(ratio * f);
  }
  constexpr void check(const parameter_check& where) const {
    where.finite(ratio, "ratio must be finite");
    where.finite(offset, "offset must be finite");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("ratio", self.ratio), visit("offset", self.offset);
  }
};

}  // namespace core

/// A coordinate `end` that is `ratio` times another, plus `offset`: a gear has the ratio of its radii (negative where
/// they turn against each other), a rack the radius of its pinion, m/rad.
template <class B, class E, entry Ratio, entry Offset = zero_t>
[[nodiscard]] constexpr auto mimic_gen(const B& base, const E& end, const Ratio& ratio, const Offset& offset = {}) {
  return connect(core::mimic<decltype(real(ratio)), decltype(real(offset))>{real(ratio), real(offset)}, base, end);
}

KTE_CALL(mimic_gen, "(base, end, ratio[, offset])")

}  // namespace kte
