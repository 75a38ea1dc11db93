#pragma once

#include <kte/manipulators/detail/eight_answers.hpp>
#include <kte/manipulators/two_links.hpp>

namespace kte::detail {

/// The component of v normal to a unit vector.
template <class S>
vec3<S> normal_to(const vec3<>& unit, const vec3<S>& v) {
  const vec3<S> u = as<S>(unit);
  return v - dot(u, v) * u;
}

/// Axes 2 and 3 parallel to h, axes 4, 5, 6 through the point w from joint 1 (industrial arms; Brandstoetter, Angerer
/// and Hofbaur, An Analytical Solution of the Inverse Kinematics Problem of Industrial Serial Manipulators with an
/// Ortho-parallel Basis and a Spherical Wrist, 2014). p_ij is from joint i to joint j:
///
///   q1:      h.R(h1, -q1) w = h.(p12 + p23 + p34)
///   q2, q3:  R(h, q2)(p23 + R(h, q3) p34) = R(h1, -q1) w - p12, normal to h
///   q4..q6:  those of axes that meet, R36 = R(h, -q2 - q3) R(h1, -q1) R06          (1)
template <class S>
raw_answers<S> wrist_and_parallel(const arm_structure& s, const rotation_matrix<S>& R06, const vec3<S>& position,
                                  const joint_turns<S>& seed) {
  using L = typename answer_pack<S>::type;
  const vec3<>&h1 = s.h(0), &h = s.h(1);
  const auto R = as<L>(R06);
  const auto start = as_packs<L>(seed);
  const vec3<L> w = as<L>(position) - as<L>(s.p(0)), p12 = as<L>(s.p(1) - s.p(0));
  const vec3<L> l1 = as<L>(normal_part(s.p(2) - s.p(1), h)), l2 = as<L>(normal_part(s.p(3) - s.p(2), h));
  const auto q1 = subproblem4(vec3<>(-h1), w, h, L(dot(h, s.p(3) - s.p(0))), start.at(0));
  struct begun {
    raw_answer<L> x;
    triangle_angles<L> q23;
    rotation_matrix<L> R16;
  };
  const auto begin = [&](const truth<L>& behind) {
    const auto t1 = chosen(behind, q1.minus, q1.plus);
    begun b{{},
            triangle(h, l1, l2, normal_to(h, vec3<L>(turned(h1, -t1, w) - p12)), start.at(1)),
            turned_matrix(h1, -t1, R)};
    b.x.turn.put(0, t1);
    b.x.free = free_if<L>(q1.free, 1u) + free_if<L>(b.q23.t2.free, 2u);
    return b;
  };
  const auto end = [&](begun b, const truth<L>& down) {
    const auto t2 = chosen(down, b.q23.t2.minus, b.q23.t2.plus), t3 = chosen(down, b.q23.t3.minus, b.q23.t3.plus);
    b.x.turn.put(1, t2), b.x.turn.put(2, t3);
    return both_of_meeting_axes(s, 3, turned_matrix(h, -(t2 + t3), b.R16), b.x, start);
  };
  return eight_answers<S>(6, shoulder_bit, elbow_bit, wrist_bit, begin, end);
}

/// The angle nearest to 0 with a cos t + b sin t within [least, most]; if there is none, the one with the smallest
/// error.
template <class S>
solved_angle<S> nearest_within(const S& a, const S& b, const S& least, const S& most) {
  const truth<S> within = both<truth<S>>(!(a > most), !(a < least));
  if (all(within)) return {};
  const auto border = linear_in_angle(a, b, select(a > most, most, least));
  return chosen(within, solved_angle<S>{}, chosen(border.minus.cos > border.plus.cos, border.minus, border.plus));
}

/// Axes 2, 3, 4 are parallel to h, axes 5 and 6 meet in the point w from joint 1 (arms of Universal Robots). R0i is the
/// product of the rotations of joints 1 to i:
///
///   q1:      h.R(h1, -q1) w = h.(p12 + p23 + p34 + p45);     y = R06^T R(h1, q1) h
///   q6:      h5.R(h6, q6) y = h5.h
///   q5:      R(-h5, q5) h = R(h6, q6) y
///   t14 = q2 + q3 + q4:  R(h, t14) = R(h1, -q1) R06 R(h6, -q6) R(h5, -q5)
///   q2, q3:  R(h, q2)(p23 + R(h, q3) p34) = R(h1, -q1) w - p12 - R(h, t14) p45          (2)
///
/// If h6 is along h, q6 is free, but not all values are within reach. The third side of the triangle has the square
///
///   |a - R(h, t) c|^2 = |a|^2 + |c|^2 - 2 (a.c cos t + a.(h x c) sin t),   t = -+ (q6 - q6 of seed),  c = R(h, t14)
///   p45
///         (3)
///
/// bounded by the lengths of the two links. q6 is the value within these bounds nearest to `seed`. Near that posture q6
/// is known to `rounding / sin q5` only, so the bounds are also enforced within that margin. Returns the required
/// change of t, or 0 if q6 is not `free` and the change exceeds the uncertainty `unknown` of q6.
template <class S>
solved_angle<S> way_into_reach(const arm_structure& s, const vec3<S>& a, const solved_angle<S>& t14, const vec3<S>& p45,
                               const truth<S>& free, const S& unknown) {
  using std::sqrt;
  const vec3<>& h = s.h(1);
  const vec3<S> c = turned(h, t14, normal_to(h, p45));
  const vec3<S> l1 = as<S>(normal_part(s.p(2) - s.p(1), h)), l2 = as<S>(normal_part(s.p(3) - s.p(2), h));
  const S r1 = sqrt(dot(l1, l1)), r2 = sqrt(dot(l2, l2));
  const S squares = dot(a, a) + dot(c, c), along = S(2) * dot(a, c), across = S(2) * dot(a, cross(as<S>(h), c));
  const auto way =
      nearest_within(along, across, S(squares - (r1 + r2) * (r1 + r2)), S(squares - (r1 - r2) * (r1 - r2)));
  const truth<S> close = both<truth<S>>(way.cos > S(0), size_of(way.sin) < unknown);
  return chosen(free, way, chosen(close, way, solved_angle<S>{}));
}

/// Both solutions of q2, q3, q4 of three parallel axes, given the joints before and after.
template <class S>
std::array<raw_answer<S>, 2> both_of_parallel_axes(const arm_structure& s, const vec3<S>& to_wrist,
                                                   const solved_angle<S>& t14, raw_answer<S> x, const vec3<S>& p45,
                                                   const joint_turns<S>& seed) {
  const vec3<>& h = s.h(1);
  const vec3<S> l1 = as<S>(normal_part(s.p(2) - s.p(1), h)), l2 = as<S>(normal_part(s.p(3) - s.p(2), h));
  const auto q23 = triangle(h, l1, l2, normal_to(h, vec3<S>(to_wrist - turned(h, t14, p45))), seed.at(1));
  x.free = x.free + free_if<S>(both<truth<S>>(q23.t2.free, x.free < S(2)), 2u);
  auto y = x;
  x.turn.put(1, q23.t2.plus), x.turn.put(2, q23.t3.plus), x.turn.put(3, t14 - q23.t2.plus - q23.t3.plus);
  y.turn.put(1, q23.t2.minus), y.turn.put(2, q23.t3.minus), y.turn.put(3, t14 - q23.t2.minus - q23.t3.minus);
  return {x, y};
}

template <class S>
raw_answers<S> parallel_and_meeting(const arm_structure& s, const rotation_matrix<S>& R06, const vec3<S>& position,
                                    const joint_turns<S>& seed) {
  using L = typename answer_pack<S>::type;
  using std::sqrt;
  const vec3<>&h1 = s.h(0), &h = s.h(1), &h5 = s.h(4), &h6 = s.h(5);
  const auto R = as<L>(R06);
  const auto start = as_packs<L>(seed);
  const vec3<L> w = as<L>(position) - as<L>(s.p(0)), p12 = as<L>(s.p(1) - s.p(0)), p45 = as<L>(s.p(4) - s.p(3));
  const vec3<L> normal = cross(as<L>(h), as<L>(h5));
  const auto q1 = subproblem4(vec3<>(-h1), w, h, L(dot(h, s.p(4) - s.p(0))), start.at(0));
  struct begun {
    raw_answer<L> x;
    rotation_matrix<L> R16;
    vec3<L> a, y;
    two_angles<L> q6;
  };
  const auto begin = [&](const truth<L>& behind) {
    const auto t1 = chosen(behind, q1.minus, q1.plus);
    begun b{};
    b.R16 = turned_matrix(h1, -t1, R);
    b.a = turned(h1, -t1, w) - p12, b.y = transpose(b.R16) * as<L>(h);
    b.q6 = subproblem4(h6, b.y, h5, L(dot(h5, h)), start.at(5));
    b.x.turn.put(0, t1);
    b.x.free = free_if<L>(q1.free, 1u) + free_if<L>(b.q6.free, 46u);  // q2, q3, q4 change with q6
    return b;
  };
  const auto end = [&](begun b, const truth<L>& flipped) {
    const auto t14_of = [&](const solved_angle<L>& t6, const solved_angle<L>& t5) {
      return subproblem1(h, normal, vec3<L>(b.R16 * turned(h6, -t6, turned(h5, -t5, normal))));
    };
    const auto t5_of = [&](const solved_angle<L>& t6) {
      return subproblem1(vec3<>(-h5), as<L>(h), turned(h6, t6, b.y));
    };
    auto t6 = chosen(flipped, b.q6.minus, b.q6.plus), t5 = t5_of(t6), t14 = t14_of(t6, t5);
    const vec3<L> off = normal_to(h6, b.y);
    const L unknown = L(24 * std::numeric_limits<S>::epsilon()) / sqrt(dot(off, off));
    const auto way = way_into_reach(s, normal_to(h, b.a), t14, p45, b.q6.free, unknown);
    if (const truth<L> goes = way.sin != L(0); any(goes)) {
      t6 = chosen(goes, t6 + chosen(dot(b.y, as<L>(h6)) > L(0), -way, way), t6);
      t5 = chosen(goes, t5_of(t6), t5), t14 = chosen(goes, t14_of(t6, t5), t14);
    }
    b.x.turn.put(4, t5), b.x.turn.put(5, t6);
    return both_of_parallel_axes(s, b.a, t14, b.x, p45, start);
  };
  return eight_answers<S>(6, shoulder_bit, wrist_bit, elbow_bit, begin, end);
}

}  // namespace kte::detail
