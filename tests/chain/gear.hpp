#pragma once

#include <kte/contract/element.hpp>
#include <kte/frames/coordinates.hpp>

#include <array>
#include <string_view>

namespace kte::test {

/// A gear between coordinates: q_end = ratio q_base, f_base += ratio f_end.
struct gear {
  static constexpr std::string_view type = "gear_gen";
  static constexpr std::array<port, 2> ports{{{kind::gen, access::in, "base"}, {kind::gen, access::out, "end"}}};
  double ratio;

  template <class C>
  constexpr auto doMotion(const C& c) const {
    return coordinate{ratio * c.q, ratio * c.q_dot, ratio * c.q_ddot, skip{}, skip{}};
  }
  template <class C, class F>
  constexpr auto doForce(const C&, const F& f) const {
    return make_loads(ratio * f);
  }
  constexpr void check(const parameter_check&) const {}
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("ratio", self.ratio);
  }
};

}  // namespace kte::test
