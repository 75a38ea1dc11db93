#pragma once

#include <kte/manipulators/detail/six_axes.hpp>
#include <kte/manipulators/quartic_subproblems.hpp>

namespace kte::detail {

/// Axes 4, 5, 6 through the point w from joint 1, axes 1, 2, 3 anyhow, by subproblem 5:
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
    x.branch = (t.slot & 3u) | (t.slot & 4u) << 1;
    const auto R36 = turned_matrix(h3, -t.third, turned_matrix(h2, -t.second, turned_matrix(h1, -t.first, R06)));
    with_meeting_axes(s, 3, R36, x, seed, wrist_bit, [&out](const raw_answer<S>& y) { out.add(y); });
  }
  return out;
}

/// Axes 2, 3, 4 parallel to h, by subproblem 6 for q1 and q5, w from joint 1 to joint 6:
///
///   h.R(h1, -q1) w = h.(p12 + p23 + p34 + p45) + h.R(h5, q5) p56
///   h.R(h1, -q1) R06 h6 = h.R(h5, q5) h6;   R(h6, q6) y = R(h5, -q5) h,  y = R06^T R(h1, q1) h          (2)
///
/// and the parallel axes from there, with p45 + R(h5, q5) p56 in place of p45.
template <class S>
raw_answers<S> parallel_and_two_axes(const arm_structure& s, const rotation_matrix<S>& R06, const vec3<S>& position,
                                     const joint_turns<S>& seed) {
  const vec3<>&h1 = s.h(0), &h = s.h(1), &h5 = s.h(4), &h6 = s.h(5);
  const vec3<S> w = position - as<S>(s.p(0)), p12 = as<S>(s.p(1) - s.p(0)), p56 = as<S>(s.p(5) - s.p(4));
  const vec3<S> axis6 = as<S>(h6), normal = cross(as<S>(h), as<S>(h5));
  const auto l1 = linear_part_of(h, vec3<>(-h1), w), l5 = linear_part_of(h, h5, p56);
  const auto a1 = linear_part_of(h, vec3<>(-h1), vec3<S>(R06 * axis6)), a5 = linear_part_of(h, h5, axis6);
  const S unit = S(1 / s.reach);
  raw_answers<S> out;
  for (const auto& t : subproblem6<S>(
           {{{unit * l1.cos, unit * l1.sin}, {a1.cos, a1.sin}}},
           {{{-unit * l5.cos, -unit * l5.sin}, {-a5.cos, -a5.sin}}},
           {S(unit * (S(dot(h, s.p(4) - s.p(0))) + l5.constant - l1.constant)), S(a5.constant - a1.constant)})) {
    raw_answer<S> x{};
    const auto R16 = turned_matrix(h1, -t.first, R06);
    const auto t6 = subproblem1(h6, vec3<S>(transpose(R16) * as<S>(h)), turned(h5, -t.second, as<S>(h)));
    const auto t14 = subproblem1(h, normal, vec3<S>(R16 * turned(h6, -t6, turned(h5, -t.second, normal))));
    x.turn.put(0, t.first), x.turn.put(4, t.second), x.turn.put(5, t6);
    x.branch = (t.slot & 1u) | (t.slot & 2u) << 1 | (t.slot & 4u) << 1;
    const vec3<S> p45 = as<S>(s.p(4) - s.p(3)) + turned(h5, t.second, p56);
    with_parallel_axes(s, vec3<S>(turned(h1, -t.first, w) - p12), t14, x, p45, seed,
                       [&out](const raw_answer<S>& y) { out.add(y); });
  }
  return out;
}

}  // namespace kte::detail
