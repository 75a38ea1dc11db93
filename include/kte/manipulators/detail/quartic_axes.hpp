#pragma once

#include <kte/manipulators/detail/six_axes.hpp>
#include <kte/manipulators/quartic_subproblems.hpp>

namespace kte::detail {

/// Axes 4, 5, 6 meet in the point w from joint 1; axes 1, 2, 3 are arbitrary. By subproblem 5:
///
///   R(h1, -q1) w - p12 = R(h2, q2)(p23 + R(h3, q3) p34);   q4..q6 of axes that meet          (1)
template <class S>
raw_answers<S> wrist_and_three_axes(const arm_structure& s, const rotation_matrix<S>& R06, const vec3<S>& position,
                                    const joint_turns<S>& seed) {
  const vec3<>&h1 = s.h(0), &h2 = s.h(1), &h3 = s.h(2);
  raw_answers<S> out;
  for (const auto& t : subproblem5(as<S>(s.p(0) - s.p(1)), vec3<S>(position - as<S>(s.p(0))), as<S>(s.p(2) - s.p(1)),
                                   as<S>(s.p(3) - s.p(2)), vec3<>(-h1), h2, h3)) {
    raw_answer<S> x{};
    x.turn.put(0, t.first), x.turn.put(1, t.second), x.turn.put(2, t.third);
    unsigned branch = (t.slot & 3u) | (t.slot & 4u) << 1;
    const auto R36 = turned_matrix(h3, -t.third, turned_matrix(h2, -t.second, turned_matrix(h1, -t.first, R06)));
    for (const auto& y : both_of_meeting_axes(s, 3, R36, x, seed)) out.add(y, branch, 6), branch |= wrist_bit;
  }
  return out;
}

/// Axes 2, 3, 4 parallel to h: q1, q6, q5 by subproblem 6, w from joint 1 to joint 6:
///
///   h.R(h1, -q1) w = h.(p12 + p23 + p34 + p45) + h.R(h5, q5) p56
///   h.R(h1, -q1) R06 h6 = h.R(h5, q5) h6;   R(h6, q6) y = R(h5, -q5) h,  y = R06^T R(h1, q1) h          (2)
///
/// If h6 is nearly along h, the cosine of the angle between them is inaccurate, and so are two solutions that differ by
/// half a turn of q6. Then the last equation of (2) is solved directly: its component normal to h6, and the first
/// equation along it (detail/three_axes_loop.hpp).
template <class S>
short_list<three_solved_angles<S>, 8> around_parallel_axes(const arm_structure& s, const rotation_matrix<S>& R06,
                                                           const vec3<S>& w) {
  const vec3<>&h1 = s.h(0), &h = s.h(1), &h5 = s.h(4), &h6 = s.h(5);
  const vec3<S> along = as<S>(h), axis6 = as<S>(h6), p56 = as<S>(s.p(5) - s.p(4)), zero{S(0), S(0), S(0)};
  const auto l1 = linear_part_of(h, vec3<>(-h1), w), l5 = linear_part_of(h, h5, p56);
  const auto a1 = linear_part_of(h, vec3<>(-h1), vec3<S>(R06 * axis6)), a5 = linear_part_of(h, h5, axis6);
  const S unit = S(1 / s.reach), offset = S(dot(h, s.p(4) - s.p(0)));
  const auto R60 = transpose(R06);
  const auto loop = [&] {
    const auto part = [&](const vec3<S>& v, const S& l) { return normal_to(h6, v) + (unit * l) * axis6; };
    const auto y = point_turned(zero, as<S>(h1), along), z = point_turned(zero, as<S>(vec3<>(-h5)), along);
    return three_axes_loop<S>{
        {part(R60 * y.centre, l1.constant - offset), part(R60 * y.along, l1.cos), part(R60 * y.across, l1.sin)},
        {part(z.centre, l5.constant), part(z.along, l5.cos), part(z.across, l5.sin)},
        -axis6};
  };
  short_list<three_solved_angles<S>, 8> all;
  for (const auto& t : subproblem6<S>({{{unit * l1.cos, unit * l1.sin}, {a1.cos, a1.sin}}},
                                      {{{-unit * l5.cos, -unit * l5.sin}, {-a5.cos, -a5.sin}}},
                                      {S(unit * (offset + l5.constant - l1.constant)), S(a5.constant - a1.constant)})) {
    // At an angle of 1e-3 the cosine gives it to 1e-13, which Newton's steps refine at the end.
    const S cosine = a5.constant + a5.cos * t.second.cos + a5.sin * t.second.sin;
    if (S(1) - cosine * cosine < S(1e-6)) {
      loop().add_closed(t.first, t.second, t.slot, all);
    } else if (all.size() < 8) {
      const vec3<S> y = R60 * turned(h1, t.first, along);
      all.push_back({t.first, subproblem1(h6, y, turned(h5, -t.second, along)), t.second, t.slot});
    }
  }
  return all;
}

/// Solves for the parallel axes, with p45 + R(h5, q5) p56 instead of p45. If h6 is along h, q6 is free, or restricted
/// by reach, as in (3) of detail/six_axes.hpp.
template <class S>
raw_answers<S> parallel_and_two_axes(const arm_structure& s, const rotation_matrix<S>& R06, const vec3<S>& position,
                                     const joint_turns<S>& seed) {
  using std::sqrt;
  const vec3<>&h1 = s.h(0), &h = s.h(1), &h5 = s.h(4), &h6 = s.h(5);
  const vec3<S> w = position - as<S>(s.p(0)), p12 = as<S>(s.p(1) - s.p(0)), p56 = as<S>(s.p(5) - s.p(4));
  const vec3<S> normal = cross(as<S>(h), as<S>(h5));
  raw_answers<S> out;
  for (const auto& [t1, found6, t5, slot] : around_parallel_axes(s, R06, w)) {
    raw_answer<S> x{};
    const auto R16 = turned_matrix(h1, -t1, R06);
    const auto behind = turned(h5, -t5, normal);
    const auto t14_of = [&](const solved_angle<S>& t6) {
      return subproblem1(h, normal, vec3<S>(R16 * turned(h6, -t6, behind)));
    };
    auto t6 = found6, t14 = t14_of(t6);
    const vec3<S> a = turned(h1, -t1, w) - p12, p45 = as<S>(s.p(4) - s.p(3)) + turned(h5, t5, p56);
    const vec3<S> y = transpose(R16) * as<S>(h), off = normal_to(h6, y);
    const S size = sqrt(dot(off, off)), noise = S(24 * std::numeric_limits<S>::epsilon());
    if (size < S(4e8) * noise) {  // beyond, the reach is violated by less than 1e-8
      const bool free = !(size > noise);
      if (free) x.free = S(46), t6 = seed.at(5), t14 = t14_of(t6);  // q2, q3, q4 change with q6
      const S unknown = S(4) * noise / size;                        // of turned axes
      if (const auto way = way_into_reach(s, normal_to(h, a), t14, p45, free, unknown); way.sin != S(0))
        t6 = t6 + (dot(y, as<S>(h6)) > S(0) ? -way : way), t14 = t14_of(t6);
    }
    x.turn.put(0, t1), x.turn.put(4, t5), x.turn.put(5, t6);
    unsigned branch = (slot & 1u) | (slot & 2u) << 1 | (slot & 4u) << 1;
    for (const auto& z : both_of_parallel_axes(s, a, t14, x, p45, seed)) out.add(z, branch, 6), branch |= elbow_bit;
  }
  return out;
}

}  // namespace kte::detail
