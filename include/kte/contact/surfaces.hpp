#pragma once

#include <kte/contract/parameter_check.hpp>
#include <kte/kernels/polar.hpp>

/// Surfaces of a frame A that points and spheres touch. Every surface has, for a point p in axes of A and the radius r
/// of the sphere about it (0: a point), in numbers of any scalar,
///
///   at(p, r)            the distance s > 0 outside, m, and the unit normal n = grad s          (1)
///   bend(p, v, r)       n_dot = H v, with the second derivative H of s, where p moves by v     (2)
namespace kte {

/// (1)
template <class S>
struct surface_point {
  S distance;      ///< s, m
  vec3<S> normal;  ///< n
};

/// The shapes of `contact_surface`; `any` only while it is read from a file.
enum class surface_shape : unsigned char {
  any,         ///< not known yet
  half_space,  ///< below a plane
  ball,        ///< outside a sphere
  bowl,        ///< inside a sphere
  cylinder     ///< outside a cylinder
};

/// A half space, ball, bowl or cylinder. With d = p, for a cylinder the part of p normal to its axis:
///
///   half space   s = n.p             H = 0
///   ball         s = |d| - R         n = d/|d|,   H = (1 - n n^T)/|d|
///   bowl         s = R - |d|         n = -d/|d|,  H = -(1 - n n^T)/|d|
///   cylinder     s = |d| - R         n = d/|d|,   H = (1 - n n^T - a a^T)/|d|
struct contact_surface {
  surface_shape shape = surface_shape::any;  ///< what it is
  vec3<> axis{};      ///< the normal of a half space, zero for that of its dimension; the axis of a cylinder
  double radius = 0;  ///< m

  /// The surface in the plane or in space: without a normal, a half space has y in the plane, z in space.
  template <kind Dim>
  constexpr contact_surface in() const {
    const bool unset = shape == surface_shape::half_space && axis == vec3<>{};
    if (!unset) return *this;
    return {shape, Dim == kind::frame_2D ? vec3<>{0, 1, 0} : vec3<>{0, 0, 1}, 0};
  }
  /// (1)
  template <class S>
  KTE_INLINE constexpr surface_point<S> at(const vec3<S>& p, double) const {
    if (shape == surface_shape::half_space) return {S(dot(axis, p)), as<S>(axis)};
    const auto [length, direction] = detail::to_polar(across(p));
    if (shape == surface_shape::bowl) return {S(S(radius) - length), as<S>(-direction)};
    return {S(length - S(radius)), as<S>(direction)};
  }
  /// (2)
  template <class S>
  KTE_INLINE constexpr vec3<S> bend(const vec3<S>& p, const vec3<S>& v, double) const {
    if (shape == surface_shape::half_space) return {S(0), S(0), S(0)};
    const auto [length, n] = detail::to_polar(across(p));
    const S none = S(0), far = select(length == none, S(1), S(length));
    const S curvature = S(S(shape == surface_shape::bowl ? -1 : 1) / far);
    const vec3<S> u = across(v);
    return as<S>(curvature * (u - dot(n, u) * n));
  }
  template <kind Dim>
  constexpr void check(const parameter_check& where) const {
    switch (shape) {
      case surface_shape::any:
        return where.require(false, "a contact needs one surface: normal, ball_radius, bowl_radius or cylinder_radius",
                             0);
      case surface_shape::half_space:
        where.unit(axis, "normal must have length 1");
        if constexpr (Dim == kind::frame_2D) where.require(axis.z == 0, "normal must be in the plane", axis.z);
        return;
      case surface_shape::ball:
        return where.positive(radius, "ball_radius must be finite and positive");
      case surface_shape::bowl:
        return where.positive(radius, "bowl_radius must be finite and positive");
      case surface_shape::cylinder:
        where.require(Dim == kind::frame_3D, "a cylinder is a surface in space: take a ball in the plane", radius);
        where.positive(radius, "cylinder_radius must be finite and positive");
        where.unit(axis, "cylinder_axis must have length 1");
    }
  }
  /// The parameters of its shape; those of all shapes, all optional, if it is `any`.
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    switch (self.shape) {
      case surface_shape::any:
        return any_parameters(self, visit);
      case surface_shape::half_space:
        return visit("normal", self.axis);
      case surface_shape::ball:
        return visit("ball_radius", self.radius);
      case surface_shape::bowl:
        return visit("bowl_radius", self.radius);
      case surface_shape::cylinder:
        visit("cylinder_radius", self.radius), visit("cylinder_axis", self.axis);
    }
  }

 private:
  template <class S>
  KTE_INLINE constexpr vec3<S> across(const vec3<S>& p) const {
    if (shape != surface_shape::cylinder) return p;
    return as<S>(p - dot(axis, p) * axis);
  }
  template <class Self, class Visit>
  static constexpr void any_parameters(Self& self, Visit&& visit) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    vec3<> normal{none, none, none}, along{0, 0, 1};
    double ball = none, bowl = none, cylinder = none;
    visit("normal", normal), visit("ball_radius", ball), visit("bowl_radius", bowl);
    visit("cylinder_radius", cylinder), visit("cylinder_axis", along);
    if constexpr (!std::is_const_v<Self>) {
      const auto given = [](double x) { return x == x; };
      if (given(normal.x) + given(ball) + given(bowl) + given(cylinder) != 1) return;
      if (given(normal.x)) self = {surface_shape::half_space, normal, 0};
      if (given(ball)) self = {surface_shape::ball, {}, ball};
      if (given(bowl)) self = {surface_shape::bowl, {}, bowl};
      if (given(cylinder)) self = {surface_shape::cylinder, along, cylinder};
    }
  }
};

/// The half space below a plane through the origin of the frame; its unit normal points outwards, by default along y in
/// the plane, z in space.
struct half_space : contact_surface {
  constexpr half_space() : contact_surface{surface_shape::half_space, {}, 0} {}
  template <class X, class Y, class Z>
  constexpr explicit half_space(const vec3<X, Y, Z>& normal)
      : contact_surface{surface_shape::half_space, as<double>(normal), 0} {}
  template <class X, class Y>
  constexpr explicit half_space(const vec2<X, Y>& normal) : half_space(vec3{normal.x, normal.y, zero}) {}
};
/// The outside of a ball of a radius, m, about the origin of the frame; a disc in the plane.
struct ball : contact_surface {
  constexpr explicit ball(double radius_of_ball) : contact_surface{surface_shape::ball, {}, radius_of_ball} {}
};
/// The inside of a sphere of a radius, m, about the origin of the frame; of a circle in the plane.
struct bowl : contact_surface {
  constexpr explicit bowl(double radius_of_bowl) : contact_surface{surface_shape::bowl, {}, radius_of_bowl} {}
};
/// The outside of a cylinder of a radius, m, without ends, whose axis, by default z, goes through the origin of the
/// frame.
struct cylinder : contact_surface {
  constexpr explicit cylinder(double radius_of_cylinder) : cylinder(radius_of_cylinder, vec3<>{0, 0, 1}) {}
  template <class X, class Y, class Z>
  constexpr cylinder(double radius_of_cylinder, const vec3<X, Y, Z>& along)
      : contact_surface{surface_shape::cylinder, as<double>(along), radius_of_cylinder} {}
};

}  // namespace kte
