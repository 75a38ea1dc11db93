#pragma once

#include <kte/manipulators/detail/six_axes.hpp>

/// Arms with seven axes: axes 1, 2, 3 meet in the shoulder, and 5, 6, 7 in the wrist (Shimizu, Kakuya, Yoon, Kitagaki
/// and Kosuge, Analytical Inverse Kinematic Computation for 7-DOF Redundant Manipulators With Joint Limits, IEEE
/// Transactions on Robotics 24, 2008; Elias and Wen, Redundancy Parameterization and Inverse Kinematics of 7-DOF
/// Revolute Manipulators, 2023).
namespace kte::detail {

/// The triangle of shoulder, elbow and wrist, for one of the two elbow angles: at psi = 0, and in axes of link 3. w^
/// points from the shoulder to the wrist:
///
///   e_x = ((w^ - t) x r) x w^, normalized          (1)   stereographic: undefined only if w^ = t
///   the elbow is on the side  e(psi) = cos psi e_x + sin psi (w^ x e_x)          (2)
///   R03 = (w^, e, w^ x e) (v^, f, v^ x f)^T          (3)
///
/// v^ and f are w^ and e in axes of link 3. t points against axis 1, to the pedestal of most arms.
template <class S>
struct elbow_side {
  solved_angle<S> q4;
  S slack{};
  vec3<S> w, ex, ey;  ///< w^, e_x, w^ x e_x
  vec3<S> v, f, g;    ///< v^, f, v^ x f

  rotation_matrix<S> R03(const solved_angle<S>& psi) const {
    const vec3<S> e = psi.cos * ex + psi.sin * ey, n = psi.cos * ey - psi.sin * ex;
    return as<S>(dyad(w, v) + dyad(e, f) + dyad(n, g));
  }
  /// The arm angle of a posture with this elbow.
  solved_angle<S> psi_of(const rotation_matrix<S>& R) const {
    const vec3<S> e = R * f;
    return direction(S(dot(ex, e)), S(dot(ey, e)));
  }
};

template <class S>
vec3<S> unit_vector_along(const vec3<S>& v, const vec3<S>& otherwise) {
  using std::sqrt;
  const S n = sqrt(dot(v, v));
  const truth<S> some = n > S(0);
  return chosen(some, vec3<S>((S(1) / select(some, n, S(1))) * v), otherwise);
}

/// The side for the first elbow angle, where l1.(h x v) < 0, or for the second.
template <class S>
elbow_side<S> elbow_side_of(const arm_structure& s, const vec3<S>& position, const truth<S>& second) {
  const vec3<>& h = s.h(3);
  const vec3<> across = s.p(4) - s.p(3);
  const vec3<S> w = position - as<S>(s.p(0));
  const vec3<S> l1 = as<S>(s.p(3) - s.p(0)), l2 = as<S>(normal_part(across, h));
  const S offset = S(dot(across, h));
  const auto q4 = elbow_angles(h, l1, l2, root_or_none(S(dot(w, w) - offset * offset)));
  const vec3<S> t = as<S>(vec3<>(-s.h(0))), r = as<S>(any_normal(s.h(0)));
  elbow_side<S> x;
  x.q4 = chosen(second, q4.minus, q4.plus), x.slack = q4.slack;
  x.w = unit_vector_along(w, vec3<S>(-t));
  x.ex = unit_vector_along(vec3<S>(cross(cross(vec3<S>(x.w - t), r), x.w)), r);
  x.ey = cross(x.w, x.ex);
  const vec3<S> v = l1 + turned(h, x.q4, as<S>(across));
  x.v = unit_vector_along(v, vec3<S>(unit_vector_along(l1, r)));
  const vec3<S> side = unit_vector_along(vec3<S>(cross(as<S>(h), x.v)), r);
  x.f = chosen(second, side, vec3<S>(-side));
  x.g = cross(x.v, x.f);
  return x;
}
/// The sides of both elbow angles.
template <class S>
std::array<elbow_side<S>, 2> elbow_sides(const arm_structure& s, const vec3<S>& position) {
  const truth<S> second = S(0) < S(1);
  return {elbow_side_of(s, position, truth<S>(!second)), elbow_side_of(s, position, second)};
}

/// All joints for one arm angle psi, from R07 and the position of the wrist: q1..q3 from R03, q5..q7 from R47 = (R03
/// R34)^T R07.
template <class S>
raw_answers<S> shoulder_and_wrist(const arm_structure& s, const rotation_matrix<S>& R07, const vec3<S>& position,
                                  const solved_angle<S>& psi, const joint_turns<S>& seed) {
  using L = typename answer_pack<S>::type;
  const auto R = as<L>(R07);
  const auto start = as_packs<L>(seed);
  const solved_angle<L> angle{L(psi.cos), L(psi.sin)};
  struct begun {
    std::array<raw_answer<L>, 2> both;
    meeting_axes<L> shoulder;
  };
  const auto begin = [&](const truth<L>& down) {
    const auto side = elbow_side_of(s, as<L>(position), down);
    const auto R03 = side.R03(angle);
    const meeting_axes<L> shoulder(s, 0, R03, start.at(0));
    raw_answer<L> x{};
    x.turn.put(3, side.q4);
    x.free = free_if<L>(shoulder.first.free, 5u);
    const auto R47 = turned_matrix(s.h(3), -side.q4, rotation_matrix<L>(transpose(R03) * R));
    return begun{both_of_meeting_axes(s, 4, R47, x, start), shoulder};
  };
  const auto end = [](const begun& b, const truth<L>& behind) {
    auto both = b.both;
    b.shoulder.put(chosen(behind, b.shoulder.first.minus, b.shoulder.first.plus), both[0]);
    for (const std::size_t k : {0u, 1u, 2u}) both[1].turn.put(k, both[0].turn.at(k));
    return both;
  };
  return eight_answers<S>(7, elbow_bit, shoulder_bit, wrist_bit, begin, end);
}

}  // namespace kte::detail
