#pragma once

#include <kte/elements/closures/rotation_rows.hpp>

namespace kte {

namespace core {

/// Parameters of closures about an axis: a unit vector, equal in axes of both frames, and two normals to it.
struct axis_closure {
  vec3<> axis;
  detail::normals across;

  axis_closure() = default;
  constexpr explicit axis_closure(const vec3<>& u) : axis(u), across(detail::normals_of(u)) {}
  constexpr void check(const parameter_check& where) const { where.unit(axis, "axis must have length 1"); }
  /// Whether the axes of a closed loop do not point against each other.
  template <class M>
  constexpr bool upright(const M& m) const {
    return detail::cosine{}(m, axis, axis) > 0;
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("axis", self.axis);
    if constexpr (!std::is_const_v<Self>) self.across = detail::normals_of(self.axis);
  }
};

/// A hinge about the axis u, equal in axes of both frames, with t_1, t_2 normal to it:
///
///   g = (p, u . R t_1, u . R t_2)          (1)
struct hinge_3D : axis_closure, detail::rotation_closure<hinge_3D> {
  static constexpr std::string_view type = "hinge_3D";
  static constexpr auto ports = detail::closure_ports<kind::frame_3D>;
  static constexpr closure_rows rows{3, 2};
  using axis_closure::axis_closure;

  template <class M, class P, class Row>
  constexpr auto rows_at(const M& m, const P& p, const Row& c) const {
    return make_rows(p.x, p.y, p.z, c(m, axis, across.first), c(m, axis, across.second));
  }
};

/// A cylindrical joint that turns about and slides along the axis u:
///
///   g = (t_1 . p, t_2 . p, u . R t_1, u . R t_2)          (2)
struct cylindrical_3D : axis_closure, detail::rotation_closure<cylindrical_3D> {
  static constexpr std::string_view type = "cylindrical_3D";
  static constexpr auto ports = detail::closure_ports<kind::frame_3D>;
  static constexpr closure_rows rows{2, 2};
  using axis_closure::axis_closure;

  template <class M, class P, class Row>
  constexpr auto rows_at(const M& m, const P& p, const Row& c) const {
    return make_rows(dot(across.first, p), dot(across.second, p), c(m, axis, across.first), c(m, axis, across.second));
  }
};

/// A prismatic joint along the axis u, with h half of the axial vector of R:
///
///   g = (t_1 . p, t_2 . p, h)          (3)
///
/// In the plane one normal and one angle.
template <kind Dim>
struct sliding : axis_closure, detail::rotation_closure<sliding<Dim>> {
  static constexpr type_name type{"sliding", Dim};
  static constexpr auto ports = detail::closure_ports<Dim>;
  static constexpr closure_rows rows{Dim == kind::frame_2D ? 1 : 2, Dim == kind::frame_2D ? 1 : 3};
  using axis_closure::axis_closure;

  template <class M, class P, class Row>
  constexpr auto rows_at(const M& m, const P& p, const Row& row) const {
    const auto h = detail::half_axial(m, row);
    if constexpr (Dim == kind::frame_2D)
      return make_rows(axis.x * p.y - axis.y * p.x, h.z);
    else
      return make_rows(dot(across.first, p), dot(across.second, p), h.x, h.y, h.z);
  }
  template <class M>
  constexpr bool upright(const M& m) const {
    return m.rotation.x.x + m.rotation.y.y + m.rotation.z.z > 0;
  }
  constexpr void check(const parameter_check& where) const {
    axis_closure::check(where);
    if constexpr (Dim == kind::frame_2D) where.require(axis.z == 0, "axis must be in the plane", axis.z);
  }
};

/// A universal joint: two axes, u of A and t of B, stay normal to each other about one point:
///
///   g = (p, u . R t)          (4)
struct universal_3D : detail::rotation_closure<universal_3D> {
  static constexpr std::string_view type = "universal_3D";
  static constexpr auto ports = detail::closure_ports<kind::frame_3D>;
  static constexpr closure_rows rows{3, 1};

  vec3<> axis1, axis2;

  universal_3D() = default;
  constexpr universal_3D(const vec3<>& u, const vec3<>& t) : axis1(u), axis2(t) {}
  template <class M, class P, class Row>
  constexpr auto rows_at(const M& m, const P& p, const Row& row) const {
    return make_rows(p.x, p.y, p.z, row(m, axis1, axis2));
  }
  constexpr void check(const parameter_check& where) const {
    where.unit(axis1, "axis1 must have length 1"), where.unit(axis2, "axis2 must have length 1");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("axis1", self.axis1), visit("axis2", self.axis2);
  }
};

}  // namespace core

/// Closes a loop by a hinge about a unit axis, given in both frames: 3 rows, m, and 2 of cosines between the axis of
/// frame1 and normals of that of frame2.
template <class L, class A, class B, class X, class Y, class Z>
constexpr auto hinge_3D(const L& loop, const A& frame1, const B& frame2, const vec3<X, Y, Z>& axis) {
  return connect(core::hinge_3D(as<double>(axis)), frame1, frame2, loop);
}
/// Closes a loop by a cylindrical joint about the axis: 2 rows, m, and 2 of cosines.
template <class L, class A, class B, class X, class Y, class Z>
constexpr auto cylindrical_3D(const L& loop, const A& frame1, const B& frame2, const vec3<X, Y, Z>& axis) {
  return connect(core::cylindrical_3D(as<double>(axis)), frame1, frame2, loop);
}
/// Closes a loop by a prismatic joint along the axis of frame1: 2 rows, m, and 3 of sines.
template <class L, class A, class B, class X, class Y, class Z>
constexpr auto sliding_3D(const L& loop, const A& frame1, const B& frame2, const vec3<X, Y, Z>& axis) {
  return connect(core::sliding<kind::frame_3D>(as<double>(axis)), frame1, frame2, loop);
}
/// Closes a loop by a prismatic joint in the plane along the axis of frame1: 1 row, m, and 1 of a sine.
template <class L, class A, class B, class Axis>
constexpr auto sliding_2D(const L& loop, const A& frame1, const B& frame2, const Axis& axis) {
  return connect(core::sliding<kind::frame_2D>(as<double>(detail::planar(axis))), frame1, frame2, loop);
}
/// Closes a loop by a universal joint with a unit axis of frame1 and one of frame2, normal to each other: 3 rows, m,
/// and 1 of a cosine.
template <class L, class A, class B, class X, class Y, class Z, class U, class V, class W>
constexpr auto universal_3D(const L& loop, const A& frame1, const B& frame2, const vec3<X, Y, Z>& axis1,
                            const vec3<U, V, W>& axis2) {
  return connect(core::universal_3D(as<double>(axis1), as<double>(axis2)), frame1, frame2, loop);
}

KTE_CALL(hinge_3D, "(loop, frame1, frame2, axis)")
KTE_CALL(cylindrical_3D, "(loop, frame1, frame2, axis)")
KTE_CALL(sliding_2D, "(loop, frame1, frame2, axis)")
KTE_CALL(sliding_3D, "(loop, frame1, frame2, axis)")
KTE_CALL(universal_3D, "(loop, frame1, frame2, axis1, axis2)")

}  // namespace kte
