#pragma once

#include <kte/contract/closure.hpp>

namespace kte {

namespace core {

/// The origins of two frames at one point: a hinge in the plane, a ball joint in space.
///
///   g = p,   R v,   R a          (1)
template <kind Dim>
struct coincident_points : closure<coincident_points<Dim>> {
  static constexpr type_name type{"coincident_points", Dim};
  static constexpr auto ports = detail::closure_ports<Dim>;
  static constexpr closure_rows rows{Dim == kind::frame_2D ? 2 : 3, 0};

  template <class M>
  constexpr auto residual(const M& m) const {
    return of(m.position);
  }
  template <class M>
  constexpr auto residual_dot(const M& m) const {
    return of(m.rotation * m.velocity);
  }
  template <class M>
  constexpr auto residual_ddot(const M& m) const {
    return of(m.rotation * m.acceleration);
  }
  constexpr void check(const parameter_check&) const {}
  template <class Self, class Visit>
  static constexpr void parameters(Self&, Visit&&) {}

 private:
  template <class V>
  static constexpr auto of(const V& v) {
    if constexpr (Dim == kind::frame_2D)
      return make_rows(v.x, v.y);
    else
      return make_rows(v.x, v.y, v.z);
  }
};

}  // namespace core

/// Closes a loop by a hinge in the plane between the origins of two frames: 2 rows, m. `loop` names the closure and its
/// forces, which act on frame2, in axes of frame1.
template <class L, class A, class B>
constexpr auto coincident_points_2D(const L& loop, const A& frame1, const B& frame2) {
  return connect(core::coincident_points<kind::frame_2D>{}, frame1, frame2, loop);
}
/// Closes a loop by a ball joint between the origins of two frames: 3 rows, m.
template <class L, class A, class B>
constexpr auto coincident_points_3D(const L& loop, const A& frame1, const B& frame2) {
  return connect(core::coincident_points<kind::frame_3D>{}, frame1, frame2, loop);
}

KTE_CALL(coincident_points_2D, "(loop, frame1, frame2)")
KTE_CALL(coincident_points_3D, "(loop, frame1, frame2)")

}  // namespace kte
