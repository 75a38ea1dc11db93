#pragma once

#include <kte/contact/surfaces.hpp>
#include <kte/errors.hpp>
#include <kte/math/dual.hpp>

namespace kte {

/// A surface by your function f(p) of a point in axes of the frame, zero on the surface and positive outside. It takes
/// a `vec3` of numbers of any type, as it is differentiated with dual numbers; in the plane p.z is 0.
///
///   s = f/|grad f|,   n = grad f/|grad f|,   H v = (f_pp v - n (n.f_pp v))/|grad f|          (1)
///
/// This is the distance at the surface, and near it to first order. A sphere needs a true distance: |grad f| = 1 to
/// 1e-6, or `bad_argument` is raised.
///
///   surface([](const auto& p) { return p.x * p.x / 4 + p.y * p.y + p.z * p.z - 1; })       // an ellipsoid, for points
template <class Distance>
struct surface {
  static constexpr bool holds_code = true;  ///< files cannot hold it

  Distance distance;

  constexpr explicit surface(const Distance& f) : distance(f) {}
  template <kind Dim>
  constexpr const surface& in() const {
    return *this;
  }
  /// s and n for a sphere of a radius, m, about p.
  template <class S>
  KTE_INLINE constexpr surface_point<S> at(const vec3<S>& p, double radius) const {
    using number = dual<S, 3>;
    vec3<number> x{number(p.x), number(p.y), number(p.z)};
    x.x.derivative[0] = x.y.derivative[1] = x.z.derivative[2] = S(1);
    const number f(distance(x));
    const auto [length, n] = detail::to_polar(vec3<S>{f.derivative[0], f.derivative[1], f.derivative[2]});
    if (radius != 0) check_distance(length);
    return {S(f.value / length), as<S>(n)};
  }
  /// n_dot where p moves by v.
  template <class S>
  KTE_INLINE constexpr vec3<S> bend(const vec3<S>& p, const vec3<S>& v, double) const {
    using gradient = dual<S, 3>;
    using number = dual<gradient, 1>;
    const auto along = [](const S& x, const S& rate, std::size_t i) {
      gradient value(x);
      value.derivative[i] = S(1);
      number moved(value);
      moved.derivative[0] = gradient(rate);
      return moved;
    };
    const number f(distance(vec3<number>{along(p.x, v.x, 0), along(p.y, v.y, 1), along(p.z, v.z, 2)}));
    const auto in_numbers = [](const gradient& g) {
      return vec3<S>{g.derivative[0], g.derivative[1], g.derivative[2]};
    };
    const auto [length, n] = detail::to_polar(in_numbers(f.value));
    const vec3<S> turn = in_numbers(f.derivative[0]);
    return as<S>(S(S(1) / length) * (turn - dot(n, turn) * n));
  }
  template <kind Dim>
  constexpr void check(const parameter_check&) const {}
  template <class Self, class Visit>
  static constexpr void parameters(Self&, Visit&&) {}

 private:
  template <class S>
  static constexpr void check_distance(const S& slope) {
    if (!all(slope > S(1 - 1e-6)) || !all(slope < S(1 + 1e-6))) [[unlikely]]
      detail::raise<bad_argument>(
          "kte: a sphere touches a surface(f) only if f is a distance, |grad f| = 1 to 1e-6: take a point, or a "
          "height_field");
  }
};

}  // namespace kte
