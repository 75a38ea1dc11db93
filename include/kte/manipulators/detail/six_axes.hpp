#pragma once

#include <kte/manipulators/detail/raw_answers.hpp>

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
                                  const free_angles<S>& seed) {
  const vec3<>&h1 = s.h(0), &h = s.h(1);
  const vec3<S> w = position - as<S>(s.p(0)), p12 = as<S>(s.p(1) - s.p(0));
  const vec3<S> l1 = as<S>(normal_part(s.p(2) - s.p(1), h)), l2 = as<S>(normal_part(s.p(3) - s.p(2), h));
  const auto q1 = subproblem4(vec3<>(-h1), w, h, S(dot(h, s.p(3) - s.p(0))), seed.at(0));
  raw_answers<S> out;
  raw_answer<S> x;
  for (const bool behind : {false, true}) {
    const auto t1 = behind ? q1.minus : q1.plus;
    x.t[0] = t1.value();
    const auto q23 = triangle(h, l1, l2, normal_to(h, vec3<S>(turned(h1, -t1, w) - p12)), seed.at(1));
    const auto R16 = turned_matrix(h1, -t1, R06);
    for (const bool down : {false, true}) {
      const auto t2 = down ? q23.t2.minus : q23.t2.plus, t3 = down ? q23.t3.minus : q23.t3.plus;
      x.t[1] = t2.value(), x.t[2] = t3.value();
      x.branch = (behind ? shoulder_bit : 0u) | (down ? elbow_bit : 0u);
      x.free = (q1.free ? 1u : 0u) | (q23.t2.free ? 2u : 0u);
      with_meeting_axes(s, 3, turned_matrix(h, -(t2 + t3), R16), x, seed, wrist_bit,
                        [&out](const raw_answer<S>& y) { out.add(y); });
    }
  }
  return out;
}

/// Of the angles at which a cos t + b sin t is within [least, most], the one nearest to t0; where there is none, the
/// one that misses least.
template <class S>
S nearest_within(const S& a, const S& b, const S& least, const S& most, const S& t0) {
  const auto start = angle_of(t0);
  const auto miss = [&](const solved_angle<S>& t) {
    const S x = a * t.cos + b * t.sin, over = x - most, under = least - x;
    return over > under ? over : under;
  };
  if (!(miss(start) > S(0))) return t0;
  // (1) of subproblems.hpp: borders, or the point nearest to the border.
  const auto border = linear_in_angle(a, b, a * start.cos + b * start.sin > most ? most : least);
  const S plus = (border.plus - start).value(), minus = (border.minus - start).value();
  const auto size = [](const S& t) { return t < S(0) ? S(-t) : t; };
  return t0 + (size(minus) < size(plus) ? minus : plus);
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
/// Where h6 is along h, q6 is free, but not everywhere within reach: the last side has the square a - b.R(h, q6) c,
/// of which the lengths of two links are the borders. It is then within them, nearest to `seed`.
template <class S>
S reachable_free_angle(const arm_structure& s, const vec3<S>& a, const solved_angle<S>& t14_at_0, const S& turns,
                       const S& q6) {
  using std::sqrt;
  const vec3<>& h = s.h(1);
  const vec3<S> c = turned(h, t14_at_0, as<S>(normal_part(s.p(4) - s.p(3), h)));
  const S r1 = S(length_of(normal_part(s.p(2) - s.p(1), h))), r2 = S(length_of(normal_part(s.p(3) - s.p(2), h)));
  // |a - R(h, t) c|^2 = |a|^2 + |c|^2 - 2 (a.c cos t + a.(h x c) sin t),  t = turns q6
  const S squares = dot(a, a) + dot(c, c);
  const S along = 2 * dot(a, c), across = 2 * turns * dot(a, cross(as<S>(h), c));
  return nearest_within(along, across, S(squares - (r1 + r2) * (r1 + r2)), S(squares - (r1 - r2) * (r1 - r2)), q6);
}

/// q2, q3, q4 of three parallel axes when the joints before and behind are known; answers to `next`.
template <class S, class Next>
void with_parallel_axes(const arm_structure& s, const vec3<S>& to_wrist, const solved_angle<S>& t14, raw_answer<S> x,
                        const vec3<S>& p45, const free_angles<S>& seed, const Next& next) {
  const vec3<>& h = s.h(1);
  const vec3<S> l1 = as<S>(normal_part(s.p(2) - s.p(1), h)), l2 = as<S>(normal_part(s.p(3) - s.p(2), h));
  const auto q23 = triangle(h, l1, l2, normal_to(h, vec3<S>(to_wrist - turned(h, t14, p45))), seed.at(1));
  if (q23.t2.free) x.free |= 2u;
  const unsigned branch = x.branch;
  for (const bool down : {false, true}) {
    const auto t2 = down ? q23.t2.minus : q23.t2.plus, t3 = down ? q23.t3.minus : q23.t3.plus;
    x.t[1] = t2.value(), x.t[2] = t3.value();
    x.t[3] = (t14 - t2 - t3).value();
    x.branch = branch | (down ? elbow_bit : 0u);
    next(x);
  }
}

template <class S>
raw_answers<S> parallel_and_meeting(const arm_structure& s, const rotation_matrix<S>& R06, const vec3<S>& position,
                                    const free_angles<S>& seed) {
  const vec3<>&h1 = s.h(0), &h = s.h(1), &h5 = s.h(4), &h6 = s.h(5);
  const vec3<S> w = position - as<S>(s.p(0)), p12 = as<S>(s.p(1) - s.p(0)), p45 = as<S>(s.p(4) - s.p(3));
  const vec3<S> normal = cross(as<S>(h), as<S>(h5));
  const auto q1 = subproblem4(vec3<>(-h1), w, h, S(dot(h, s.p(4) - s.p(0))), seed.at(0));
  raw_answers<S> out;
  for (const bool behind : {false, true}) {
    raw_answer<S> x;
    const auto t1 = behind ? q1.minus : q1.plus;
    x.t[0] = t1.value();
    const auto R16 = turned_matrix(h1, -t1, R06);
    const vec3<S> a = turned(h1, -t1, w) - p12, y = transpose(R16) * as<S>(h);
    const auto t14_of = [&](const solved_angle<S>& t6, const solved_angle<S>& t5) {
      return subproblem1(h, normal, vec3<S>(R16 * turned(h6, -t6, turned(h5, -t5, normal))));
    };
    const auto q6 = subproblem4(h6, y, h5, S(dot(h5, h)), seed.at(5));
    for (const bool flipped : {false, true}) {
      auto t6 = flipped ? q6.minus : q6.plus;
      x.free = (q1.free ? 1u : 0u);
      if (q6.free) {
        const auto t5 = subproblem1(vec3<>(-h5), as<S>(h), turned(h6, t6, y));
        const S turns = dot(y, as<S>(h6)) > S(0) ? S(-1) : S(1);
        x.t[5] = reachable_free_angle(s, normal_to(h, a), t14_of({}, t5), turns, t6.value());
        t6 = angle_of(x.t[5]), x.free |= 46u;  // with q6 go q2, q3, q4
      } else {
        x.t[5] = t6.value();
      }
      const auto t5 = subproblem1(vec3<>(-h5), as<S>(h), turned(h6, t6, y));
      x.t[4] = t5.value();
      x.branch = (behind ? shoulder_bit : 0u) | (flipped ? wrist_bit : 0u);
      with_parallel_axes(s, a, t14_of(t6, t5), x, p45, seed, [&out](const raw_answer<S>& z) { out.add(z); });
    }
  }
  return out;
}

}  // namespace kte::detail
