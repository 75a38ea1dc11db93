#pragma once

#include <kte/contact/surfaces.hpp>
#include <kte/errors.hpp>
#include <kte/math/dual.hpp>

namespace kte {

/// The ground below a smooth height z = h(x, y), m, in axes of the frame; in the plane y = h(x). `h` takes numbers of
/// any type, because it is differentiated with dual numbers. With N = (-h_x, -h_y, 1):
///
///   point:   s = (z - h)/|N|,  n = N/|N|  at x, y of the point                                        (1)
///   sphere:  the distance from its centre p to the nearest point f of the surface, by Newton's method:
///            F_i = f_i - p_i + (h - p_z) h_i = 0,   F_ij = delta_ij + h_i h_j + (h - p_z) h_ij        (2)
///            f_dot = F_ij^-1 (v_i + v_z h_i),   n_dot = (N_dot - n (n.N_dot))/|N|                     (3)
///
/// (1) is the distance at the surface, and near it to second order. A sphere must be smaller than the radii of
/// curvature of valleys.
template <class Height>
struct height_field {
  static constexpr bool holds_code = true;  ///< files cannot hold it
  /// Whether it is a curve y = h(x) of the plane.
  static constexpr bool in_plane = requires(const Height& h) { h(1.0); };

  Height height;

  constexpr explicit height_field(const Height& h) : height(h) {}
  template <kind Dim>
  constexpr const height_field& in() const {
    static_assert((Dim == kind::frame_2D) == in_plane,
                  "kte: a height field is a function h(x) in the plane, h(x, y) in space");
    return *this;
  }
  /// s and n for a sphere of a radius, m, about p.
  template <class S>
  constexpr surface_point<S> at(const vec3<S>& p, double radius) const {
    const auto x = upright(p);
    const ground<S> below = at_foot(x.x, x.y);
    const S rise = S(x.z - below.h), along = S(rise / below.steepness());
    if (radius == 0) return {along, turned(below.normal())};
    const ground<S> foot = nearest(x, along, radius);
    const vec3<S> n = foot.normal(), d{S(x.x - foot.x), S(x.y - foot.y), S(x.z - foot.h)};
    return {S(dot(n, d)), turned(n)};
  }
  /// n_dot where p moves by v.
  template <class S>
  constexpr vec3<S> bend(const vec3<S>& p, const vec3<S>& v, double radius) const {
    const auto x = upright(p), u = upright(v);
    ground<S> foot = at_foot(x.x, x.y);
    S fx = u.x, fy = u.y;
    if (radius != 0) {
      foot = nearest(x, S((x.z - foot.h) / foot.steepness()), radius);
      const auto solved = foot.solve(x.z, S(u.x + u.z * foot.hx), S(u.y + u.z * foot.hy));
      fx = solved.x, fy = solved.y;
    }
    const vec3<S> n = foot.normal();
    const vec3<S> turn{S(-(foot.hxx * fx + foot.hxy * fy)), S(-(foot.hxy * fx + foot.hyy * fy)), S(0)};
    return turned(as<S>(S(S(1) / foot.steepness()) * (turn - dot(n, turn) * n)));
  }
  template <kind Dim>
  constexpr void check(const parameter_check&) const {}
  template <class Self, class Visit>
  static constexpr void parameters(Self&, Visit&&) {}

 private:
  /// A point x, y, its height, and the derivatives of the height there.
  template <class S>
  struct ground {
    S x, y, h, hx, hy, hxx, hxy, hyy;

    constexpr S steepness() const {
      using std::sqrt;
      return S(sqrt(S(S(1) + hx * hx + hy * hy)));
    }
    constexpr vec3<S> normal() const {
      const S k = S(S(1) / steepness());
      return {S(-(k * hx)), S(-(k * hy)), k};
    }
    /// Whether F_ij of (2) is positive definite for a point at the height z.
    constexpr bool is_nearest(const S& z) const {
      const S e = S(h - z), xx = S(S(1) + hx * hx + e * hxx), xy = S(hx * hy + e * hxy);
      return all(xx > S(0)) && all(S(xx * (S(1) + hy * hy + e * hyy)) > S(xy * xy));
    }
    /// F_ij^-1 b of (2) for a point at the height z.
    constexpr vec2<S> solve(const S& z, const S& bx, const S& by) const {
      const S e = S(h - z), xx = S(S(1) + hx * hx + e * hxx), xy = S(hx * hy + e * hxy),
              yy = S(S(1) + hy * hy + e * hyy);
      const S k = S(S(1) / (xx * yy - xy * xy));
      return {S(k * (yy * bx - xy * by)), S(k * (xx * by - xy * bx))};
    }
  };

  template <class S>
  static constexpr vec3<S> upright(const vec3<S>& p) {
    if constexpr (in_plane)
      return {p.x, S(0), p.y};
    else
      return p;
  }
  template <class S>
  static constexpr vec3<S> turned(const vec3<S>& p) {
    if constexpr (in_plane)
      return {p.x, p.z, S(0)};
    else
      return p;
  }
  template <class S>
  [[gnu::noinline]] constexpr ground<S> at_foot(const S& x, const S& y) const {
    using first = dual<S, 2>;
    using second = dual<first, 2>;
    const auto variable = [](const S& value, std::size_t i) {
      first inner(value);
      inner.derivative[i] = S(1);
      second outer(inner);
      outer.derivative[i] = first(S(1));
      return outer;
    };
    const second h = [&] {
      if constexpr (in_plane)
        return second(height(variable(x, 0)));
      else
        return second(height(variable(x, 0), variable(y, 1)));
    }();
    const first &hx = h.derivative[0], &hy = h.derivative[1];
    return {x,
            y,
            h.value.value,
            h.value.derivative[0],
            h.value.derivative[1],
            hx.derivative[0],
            hx.derivative[1],
            hy.derivative[1]};
  }
  /// The point of the surface nearest to p; two more steps than converge in numbers, for their derivatives. Far from
  /// the surface, where Newton's method may fail, a point with a gap.
  template <class S>
  [[gnu::noinline]] constexpr ground<S> nearest(const vec3<S>& p, const S& distance, double radius) const {
    using std::abs;
    S x = p.x, y = p.y;
    int further = 0;
    for (int step = 0; step < 40 && further < 3; ++step) {
      const ground<S> g = at_foot(x, y);
      const S e = S(g.h - p.z);
      const auto d = g.solve(p.z, S(x - p.x + e * g.hx), S(y - p.y + e * g.hy));
      const S size = S(S(abs(x)) + S(abs(y)) + S(radius));
      x = S(x - d.x), y = S(y - d.y);
      further += all(S(S(abs(d.x)) + S(abs(d.y))) <= S(1e-9) * size) ? 1 : 0;
    }
    const ground<S> foot = at_foot(x, y);
    if (further == 3 && foot.is_nearest(p.z)) return foot;
    if (!all(S(abs(distance)) > S(2 * radius))) [[unlikely]]
      detail::raise<no_solution>(
          "kte: no point of a height field is nearest to a sphere on it: the radius of the sphere must be below the "
          "radii of curvature of valleys");
    return at_foot(p.x, p.y);
  }
};

}  // namespace kte
