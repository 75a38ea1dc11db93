#pragma once

#include <kte/elements/damper.hpp>

namespace kte {

namespace core {

/// A linear damper of the relative rotation of two frames, of damping c:
///
///   t = c (R_2 w_2 - R_1 w_1)                           (1)
///   T_1 += R_1^T t,  T_2 -= R_2^T t                     (2)
///
/// There is no force. In the plane R is the identity.
template <kind Dim, class Damping>
struct torsion_damper : damper_parameters<Damping> {
  static constexpr type_name type{"torsion_damper", Dim};
  static constexpr std::array<port, 2> ports{{{Dim, access::on, "anchor1"}, {Dim, access::on, "anchor2"}}};
  static constexpr bool reads_positions = true;

  template <class A, class B>
  KTE_INLINE constexpr auto doForce(const A& a, const B& b) const {
    const auto t = this->damping * (b.rotation * b.ang_velocity - a.rotation * a.ang_velocity);  // (1)
    return make_loads(wrench{zero3{}, transpose(a.rotation) * t},
                      wrench{zero3{}, -(transpose(b.rotation) * t)});  // (2)
  }
};

}  // namespace core

/// A damper of the relative rotation of two frames in the plane: damping, Nm s/rad.
template <class F1, class F2, entry Damping>
[[nodiscard]] constexpr auto torsion_damper_2D(const F1& anchor1, const F2& anchor2, const Damping& damping) {
  return connect(core::torsion_damper<kind::frame_2D, decltype(real(damping))>{{real(damping)}}, anchor1, anchor2);
}
/// A damper of the relative rotation of two frames in space: damping, Nm s/rad.
template <class F1, class F2, entry Damping>
[[nodiscard]] constexpr auto torsion_damper_3D(const F1& anchor1, const F2& anchor2, const Damping& damping) {
  return connect(core::torsion_damper<kind::frame_3D, decltype(real(damping))>{{real(damping)}}, anchor1, anchor2);
}

KTE_CALL(torsion_damper_2D, "(anchor1, anchor2, damping)")
KTE_CALL(torsion_damper_3D, "(anchor1, anchor2, damping)")

}  // namespace kte
