#pragma once

#include <kte/elements/closures/rotation_rows.hpp>

namespace kte {

namespace core {

/// Two frames welded together, with h half of the axial vector of R, the sine of the rotation error:
///
///   g = (p, h),   (R v, h_dot),   (R a, h_ddot)          (1)
///
/// h is zero at half a turn too: `assemble` rejects it.
template <kind Dim>
struct coincident_frames : detail::rotation_closure<coincident_frames<Dim>> {
  static constexpr type_name type{"coincident_frames", Dim};
  static constexpr auto ports = detail::closure_ports<Dim>;
  static constexpr closure_rows rows{Dim == kind::frame_2D ? 2 : 3, Dim == kind::frame_2D ? 1 : 3};

  template <class M, class P, class Row>
  static constexpr auto rows_at(const M& m, const P& p, const Row& row) {
    const auto h = detail::half_axial(m, row);
    if constexpr (Dim == kind::frame_2D)
      return make_rows(p.x, p.y, h.z);
    else
      return make_rows(p.x, p.y, p.z, h.x, h.y, h.z);
  }
  /// Whether the rotation of a closed loop is not half a turn off.
  template <class M>
  constexpr bool upright(const M& m) const {
    return m.rotation.x.x + m.rotation.y.y + m.rotation.z.z > 0;
  }
  constexpr void check(const parameter_check&) const {}
  template <class Self, class Visit>
  static constexpr void parameters(Self&, Visit&&) {}
};

}  // namespace core

/// Closes a loop by welding two frames of the plane together: 2 rows, m, and 1 of the sine of the angle between them.
template <class L, class A, class B>
constexpr auto coincident_frames_2D(const L& loop, const A& frame1, const B& frame2) {
  return connect(core::coincident_frames<kind::frame_2D>{}, frame1, frame2, loop);
}
/// Closes a loop by welding two frames in space together: 3 rows, m, and 3 of sines.
template <class L, class A, class B>
constexpr auto coincident_frames_3D(const L& loop, const A& frame1, const B& frame2) {
  return connect(core::coincident_frames<kind::frame_3D>{}, frame1, frame2, loop);
}

KTE_CALL(coincident_frames_2D, "(loop, frame1, frame2)")
KTE_CALL(coincident_frames_3D, "(loop, frame1, frame2)")

}  // namespace kte
