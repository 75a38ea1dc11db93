#pragma once

#include <kte/manipulators/detail/raw_answers.hpp>
#include <kte/manipulators/two_links.hpp>

namespace kte::detail {

/// The part of v normal to a unit vector.
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
  const vec3<>&h1 = s.h(0), &h = s.h(1);
  const vec3<S> w = position - as<S>(s.p(0)), p12 = as<S>(s.p(1) - s.p(0));
  const vec3<S> l1 = as<S>(normal_part(s.p(2) - s.p(1), h)), l2 = as<S>(normal_part(s.p(3) - s.p(2), h));
  const auto q1 = subproblem4(vec3<>(-h1), w, h, S(dot(h, s.p(3) - s.p(0))), seed.at(0));
  raw_answers<S> out;
  raw_answer<S> x{};
  for (const bool behind : {false, true}) {
    const auto t1 = behind ? q1.minus : q1.plus;
    x.turn.put(0, t1);
    const auto q23 = triangle(h, l1, l2, normal_to(h, vec3<S>(turned(h1, -t1, w) - p12)), seed.at(1));
    const auto R16 = turned_matrix(h1, -t1, R06);
    for (const bool down : {false, true}) {
      const auto t2 = down ? q23.t2.minus : q23.t2.plus, t3 = down ? q23.t3.minus : q23.t3.plus;
      x.turn.put(1, t2), x.turn.put(2, t3);
      x.branch = (behind ? shoulder_bit : 0u) | (down ? elbow_bit : 0u);
      x.free = (q1.free ? 1u : 0u) | (q23.t2.free ? 2u : 0u);
      with_meeting_axes(s, 3, turned_matrix(h, -(t2 + t3), R16), x, seed, wrist_bit,
                        [&out](const raw_answer<S>& y) { out.add(y); });
    }
  }
  return out;
}

/// Of the angles at which a cos t + b sin t is within [least, most], the one nearest to 0; where there is none, the one
/// that misses least.
template <class S>
S nearest_within(const S& a, const S& b, const S& least, const S& most) {
  if (!(a > most) && !(a < least)) return S(0);
  const auto border = linear_in_angle(a, b, a > most ? most : least);
  const S plus = border.plus.value(), minus = border.minus.value();
  const auto size = [](const S& t) { return t < S(0) ? S(-t) : t; };
  return size(minus) < size(plus) ? minus : plus;
}

/// Axes 2, 3, 4 parallel to h, axes 5 and 6 through the point w from joint 1 (arms of Universal Robots). R0i turns by
/// the joints up to i:
///
///   q1:      h.R(h1, -q1) w = h.(p12 + p23 + p34 + p45);     y = R06^T R(h1, q1) h
///   q6:      h5.R(h6, q6) y = h5.h
///   q5:      R(-h5, q5) h = R(h6, q6) y
///   t14 = q2 + q3 + q4:  R(h, t14) = R(h1, -q1) R06 R(h6, -q6) R(h5, -q5)
///   q2, q3:  R(h, q2)(p23 + R(h, q3) p34) = R(h1, -q1) w - p12 - R(h, t14) p45          (2)
///
/// Where h6 is along h, q6 is free, but not everywhere within reach: the last side has the square
///
///   |a - R(h, t) c|^2 = |a|^2 + |c|^2 - 2 (a.c cos t + a.(h x c) sin t),   t = -+ (q6 - that of seed),  c = R(h, t14)
///   p45          (3)
///
/// of which the lengths of two links are the borders. q6 is then within them, nearest to `seed`. Next to that, q6 is
/// known to `rounding / sin q5` only, and as near as that to the borders they are kept to as well. Here is the way to
/// go in t, or 0 where that is farther than q6 is `unknown`.
template <class S>
S way_into_reach(const arm_structure& s, const vec3<S>& a, const solved_angle<S>& t14, const vec3<S>& p45,
                 const S& unknown) {
  const vec3<>& h = s.h(1);
  const vec3<S> c = turned(h, t14, normal_to(h, p45));
  const S r1 = S(length_of(normal_part(s.p(2) - s.p(1), h))), r2 = S(length_of(normal_part(s.p(3) - s.p(2), h)));
  const S squares = dot(a, a) + dot(c, c), along = S(2) * dot(a, c), across = S(2) * dot(a, cross(as<S>(h), c));
  const S way = nearest_within(along, across, S(squares - (r1 + r2) * (r1 + r2)), S(squares - (r1 - r2) * (r1 - r2)));
  return way < unknown && -way < unknown ? way : S(0);
}

