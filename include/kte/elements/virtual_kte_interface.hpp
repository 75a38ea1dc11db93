#pragma once

#include <kte/contract/no_parameters.hpp>
#include <kte/contract/transmission.hpp>

namespace kte {

namespace core {

/// A frame of a virtual model, attached to a frame of the mechanism. The virtual model moves with the mechanism, and
/// its loads are transmitted with reversed sign, as the controller applies them:
///
///   X_end = X_base,   F -= F',   T -= T'          (1)
///
/// so that tau of inverse dynamics includes the loads of the virtual model on the mechanism, reversed (Pratt and
/// others, Int. J. Robotics Research 20 (2001) 129, "virtual model control").
template <kind Dim>
struct virtual_kte_interface : transmission<virtual_kte_interface<Dim>>, no_parameters {
  static constexpr type_name type{"virtual_kte_interface", Dim};
  static constexpr std::array<port, 2> ports{{{Dim, access::in, "base"}, {Dim, access::out, "end"}}};
  static constexpr bool power_dual = false;
  using transmission<virtual_kte_interface>::doMotion;

  KTE_INLINE constexpr auto relative() const { return at_rest(no_rotation{}, zero3{}); }
  template <class Frame, class F, class T>
  KTE_INLINE constexpr auto doForce(const Frame&, const wrench<F, T>& end) const {
    return make_loads(wrench{-end.force, -end.torque});  // (1)
  }
};

/// A coordinate of a virtual model, attached to a coordinate of the mechanism: q_e = q_b, f_b -= f_e.
template <>
struct virtual_kte_interface<kind::gen> : no_parameters {
  static constexpr type_name type{"virtual_kte_interface", kind::gen};
  static constexpr std::array<port, 2> ports{{{kind::gen, access::in, "base"}, {kind::gen, access::out, "end"}}};
  static constexpr bool power_dual = false;

  template <class C>
  KTE_INLINE constexpr auto doMotion(const C& base) const {
    return coordinate{base.q, base.q_dot, base.q_ddot, skip{}, skip{}};
  }
  template <class C, class F>
  KTE_INLINE constexpr auto doForce(const C&, const F& end) const {
    return make_loads(-end);
  }
};

}  // namespace core

/// Attaches a coordinate of a virtual model to the mechanism: `end` moves as `base`, and loads on it are transmitted
/// with reversed sign. For passes and inverse dynamics only.
template <class B, class E>
constexpr auto virtual_kte_interface_gen(const B& base, const E& end) {
  return connect(core::virtual_kte_interface<kind::gen>{}, base, end);
}
/// Attaches a frame in the plane of a virtual model to the mechanism; see `virtual_kte_interface_gen`.
template <class B, class E>
constexpr auto virtual_kte_interface_2D(const B& base, const E& end) {
  return connect(core::virtual_kte_interface<kind::frame_2D>{}, base, end);
}
/// Attaches a frame in space of a virtual model to the mechanism; see `virtual_kte_interface_gen`.
template <class B, class E>
constexpr auto virtual_kte_interface_3D(const B& base, const E& end) {
  return connect(core::virtual_kte_interface<kind::frame_3D>{}, base, end);
}

KTE_CALL(virtual_kte_interface_gen, "(base, end)")
KTE_CALL(virtual_kte_interface_2D, "(base, end)")
KTE_CALL(virtual_kte_interface_3D, "(base, end)")

}  // namespace kte
