#pragma once

#include <kte/contract/transmission.hpp>

namespace kte {

namespace core {

/// Declares a frame or coordinate that no element of the chain moves: its motion is prescribed by the state.
template <kind Dim>
struct base {
  static constexpr type_name type{"base", Dim};
  static constexpr std::array<port, 1> ports{{{Dim, access::base, "base"}}};

  KTE_INLINE constexpr auto doForce() const { return make_loads(); }
  constexpr void check(const parameter_check&) const {}
  template <class Self, class Visit>
  static constexpr void parameters(Self&, Visit&&) {}
};

}  // namespace core

/// A coordinate with prescribed motion, for instance the fixed end of a spring. It is not a degree of freedom.
template <class Q>
[[nodiscard]] constexpr auto base_gen(const Q& coordinate) {
  return connect(core::base<kind::gen>{}, coordinate);
}
/// A further base in the plane. The first frame that a chain reads is a base without a declaration.
template <class F>
[[nodiscard]] constexpr auto base_2D(const F& frame) {
  return connect(core::base<kind::frame_2D>{}, frame);
}
/// A further base in space. The first frame that a chain reads is a base without a declaration.
template <class F>
[[nodiscard]] constexpr auto base_3D(const F& frame) {
  return connect(core::base<kind::frame_3D>{}, frame);
}

KTE_CALL(base_gen, "(coordinate)")
KTE_CALL(base_2D, "(frame)")
KTE_CALL(base_3D, "(frame)")

}  // namespace kte
