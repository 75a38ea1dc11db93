#pragma once

#include <kte/contract/element.hpp>
#include <kte/frames/coordinates.hpp>

#include <array>
#include <string_view>

namespace kte::test {

/// A coordinate that follows another by a ratio that changes: q_e = q_b^2.
struct square {
  static constexpr std::string_view type = "square_gen";
  static constexpr std::array<port, 2> ports{{{kind::gen, access::in, "base"}, {kind::gen, access::out, "end"}}};
  template <class C>
  constexpr auto doMotion(const C& c) const {
    const auto twice = c.q + c.q;
    return coordinate{c.q * c.q, twice * c.q_dot, (c.q_dot + c.q_dot) * c.q_dot + twice * c.q_ddot, skip{}, skip{}};
  }
  template <class C, class F>
  constexpr auto doForce(const C& c, const F& f) const {
    return make_loads((c.q + c.q) * f);
  }
  constexpr void check(const parameter_check&) const {}
  template <class Self, class Visit>
  static constexpr void parameters(Self&, Visit&&) {}
};

}  // namespace kte::test
