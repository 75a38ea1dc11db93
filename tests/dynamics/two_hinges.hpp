#pragma once

#include <kte/kte.hpp>

namespace kte::test {

/// A joint of two coordinates: about x, then about y.
struct two_hinges : transmission<two_hinges> {
  static constexpr type_name type{"two_hinges", kind::frame_3D};
  static constexpr std::array<port, 4> ports{{{kind::gen, access::angle, "coordinate1"},
                                              {kind::gen, access::angle, "coordinate2"},
                                              {kind::frame_3D, access::in, "base"},
                                              {kind::frame_3D, access::out, "end"}}};

  template <class A, class B>
  constexpr auto relative(const A& a, const B& b) const {
    const motion first{zero3{},           rotation_about(axis::x, a.cos, a.sin), zero3{}, axis::x * a.q_dot, zero3{},
                       axis::x * a.q_ddot};
    const motion second{zero3{},           rotation_about(axis::y, b.cos, b.sin), zero3{}, axis::y * b.q_dot, zero3{},
                        axis::y * b.q_ddot};
    return compose(first, second);
  }
  constexpr void check(const parameter_check&) const {}
  template <class Self, class Visit>
  static constexpr void parameters(Self&, Visit&&) {}
};

}  // namespace kte::test
