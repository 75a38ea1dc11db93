#pragma once

#include <kte/manipulators/detail/angle_pairs.hpp>

namespace kte {

/// A solution of subproblem 5: the angles `first`, `second` and `third`.
template <class S>
struct three_solved_angles {
  solved_angle<S> first, second, third;
  unsigned slot;  ///< identifies the solution; two that differ only in bit 0 coincide at a double solution
};

namespace detail {

/// A point on a circle: centre + cos t along + sin t across.
template <class S>
struct turning_point {
  vec3<S> centre, along, across;

  vec3<S> at(const solved_angle<S>& t) const { return centre + t.cos * along + t.sin * across; }
  vec3<S> rate(const solved_angle<S>& t) const { return t.cos * across - t.sin * along; }
  S squares() const { return dot(centre, centre) + dot(along, along) + dot(across, across); }
};
/// The circle from + R(k, t) p.
template <class S>
turning_point<S> point_turned(const vec3<S>& from, const vec3<S>& k, const vec3<S>& p) {
  const vec3<S> fixed = dot(k, p) * k;
  return {from + fixed, p - fixed, cross(k, p)};
}

/// Refines b(t1) = R(k2, t2) a(t3). t1 and t3 come from squares and have errors of rounding/n, with the component n of
/// the points normal to k2. Near axis 2 this is not enough: two solutions whose t2 differ by half a turn have nearly
/// the same t1 and t3, or were merged. With the residual of the loop
///
///   d = b - R2 a,  r its direction normal to k2,  c1 = db/dt1,  c3 = R2 da/dt3,
///
/// Newton's steps solve u.c1 dt1 - u.c3 dt3 = -u.d for u = k2 and u = r; t2 is then computed again.          (1)
template <class S>
struct three_axes_loop {
  turning_point<S> b, a;
  vec3<S> k2;

  using list = short_list<three_solved_angles<S>, 8>;

  void add_closed(const solved_angle<S>& t1, const solved_angle<S>& t3, unsigned slot, list& out) const {
    const double size = double_of(S(a.squares() + b.squares()));
    const double eps = double_of(std::numeric_limits<S>::epsilon()), least = size * 16 * eps * eps;
    const auto start = closed_by_second({t1, {}, t3, slot});
    const auto found = closed(start, least);
    const vec3<S> side = cross(k2, start.a);
    const auto add = [&](const place& x) {
      const vec3<S> arm = cross(k2, x.a);
      const double moved = std::sqrt(double_of(S(dot(arm, arm)) / size));  // by a rotation of 1 rad about axis 2
      if (!knows(out, x.t, 64 * eps / moved) && out.size() < 8) out.push_back(x.t);
    };
    if (!(double_of(S(dot(side, side))) <= 1e-10 * size)) return add(found);
    const double enough = (std::max)(1e-20, 1e6 * eps * eps) * size;
    auto over = start;
    over.t.second = {-start.t.second.cos, -start.t.second.sin};
    over.t.slot ^= 1u, over.d = gap(over);
    for (const auto& x : {found, closed(over, least)})
      if (double_of(S(dot(x.d, x.d))) < enough) add(x);
  }

 private:
  struct place {
    three_solved_angles<S> t;
    vec3<S> a, b, d;  ///< the points, and their difference
  };
  vec3<S> gap(const place& x) const { return x.b - turned(k2, x.t.second, x.a); }
  /// Whether t is in `all`, with t2 uncertain by `unknown`.
  static bool knows(const list& all, const three_solved_angles<S>& t, double unknown) {
    for (const auto& x : all)
      if (same_angle(x.first, t.first) && same_angle(x.third, t.third) && same_angle(x.second, t.second, unknown))
        return true;
    return false;
  }
  place closed_by_second(const three_solved_angles<S>& t) const {
    place x{t, a.at(t.third), b.at(t.first), {}};
    x.t.second = subproblem1(k2, x.a, x.b), x.d = gap(x);
    return x;
  }
  place closed(place x, double least) const {
    using std::sqrt;
    double part = 1;
    for (int k = 0; k < 40 && part > 1e-7 && double_of(S(dot(x.d, x.d))) > least; ++k) {
      const vec3<S> side = x.d - dot(k2, x.d) * k2, c1 = b.rate(x.t.first),
                    c3 = turned(k2, x.t.second, a.rate(x.t.third));
      const S l = sqrt(dot(side, side));
      if (!(l > S(0))) break;
      const vec3<S> r = (S(1) / l) * side;
      const S m00 = dot(k2, c1), m01 = -dot(k2, c3), m10 = dot(r, c1), m11 = -dot(r, c3), det = m00 * m11 - m01 * m10;
      const S d0 = dot(k2, x.d), d1 = dot(r, x.d);
      const S step1 = (m01 * d1 - m11 * d0) / det, step3 = (m10 * d0 - m00 * d1) / det;
      if (!(step1 * step1 + step3 * step3 < S(1e-4))) break;
      auto t = x.t;
      t.first = t.first + angle_of(S(S(part) * step1)), t.third = t.third + angle_of(S(S(part) * step3));
      const auto next = closed_by_second(t);
      const bool nearer = dot(next.d, next.d) < dot(x.d, x.d);
      part = nearer ? 1 : part / 2;
      if (nearer) x = next;
    }
    return x;
  }
};

}  // namespace detail
}  // namespace kte
