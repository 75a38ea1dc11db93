#pragma once

#include <kte/manipulators/detail/arm_structure.hpp>
#include <kte/manipulators/subproblems.hpp>

#include <numbers>

namespace kte::detail {

/// A number for each joint.
template <class S>
using by_joint = std::array<S, arm_geometry::most>;

/// Angles of joints by sine and cosine: their values are taken many at a time.
template <class S>
struct joint_turns {
  by_joint<S> sine, cosine;

  solved_angle<S> at(std::size_t i) const { return {cosine[i], sine[i]}; }
  void put(std::size_t i, const solved_angle<S>& t) { sine[i] = t.sin, cosine[i] = t.cos; }
};
template <class S>
joint_turns<S> turns_of(const by_joint<S>& t) {
  joint_turns<S> x;
  sincos_each(t.data(), x.sine.data(), x.cosine.data(), t.size());
  return x;
}

/// What the closed forms give: turns of the joints of `arm_structure::arm`.
template <class S>
struct raw_answer {
  joint_turns<S> turn;
  S slide;  ///< of the joint that slides, m
  unsigned branch;
  unsigned free;  ///< bit i: joint i could be anything
};
template <class S>
struct raw_answers {
  static constexpr std::size_t most = 16;
  std::array<raw_answer<S>, most> all;
  std::size_t size = 0;

  constexpr void add(const raw_answer<S>& x) {
    if (size < most) all[size++] = x;
  }
};
/// Bits of `branch`: set for the second answer.
enum branch_bit : unsigned { shoulder_bit = 1, elbow_bit = 2, wrist_bit = 4 };

template <class S>
using rotation_matrix = mat3<vec3<S>>;

/// R(k, t) m
template <class S, class K>
rotation_matrix<S> turned_matrix(const K& k, const solved_angle<S>& t, const rotation_matrix<S>& m) {
  return as<S>(rotation_about(as<S>(k), t.cos, t.sin)) * m;
}

/// Three joints whose axes meet: R = R(h4, q4) R(h5, q5) R(h6, q6). With u = R h6 and v normal to h6:
///
///   q4:  h5.R(h4, -q4) u = h5.h6
///   q5:  R(h5, q5) h6 = R(h4, -q4) u
///   q6:  R(h6, q6) v = R(h5, -q5) R(h4, -q4) R v          (1)
///
/// each from what those before it leave. So the pose is right to rounding also where q4 is not known to any digit, as
/// for q5 = 0; there q4 is what `otherwise` says, and half a turn more.
template <class S>
struct three_angles {
  two_angles<S> first;
  std::array<solved_angle<S>, 2> second, third;
};
template <class S>
three_angles<S> meeting_axes(const vec3<>& h4, const vec3<>& h5, const vec3<>& h6, const rotation_matrix<S>& R,
                             const solved_angle<S>& otherwise) {
  const vec3<S> u = R * as<S>(h6), v = cross(as<S>(h6), as<S>(h5)), Rv = R * v;
  three_angles<S> t;
  t.first = subproblem4(vec3<>(-h4), u, h5, S(dot(as<S>(h5), as<S>(h6))), otherwise);
  for (const std::size_t i : {0u, 1u}) {
    const auto back = -(i == 0 ? t.first.plus : t.first.minus);
    t.second[i] = subproblem1(h5, as<S>(h6), turned(h4, back, u));
    t.third[i] = subproblem1(h6, v, turned(h5, -t.second[i], turned(h4, back, Rv)));
  }
  return t;
}
/// The answers of joints i, i+1, i+2 to `x`, one for each value of `bit`, into `out`.
template <class S, class Next>
void with_meeting_axes(const arm_structure& s, int i, const rotation_matrix<S>& R, raw_answer<S> x,
                       const joint_turns<S>& seed, unsigned bit, const Next& next) {
  const auto k = static_cast<std::size_t>(i);
  const auto t = meeting_axes(s.h(i), s.h(i + 1), s.h(i + 2), R, seed.at(k));
  if (t.first.free) x.free |= 5u << k;
  for (const std::size_t b : {0u, 1u}) {
    x.turn.put(k, b == 0 ? t.first.plus : t.first.minus);
    x.turn.put(k + 1, t.second[b]), x.turn.put(k + 2, t.third[b]);
    if (b == 1) x.branch |= bit;
    next(x);
  }
}

/// pi, with all digits of the scalar.
template <class S>
S half_turn() {
  using std::atan2;
  if constexpr (std::is_floating_point_v<S>) {
    return std::numbers::pi_v<S>;
  } else {
    return atan2(S(0), S(-1));
  }
}
/// In (-pi, pi], of an angle that is less than three half turns.
template <class S>
S wrapped(const S& t) {
  const S pi = half_turn<S>();
  if (t > pi) return t - S(2) * pi;
  return t > -pi ? t : S(t + S(2) * pi);
}

}  // namespace kte::detail
