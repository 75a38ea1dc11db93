#pragma once

#include <kte/manipulators/detail/answer_pack.hpp>
#include <kte/manipulators/detail/arm_structure.hpp>
#include <kte/manipulators/subproblems.hpp>

#include <numbers>

namespace kte::detail {

/// A number for each joint.
template <class S>
using by_joint = std::array<S, arm_geometry::most>;

/// Joint angles by sine and cosine; their values are computed many at a time.
template <class S>
struct joint_turns {
  by_joint<S> sine, cosine;

  solved_angle<S> at(std::size_t i) const { return {cosine[i], sine[i]}; }
  void put(std::size_t i, const solved_angle<S>& t) { sine[i] = t.sin, cosine[i] = t.cos; }
};
template <class L, class S>
joint_turns<L> as_packs(const joint_turns<S>& x) {
  joint_turns<L> y;
  for (std::size_t i = 0; i < x.sine.size(); ++i) y.sine[i] = L(x.sine[i]), y.cosine[i] = L(x.cosine[i]);
  return y;
}
template <class S>
joint_turns<S> turns_of(const by_joint<S>& t) {
  joint_turns<S> x;
  sincos_each(t.data(), x.sine.data(), x.cosine.data(), t.size());
  return x;
}

/// One solution of the closed forms, or several in the lanes of a pack: angles of the joints of `arm_structure::arm`.
template <class S>
struct raw_answer {
  joint_turns<S> turn;
  S slide;  ///< of the joint that slides, m
  S free;   ///< a number, because lanes have no bits: the sum of 2^i over the free joints i
};
/// The sum of 2^i over `joints` where the condition holds, otherwise 0.
template <class S>
S free_if(const truth<S>& condition, unsigned joints) {
  return select(condition, S(joints), S(0));
}

/// All solutions, with the values of one joint in adjacent memory: rows that are padded to full registers with the last
/// solution.
template <class S>
struct raw_answers {
  static constexpr std::size_t most = 16;
  using row = std::array<S, most>;

  std::size_t size = 0;
  by_joint<row> sine, cosine;
  row slide, free;
  std::array<unsigned, most> branch;

  /// Adds a solution; ignored beyond `most`.
  void add(const raw_answer<S>& x, unsigned name, std::size_t joints) {
    if (size == most) return;
    for (std::size_t i = size; i < padded(size + 1); ++i) {
      for (std::size_t k = 0; k < joints; ++k) sine[k][i] = x.turn.sine[k], cosine[k][i] = x.turn.cosine[k];
      slide[i] = x.slide, free[i] = x.free;
    }
    branch[size++] = name;
  }
  static constexpr std::size_t padded(std::size_t n) {
    constexpr std::size_t lanes = answer_pack<S>::count;
    return (n + lanes - 1) / lanes * lanes;
  }
};
/// Bits of `branch`, set for the second alternative.
enum branch_bit : unsigned { shoulder_bit = 1, elbow_bit = 2, wrist_bit = 4 };

template <class S>
using rotation_matrix = mat3<vec3<S>>;

/// R(k, t) m
template <class S, class K>
rotation_matrix<S> turned_matrix(const K& k, const solved_angle<S>& t, const rotation_matrix<S>& m) {
  return as<S>(rotation_about(as<S>(k), t.cos, t.sin)) * m;
}

/// Joints i, i+1, i+2, whose axes meet, here h4, h5, h6: R = R(h4, q4) R(h5, q5) R(h6, q6). With u = R h6 and v normal
/// to h6:
///
///   q4:  h5.R(h4, -q4) u = h5.h6
///   q5:  R(h5, q5) h6 = R(h4, -q4) u
///   q6:  R(h6, q6) v = R(h5, -q5) R(h4, -q4) R v          (1)
///
/// Each equation uses the results of the previous ones. The pose is therefore accurate to rounding even where q4 is
/// undetermined, as for q5 = 0; there q4 is `otherwise`, or half a turn from it.
template <class S>
struct meeting_axes {
  const arm_structure& s;
  int i;
  vec3<S> u, v, Rv;
  two_angles<S> first;  ///< q4

  meeting_axes(const arm_structure& arm, int joint, const rotation_matrix<S>& R, const solved_angle<S>& otherwise)
      : s(arm), i(joint), u(R * as<S>(h(2))), v(cross(as<S>(h(2)), as<S>(h(1)))), Rv(R * v) {
    first = subproblem4(vec3<>(-h(0)), u, h(1), S(dot(as<S>(h(1)), as<S>(h(2)))), otherwise);
  }
  const vec3<>& h(int k) const { return s.h(i + k); }
  /// Computes the other joints for one of the two values of q4.
  void put(const solved_angle<S>& q4, raw_answer<S>& x) const {
    const auto k = static_cast<std::size_t>(i);
    const auto q5 = subproblem1(h(1), as<S>(h(2)), turned(h(0), -q4, u));
    const auto q6 = subproblem1(h(2), v, turned(h(1), -q5, turned(h(0), -q4, Rv)));
    x.turn.put(k, q4), x.turn.put(k + 1, q5), x.turn.put(k + 2, q6);
  }
};
/// Both solutions of joints i, i+1, i+2, added to `x`.
template <class S>
std::array<raw_answer<S>, 2> both_of_meeting_axes(const arm_structure& s, int i, const rotation_matrix<S>& R,
                                                  raw_answer<S> x, const joint_turns<S>& seed) {
  const meeting_axes<S> axes(s, i, R, seed.at(static_cast<std::size_t>(i)));
  x.free = x.free + free_if<S>(axes.first.free, 5u << i);
  auto y = x;
  axes.put(axes.first.plus, x), axes.put(axes.first.minus, y);
  return {x, y};
}

/// pi, in the precision of the scalar.
template <class S>
S half_turn() {
  using std::atan2;
  if constexpr (std::is_floating_point_v<S>) {
    return std::numbers::pi_v<S>;
  } else if constexpr (is_pack<S>) {
    return S(std::numbers::pi);
  } else {
    return atan2(S(0), S(-1));
  }
}
/// An angle of less than three half turns, moved to (-pi, pi].
template <class S>
S wrapped(const S& t) {
  const S pi = half_turn<S>();
  if (t > pi) return t - S(2) * pi;
  return t > -pi ? t : S(t + S(2) * pi);
}

}  // namespace kte::detail
