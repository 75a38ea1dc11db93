#pragma once

#include <kte/manipulators/subproblems.hpp>

/// Two links and an elbow: subproblem 3 without differences of squares, so that stretched and folded arms keep their
/// digits.
namespace kte {

/// The angle between two links normal to k at which they span a distance D, |l1 + R(k, t) l2| = D. With the lengths r1,
/// r2 of the links and the angle t0 from l2 to l1:
///
///   t = t0 +- 2 atan2(sqrt((r1 + r2 - D)(r1 + r2 + D)), sqrt((D - (r1 - r2))(D + (r1 - r2))))          (1)
///
/// If D is out of reach, the links are stretched or folded, and `slack`, m, is the missing distance.
template <class S, class K>
[[nodiscard]] constexpr two_angles<S> elbow_angles(const K& k, const vec3<S>& l1, const vec3<S>& l2, const S& D) {
  using std::sqrt;
  const S r1 = sqrt(dot(l1, l1)), r2 = sqrt(dot(l2, l2));
  const S longer = select(r1 > r2, r1, r2), shorter = select(r1 > r2, r2, r1);
  const S outside = D - (r1 + r2), inside = (longer - shorter) - D;
  const auto t0 = subproblem1(k, l2, l1);
  const truth<S> stretched = !(outside < S(0)), folded = !(inside < S(0));
  const auto root = [](const truth<S>& none, const S& x) { return S(sqrt(select(none, S(1), x))); };
  const auto between =
      direction(root(folded, S(-inside * (D + longer - shorter))), root(stretched, S(-outside * (r1 + r2 + D))));
  const solved_angle<S> straight, back{S(0), S(1)};
  const auto half = detail::chosen(stretched, straight, detail::chosen(folded, back, between)), g = half + half;
  const S slack = select(outside > S(0), outside, select(inside > S(0), inside, S(0)));
  return {t0 + g, t0 - g, slack, {}};
}

/// The angles of two links that reach a point: R(k, t2)(l1 + R(k, t3) l2) = a, all normal to k. t3 by (1) with D = |a|,
/// then t2 by subproblem 1: pairs (t2.plus, t3.plus), (t2.minus, t3.minus). t2 is arbitrary if the links fold to a
/// point.
template <class S>
struct triangle_angles {
  two_angles<S> t2, t3;
};
/// Solves R(k, t2)(l1 + R(k, t3) l2) = a, see `triangle_angles`.
template <class S, class K>
[[nodiscard]] constexpr triangle_angles<S> triangle(const K& k, const vec3<S>& l1, const vec3<S>& l2, const vec3<S>& a,
                                                    const solved_angle<S>& otherwise = {}) {
  using std::sqrt;
  const S D = sqrt(dot(a, a)), noise = S(8 * std::numeric_limits<S>::epsilon()) * sqrt(S(dot(l1, l1) + dot(l2, l2)));
  const auto t3 = elbow_angles(k, l1, l2, D);
  const truth<S> to_a_point = detail::both<truth<S>>(!(D > noise), !(t3.slack > noise));
  const auto rest = [&](const solved_angle<S>& t) {
    return detail::chosen(to_a_point, otherwise, subproblem1(k, vec3<S>(l1 + turned(k, t, l2)), a));
  };
  return {{rest(t3.plus), rest(t3.minus), t3.slack, to_a_point}, t3};
}

namespace detail {
/// Solves |a + R(k, t) b| = l: the elbow angle for the components normal to k, whose distance is sqrt(l^2 - (k.(a +
/// b))^2).
template <class S, class K>
two_angles<S> angles_of_length(const K& axis, const vec3<S>& a, const vec3<S>& b, const S& l) {
  const vec3<S> k = as<S>(axis);
  const S along_a = dot(k, a), along_b = dot(k, b), along = along_a + along_b, room = (l - along) * (l + along);
  return elbow_angles(k, vec3<S>(a - along_a * k), vec3<S>(b - along_b * k), root_or_none(room));
}
}  // namespace detail

}  // namespace kte
