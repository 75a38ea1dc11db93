#pragma once

#include <kte/contract/no_parameters.hpp>
#include <kte/elements/spring.hpp>

namespace kte {

namespace core {

/// An actuator between two coordinates, whose force u is a signal, N or Nm: f_1 -= u, f_2 += u.
struct force_actuator_gen : no_parameters {
  static constexpr type_name type{"force_actuator", kind::gen};
  static constexpr std::array<port, 3> ports{
      {{kind::gen, access::on, "anchor1"}, {kind::gen, access::on, "anchor2"}, {kind::input, access::in, "input"}}};

  template <class A, class B, class U>
  KTE_INLINE constexpr auto doForce(const A&, const B&, const U& u) const {
    return make_loads(-u, u);
  }
};
/// An actuator between the origins of two frames, along the line through them: a cylinder, a muscle. Its force u is a
/// signal, N; positive values push:
///
///   e = (p_2 - p_1) / |p_2 - p_1|,   F_1 -= u e,   F_2 += u e          (1)
///
/// Where the origins coincide there is no force.
template <kind Dim>
struct force_actuator : no_parameters {
  static constexpr type_name type{"force_actuator", Dim};
  static constexpr std::array<port, 3> ports{
      {{Dim, access::on, "anchor1"}, {Dim, access::on, "anchor2"}, {kind::input, access::in, "input"}}};
  static constexpr bool reads_positions = true;

  template <class A, class B, class U>
  KTE_INLINE constexpr auto doForce(const A& a, const B& b, const U& u) const {
    return detail::opposite_forces(a, b, -(u * detail::to_polar(b.position - a.position).direction));  // (1)
  }
};

}  // namespace core

/// An actuator between two coordinates: the signal `input`, N or Nm, drives the second, and the first in the opposite
/// direction.
template <class Q1, class Q2, class U>
[[nodiscard]] constexpr auto force_actuator_gen(const Q1& anchor1, const Q2& anchor2, const U& input) {
  return connect(core::force_actuator_gen{}, anchor1, anchor2, input);
}
/// An actuator between the origins of two frames in the plane: the signal `input`, N, pushes them apart.
template <class F1, class F2, class U>
[[nodiscard]] constexpr auto force_actuator_2D(const F1& anchor1, const F2& anchor2, const U& input) {
  return connect(core::force_actuator<kind::frame_2D>{}, anchor1, anchor2, input);
}
/// An actuator between the origins of two frames in space: the signal `input`, N, pushes them apart.
template <class F1, class F2, class U>
[[nodiscard]] constexpr auto force_actuator_3D(const F1& anchor1, const F2& anchor2, const U& input) {
  return connect(core::force_actuator<kind::frame_3D>{}, anchor1, anchor2, input);
}

KTE_CALL(force_actuator_gen, "(anchor1, anchor2, input)")
KTE_CALL(force_actuator_2D, "(anchor1, anchor2, input)")
KTE_CALL(force_actuator_3D, "(anchor1, anchor2, input)")

}  // namespace kte
