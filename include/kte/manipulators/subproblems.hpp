#pragma once

#include <kte/math/axis_angle.hpp>
#include <kte/math/select.hpp>
#include <kte/math/sincos.hpp>

#include <cmath>
#include <limits>

/// The subproblems of closed-form inverse kinematics (Paden, Kinematics and Control of Robot Manipulators, 1986; Kahan,
/// Lectures on Computational Aspects of Geometry, 1983; Elias and Wen, IK-Geo, Mechanism and Machine Theory 209, 2025).
/// R(k, t) rotates by t about the unit vector k. All functions are generic in the scalar. Without an exact solution
/// they return the least-squares solution. Arguments must be finite; nothing is checked. Arc cosines are avoided, so
/// angles near the limits of reach keep their digits. There are no branches, so packs are supported.
namespace kte {

namespace detail {
/// A number as a double, without derivatives.
template <class S>
double double_of(const S& x) {
  if constexpr (requires { x.value; }) {
    return double_of(x.value);
  } else {
    return static_cast<double>(x);
  }
}
}  // namespace detail

/// An angle by its cosine `cos` and sine `sin`.
template <class S>
struct solved_angle {
  S cos = S(1), sin = S(0);

  /// The angle in [-pi, pi], rad.
  constexpr S value() const {
    using std::atan2;
    return atan2(sin, cos);
  }
  constexpr solved_angle operator-() const { return {cos, -sin}; }
  friend constexpr solved_angle operator+(const solved_angle& a, const solved_angle& b) {
    return {a.cos * b.cos - a.sin * b.sin, a.sin * b.cos + a.cos * b.sin};
  }
  friend constexpr solved_angle operator-(const solved_angle& a, const solved_angle& b) { return a + -b; }
};

namespace detail {
/// a where the condition holds, otherwise b.
template <class S>
constexpr solved_angle<S> chosen(const truth<S>& condition, const solved_angle<S>& a, const solved_angle<S>& b) {
  return {select(condition, a.cos, b.cos), select(condition, a.sin, b.sin)};
}
template <class S>
constexpr vec3<S> chosen(const truth<S>& condition, const vec3<S>& a, const vec3<S>& b) {
  return {select(condition, a.x, b.x), select(condition, a.y, b.y), select(condition, a.z, b.z)};
}
template <class S>
constexpr S size_of(const S& x) {
  return select(x < S(0), S(-x), x);
}
/// The square root of x if x > 0, otherwise 0.
template <class S>
constexpr S root_or_none(const S& x) {
  using std::sqrt;
  const truth<S> some = x > S(0);
  return select(some, S(sqrt(select(some, x, S(1)))), S(0));
}
}  // namespace detail

/// The angle of the direction (x, y); 0 at the origin.
template <class S>
[[nodiscard]] constexpr solved_angle<S> direction(const S& x, const S& y) {
  using std::sqrt;
  const S r = sqrt(S(x * x + y * y));
  const truth<S> some = r > S(0);
  const S size = select(some, r, S(1));
  return detail::chosen(some, solved_angle<S>{x / size, y / size}, solved_angle<S>{});
}
/// The angle t, rad, by its cosine and sine.
template <class S>
[[nodiscard]] solved_angle<S> angle_of(const S& t) {
  solved_angle<S> a;
  sincos(t, a.sin, a.cos);
  return a;
}

/// Two solutions f + g (`plus`) and f - g (`minus`).
template <class S>
struct two_angles {
  solved_angle<S> plus, minus;
  S slack{};        ///< distance to solvability, in units of the equation; both angles are then equal
  truth<S> free{};  ///< whether any angle is a solution
};

/// The rotated vector R(k, t) v = v cos t + (k x v) sin t + k (k.v) (1 - cos t).
template <class S, class K, class V>
[[nodiscard]] constexpr vec3<S> turned(const K& k, const solved_angle<S>& t, const V& v) {
  const vec3<S> kk = as<S>(k), x = as<S>(v);
  return t.cos * x + t.sin * cross(kk, x) + (dot(kk, x) * (S(1) - t.cos)) * kk;
}

namespace detail {
/// The implementation of `linear_in_angle` (1) with given h and room; `slack` is the excess of c over h.
template <class S>
constexpr two_angles<S> angles_with_room(const S& a, const S& b, const S& c, const S& h, const S& room, const S& over,
                                         const S& noise, const solved_angle<S>& otherwise) {
  using std::sqrt;
  const truth<S> free = !(h > noise), within = over < S(0);
  const S size = select(free, S(1), h);
  const solved_angle<S> f{a / size, b / size}, border{select(c < S(0), S(-1), S(1)), S(0)};
  const auto g = chosen(within, direction(c, S(sqrt(select(within, room, S(1))))), border);
  const solved_angle<S> opposite{-otherwise.cos, -otherwise.sin};
  return {chosen(free, otherwise, solved_angle<S>(f + g)), chosen(free, opposite, solved_angle<S>(f - g)),
          select(over > S(0), over, S(0)), free};
}
}  // namespace detail

/// Solves a cos t + b sin t = c:
///
///   h = |(a, b)|,  f = atan2(b, a),  t = f +- atan2(sqrt(room), c),  room = (h - c)(h + c)          (1)
///
/// If h does not exceed `noise`, any angle is a solution; the result is `otherwise` and the angle half a turn from it.
template <class S>
[[nodiscard]] constexpr two_angles<S> linear_in_angle(const S& a, const S& b, const S& c, const S& noise = S(0),
                                                      const solved_angle<S>& otherwise = {}) {
  using std::sqrt;
  const S h = sqrt(S(a * a + b * b)), over = detail::size_of(c) - h;
  return detail::angles_with_room(a, b, c, h, S((h - c) * (h + c)), over, noise, otherwise);
}

/// Solves R(k, t) p1 = p2:
///
///   t = atan2(k.(n1 x n2), n1.n2),  n1, n2 the parts of p1, p2 normal to k          (2)
///
/// in the least-squares sense; 0 if any t is a solution. (In exact arithmetic p1.p2 - (k.p1)(k.p2) and k.(p1 x p2) are
/// equal, but for vectors nearly along k they are differences of large numbers.)
template <class S, class K>
[[nodiscard]] constexpr solved_angle<S> subproblem1(const K& axis, const vec3<S>& p1, const vec3<S>& p2) {
  const vec3<S> k = as<S>(axis), n1 = p1 - dot(k, p1) * k, n2 = p2 - dot(k, p2) * k;
  return direction(S(dot(n1, n2)), S(dot(k, cross(n1, n2))));
}

/// Solves n.R(k, t) p = d by (1) with
///
///   a = n.p - (n.k)(k.p),  b = n.(k x p),  c = d - (n.k)(k.p)          (3)
template <class S, class K, class N>
[[nodiscard]] constexpr two_angles<S> subproblem4(const K& axis, const vec3<S>& p, const N& normal, const S& d,
                                                  const solved_angle<S>& otherwise = {}) {
  using std::sqrt;
  const vec3<S> k = as<S>(axis), n = as<S>(normal);
  const S along = dot(n, k) * dot(k, p);
  const S noise = S(24 * std::numeric_limits<S>::epsilon()) * sqrt(S(dot(n, n) * dot(p, p)));
  return linear_in_angle(S(dot(n, p) - along), S(dot(n, cross(k, p))), S(d - along), noise, otherwise);
}

/// Solutions of R(k1, t1) p1 = R(k2, t2) p2: pairs (t1.plus, t2.plus), (t1.minus, t2.minus) with t1 `first`, t2
/// `second`. t1 by (3) with n = k2, d = k2.p2. As both vectors have equal length, with n2 the part of p2 normal to k2
///
///   room = (|k1 x k2| |n2| - e)(|k1 x k2| |n2| + e),   e = k1.p1 - (k1.k2) d,          (4)
///
/// used if these are smaller than h and c, so that no digits are lost for p2 near k2. t2 follows from (2).
template <class S>
struct two_pairs {
  two_angles<S> first, second;
};
/// Solves R(k1, t1) p1 = R(k2, t2) p2, see `two_pairs`.
template <class S, class K1, class K2>
[[nodiscard]] constexpr two_pairs<S> subproblem2(const K1& axis1, const vec3<S>& p1, const K2& axis2,
                                                 const vec3<S>& p2) {
  using detail::size_of;
  using std::sqrt;
  const vec3<S> k1 = as<S>(axis1), k2 = as<S>(axis2), k12 = cross(k1, k2);
  const S cosine = dot(k1, k2), along1 = dot(k1, p1), d = dot(k2, p2);
  const vec3<S> n2 = p2 - d * k2;
  const S a = dot(k2, p1) - cosine * along1, b = dot(k2, cross(k1, p1)), c = d - cosine * along1;
  const S h = sqrt(S(a * a + b * b)), noise = S(24 * std::numeric_limits<S>::epsilon()) * sqrt(S(dot(p1, p1)));
  const S most = sqrt(S(dot(k12, k12) * dot(n2, n2))), e = along1 - cosine * d;
  const truth<S> close = most + size_of(e) < h + size_of(c);
  const S room = select(close, S((most - e) * (most + e)), S((h - c) * (h + c)));
  const auto t1 = detail::angles_with_room(a, b, c, h, room, S(-room / (h + size_of(c) + noise)), noise, {});
  const auto rest = [&](const solved_angle<S>& t) { return subproblem1(axis2, p2, turned(axis1, t, p1)); };
  return {t1, {rest(t1.plus), rest(t1.minus), t1.slack, {}}};
}

/// Solves |R(k, t) p1 - p2| = d by (3) with n = p2 and |p1|^2 + |p2|^2 - d^2 for twice the right-hand side. (For arms
/// use `triangle` of two_links.hpp, which loses no digits for stretched arms.)
template <class S, class K>
[[nodiscard]] constexpr two_angles<S> subproblem3(const K& k, const vec3<S>& p1, const vec3<S>& p2, const S& d) {
  return subproblem4(k, p1, p2, S((dot(p1, p1) + dot(p2, p2) - d * d) / S(2)));
}

}  // namespace kte