/// q2, q3, q4 of three parallel axes when the joints before and behind are known; answers to `next`.
template <class S, class Next>
void with_parallel_axes(const arm_structure& s, const vec3<S>& to_wrist, const solved_angle<S>& t14, raw_answer<S> x,
                        const vec3<S>& p45, const joint_turns<S>& seed, const Next& next) {
  const vec3<>& h = s.h(1);
  const vec3<S> l1 = as<S>(normal_part(s.p(2) - s.p(1), h)), l2 = as<S>(normal_part(s.p(3) - s.p(2), h));
  const auto q23 = triangle(h, l1, l2, normal_to(h, vec3<S>(to_wrist - turned(h, t14, p45))), seed.at(1));
  if (q23.t2.free) x.free |= 2u;
  const unsigned branch = x.branch;
  for (const bool down : {false, true}) {
    const auto t2 = down ? q23.t2.minus : q23.t2.plus, t3 = down ? q23.t3.minus : q23.t3.plus;
    x.turn.put(1, t2), x.turn.put(2, t3);
    x.turn.put(3, t14 - t2 - t3);
    x.branch = branch | (down ? elbow_bit : 0u);
    next(x);
  }
}

template <class S>
raw_answers<S> parallel_and_meeting(const arm_structure& s, const rotation_matrix<S>& R06, const vec3<S>& position,
                                    const joint_turns<S>& seed) {
  using std::sqrt;
  const vec3<>&h1 = s.h(0), &h = s.h(1), &h5 = s.h(4), &h6 = s.h(5);
  const vec3<S> w = position - as<S>(s.p(0)), p12 = as<S>(s.p(1) - s.p(0)), p45 = as<S>(s.p(4) - s.p(3));
  const vec3<S> normal = cross(as<S>(h), as<S>(h5));
  const auto q1 = subproblem4(vec3<>(-h1), w, h, S(dot(h, s.p(4) - s.p(0))), seed.at(0));
  raw_answers<S> out;
  for (const bool behind : {false, true}) {
    raw_answer<S> x{};
    const auto t1 = behind ? q1.minus : q1.plus;
    x.turn.put(0, t1);
    const auto R16 = turned_matrix(h1, -t1, R06);
    const vec3<S> a = turned(h1, -t1, w) - p12, y = transpose(R16) * as<S>(h);
    const auto t14_of = [&](const solved_angle<S>& t6, const solved_angle<S>& t5) {
      return subproblem1(h, normal, vec3<S>(R16 * turned(h6, -t6, turned(h5, -t5, normal))));
    };
    const auto t5_of = [&](const solved_angle<S>& t6) { return subproblem1(vec3<>(-h5), as<S>(h), turned(h6, t6, y)); };
    const auto q6 = subproblem4(h6, y, h5, S(dot(h5, h)), seed.at(5));
    const vec3<S> off = normal_to(h6, y);
    const S unknown = q6.free ? S(4) : S(S(24 * std::numeric_limits<S>::epsilon()) / sqrt(dot(off, off)));
    for (const bool flipped : {false, true}) {
      auto t6 = flipped ? q6.minus : q6.plus;
      auto t5 = t5_of(t6), t14 = t14_of(t6, t5);
      if (const S way = way_into_reach(s, normal_to(h, a), t14, p45, unknown); way != S(0)) {
        t6 = t6 + angle_of(dot(y, as<S>(h6)) > S(0) ? S(-way) : way), t5 = t5_of(t6), t14 = t14_of(t6, t5);
      }
      x.free = (q1.free ? 1u : 0u) | (q6.free ? 46u : 0u);  // with q6 go q2, q3, q4
      x.turn.put(4, t5), x.turn.put(5, t6);
      x.branch = (behind ? shoulder_bit : 0u) | (flipped ? wrist_bit : 0u);
      with_parallel_axes(s, a, t14, x, p45, seed, [&out](const raw_answer<S>& z) { out.add(z); });
    }
  }
  return out;
}

}  // namespace kte::detail
