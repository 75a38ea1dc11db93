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

/// A half space, ball, bowl or cylinder, by an axis a and a radius R. With d = p, or, of a cylinder, its part normal to
/// a:
///
///   half space   R = 0: the side of a, its unit normal      s = a.p             n = a,       H = 0
///   ball         R > 0, a = 0: outside                      s = |d| - R         n = d/|d|,   H = (1 - n n^T)/|d|
///   bowl         R < 0, a = 0: inside                       s = -R - |d|        n = -d/|d|,  H = -(1 - n n^T)/|d|
///   cylinder     a of length 1: outside, inside for R < 0   as these            H = +-(1 - n n^T - a a^T)/|d|
struct contact_surface {
  vec3<> axis{};      ///< a
  double radius = 0;  ///< R, m

  /// The surface in the plane or in space: without a normal, a half space has y in the plane, z in space.
  template <kind Dim>
  constexpr contact_surface in() const {
    const bool unset = axis == vec3<>{} && radius == 0;
    return unset ? contact_surface{Dim == kind::frame_2D ? vec3<>{0, 1, 0} : vec3<>{0, 0, 1}, 0} : *this;
  }
  /// (1)
  template <class S>
  KTE_INLINE constexpr surface_point<S> at(const vec3<S>& p, double) const {
    if (radius == 0) return {S(dot(axis, p)), as<S>(axis)};
    const auto [length, direction] = detail::to_polar(across(p));
    if (radius < 0) return {S(S(-radius) - length), as<S>(-direction)};
    return {S(length - S(radius)), as<S>(direction)};
  }
  /// (2)
  template <class S>
  KTE_INLINE constexpr vec3<S> bend(const vec3<S>& p, const vec3<S>& v, double) const {
    if (radius == 0) return {S(0), S(0), S(0)};
    const auto [length, n] = detail::to_polar(across(p));
    const S reach = select(length == S(0), S(1), S(length)), curvature = S(S(radius < 0 ? -1 : 1) / reach);
    const vec3<S> u = across(v);
    return as<S>(curvature * (u - dot(n, u) * n));
  }
  template <kind Dim>
  constexpr void check(const parameter_check& where) const {
    where.finite(radius, "surface_radius must be finite");
    where.finite(axis, "surface_axis must be finite");
    if (radius == 0 || axis != vec3<>{})
      where.unit(axis, "surface_axis must have length 1, or be zero with a surface_radius");
    if (Dim == kind::frame_2D && radius == 0)
      where.require(axis.z == 0, "the normal surface_axis must be in the plane", axis.z);
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("surface_axis", self.axis), visit("surface_radius", self.radius);
  }

 private:
  template <class S>
  KTE_INLINE constexpr vec3<S> across(const vec3<S>& p) const {
    return axis == vec3<>{} ? p : as<S>(p - dot(axis, p) * axis);
  }
};

namespace detail {
/// Rejects a radius that is not finite and positive.
constexpr double radius_of_surface(double radius) {
  const auto text = [radius] {
    return "kte: the radius of a ball, bowl or cylinder must be finite and positive, got " + number(radius);
  };
  require<bad_parameter>(radius > 0 && radius <= (std::numeric_limits<double>::max)(), text,
                         "the radius of a ball, bowl or cylinder must be finite and positive", radius);
  return radius;
}
}  // namespace detail

/// The half space below a plane through the origin of the frame. Its unit normal points outwards, by default along y in
/// the plane, z in space.
struct half_space : contact_surface {
  constexpr half_space() = default;
  constexpr half_space(const vec3<>& normal) : contact_surface{normal, 0} {  // NOLINT(google-explicit-constructor)
    const auto text = [] { return std::string("kte: the normal of a half space must have length 1, got 0"); };
    detail::require<bad_parameter>(normal != vec3<>{}, text, "the normal of a half space must have length 1");
  }
  template <class X, class Y, class Z>
  constexpr half_space(const vec3<X, Y, Z>& normal) : half_space(as<double>(normal)) {}  // NOLINT
  template <class X, class Y>
  constexpr half_space(const vec2<X, Y>& normal) : half_space(vec3{normal.x, normal.y, zero}) {}  // NOLINT
};
/// The outside of a ball of a radius, m, about the origin of the frame; of a circle in the plane.
struct ball_surface : contact_surface {
  constexpr explicit ball_surface(double radius_of_ball)
      : contact_surface{{}, detail::radius_of_surface(radius_of_ball)} {}
};
/// The inside of a sphere of a radius, m, about the origin of the frame; of a circle in the plane.
struct bowl_surface : contact_surface {
  constexpr explicit bowl_surface(double radius_of_bowl)
      : contact_surface{{}, -detail::radius_of_surface(radius_of_bowl)} {}
};
/// The outside of a cylinder of a radius, m, without ends, whose axis, by default z, goes through the origin of the
/// frame. In the plane, with an axis in the plane, it is a straight bar.
struct cylinder_surface : contact_surface {
  constexpr explicit cylinder_surface(double radius_of_cylinder)
      : cylinder_surface(radius_of_cylinder, vec3<>{0, 0, 1}) {}
  template <class X, class Y, class Z>
  constexpr cylinder_surface(double radius_of_cylinder, const vec3<X, Y, Z>& along)
      : contact_surface{as<double>(along), detail::radius_of_surface(radius_of_cylinder)} {}
};

}  // namespace kte
