#pragma once

#include <kte/contract/closure.hpp>
#include <kte/elements/closures/rotation_rows.hpp>

namespace kte {

namespace core {

/// The origin of B on a line of A, through its origin along the unit vector u, with n_k normal to u:
///
///   g = n_k . p,   n_k . R v,   n_k . R a          (1)
template <kind Dim>
struct point_on_line : closure<point_on_line<Dim>> {
  static constexpr type_name type{"point_on_line", Dim};
  static constexpr auto ports = detail::closure_ports<Dim>;
  static constexpr closure_rows rows{Dim == kind::frame_2D ? 1 : 2, 0};

  vec3<> axis;
  detail::normals across;

  point_on_line() = default;
  constexpr explicit point_on_line(const vec3<>& u) : axis(u), across(detail::normals_of(u)) {}
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
  constexpr void check(const parameter_check& where) const {
    where.unit(axis, "axis must have length 1");
    if constexpr (Dim == kind::frame_2D) where.require(axis.z == 0, "axis must be in the plane", axis.z);
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("axis", self.axis);
    if constexpr (!std::is_const_v<Self>) self.across = detail::normals_of(self.axis);
  }

 private:
  template <class V>
  constexpr auto of(const V& v) const {
    if constexpr (Dim == kind::frame_2D)
      return make_rows(axis.x * v.y - axis.y * v.x);
    else
      return make_rows(dot(across.first, v), dot(across.second, v));
  }
};

/// The origin of B in a plane of A, through its origin with the unit normal n:
///
///   g = n . p,   n . R v,   n . R a          (2)
struct point_on_plane_3D : closure<point_on_plane_3D> {
  static constexpr std::string_view type = "point_on_plane_3D";
  static constexpr auto ports = detail::closure_ports<kind::frame_3D>;
  static constexpr closure_rows rows{1, 0};

  vec3<> normal;

  point_on_plane_3D() = default;
  constexpr explicit point_on_plane_3D(const vec3<>& n) : normal(n) {}
  template <class M>
  constexpr auto residual(const M& m) const {
    return make_rows(dot(normal, m.position));
  }
  template <class M>
  constexpr auto residual_dot(const M& m) const {
    return make_rows(dot(normal, m.rotation * m.velocity));
  }
  template <class M>
  constexpr auto residual_ddot(const M& m) const {
    return make_rows(dot(normal, m.rotation * m.acceleration));
  }
  constexpr void check(const parameter_check& where) const { where.unit(normal, "normal must have length 1"); }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("normal", self.normal);
  }
};

/// The origins of two frames at a distance L > 0, a massless rod between them:
///
///   g = (p . p - L^2) / (2 L),   p . R v / L,   (p . R a + v . v) / L          (3)
///
/// It is quadratic, so smooth also where the points meet during an assembly. Its derivatives by L:
///
///   -(p . p + L^2) / (2 L^2),   -(p . R v) / L^2,   -(p . R a + v . v) / L^2          (4)
template <kind Dim>
struct distance : closure<distance<Dim>> {
  static constexpr type_name type{"distance", Dim};
  static constexpr auto ports = detail::closure_ports<Dim>;
  static constexpr closure_rows rows{1, 0};

  double length;

  distance() = default;
  constexpr explicit distance(double l) : length(l) {}
  template <class M>
  constexpr auto residual(const M& m) const {
    return make_rows((dot(m.position, m.position) - length * length) / (2 * length));
  }
  template <class M>
  constexpr auto residual_dot(const M& m) const {
    return make_rows(dot(m.position, m.rotation * m.velocity) / length);
  }
  template <class M>
  constexpr auto residual_ddot(const M& m) const {
    return make_rows((dot(m.position, m.rotation * m.acceleration) + dot(m.velocity, m.velocity)) / length);
  }
  static constexpr std::array<std::string_view, 1> parameter_names{"length"};
  template <class M>
  constexpr auto by_parameter(int, const M& m, int order) const {
    const auto g = order == 0 ? (dot(m.position, m.position) + length * length) / (2 * length)
                              : nth<0>(order == 1 ? residual_dot(m) : residual_ddot(m));
    return make_rows(-g / length);
  }
  constexpr void check(const parameter_check& where) const {
    where.positive(length, "length must be finite and positive");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("length", self.length);
  }
};

}  // namespace core

/// Closes a loop by a pin in a straight slot of frame1, along the unit vector `axis` through its origin, in the plane:
/// 1 row, m.
template <class L, class A, class B, class Axis>
constexpr auto point_on_line_2D(const L& loop, const A& frame1, const B& frame2, const Axis& axis) {
  return connect(core::point_on_line<kind::frame_2D>(as<double>(detail::planar(axis))), frame1, frame2, loop);
}
/// Closes a loop by a pin in a straight slot of frame1 in space: 2 rows, m.
template <class L, class A, class B, class X, class Y, class Z>
constexpr auto point_on_line_3D(const L& loop, const A& frame1, const B& frame2, const vec3<X, Y, Z>& axis) {
  return connect(core::point_on_line<kind::frame_3D>(as<double>(axis)), frame1, frame2, loop);
}
/// Closes a loop by a point on a plane of frame1 with the unit normal: 1 row, m.
template <class L, class A, class B, class X, class Y, class Z>
constexpr auto point_on_plane_3D(const L& loop, const A& frame1, const B& frame2, const vec3<X, Y, Z>& normal) {
  return connect(core::point_on_plane_3D(as<double>(normal)), frame1, frame2, loop);
}
/// Closes a loop by a massless rod of a length, m, between the origins of two frames in the plane: 1 row, m. A positive
/// force pushes them apart.
template <class L, class A, class B>
constexpr auto distance_2D(const L& loop, const A& frame1, const B& frame2, double length) {
  return connect(core::distance<kind::frame_2D>(length), frame1, frame2, loop);
}
/// Closes a loop by a massless rod of a length, m, between the origins of two frames in space: 1 row, m.
template <class L, class A, class B>
constexpr auto distance_3D(const L& loop, const A& frame1, const B& frame2, double length) {
  return connect(core::distance<kind::frame_3D>(length), frame1, frame2, loop);
}

KTE_CALL(point_on_line_2D, "(loop, frame1, frame2, axis)")
KTE_CALL(point_on_line_3D, "(loop, frame1, frame2, axis)")
KTE_CALL(point_on_plane_3D, "(loop, frame1, frame2, normal)")
KTE_CALL(distance_2D, "(loop, frame1, frame2, length)")
KTE_CALL(distance_3D, "(loop, frame1, frame2, length)")

}  // namespace kte
