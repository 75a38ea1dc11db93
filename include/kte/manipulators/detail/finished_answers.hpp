#pragma once

#include <kte/dynamics/configuration_space.hpp>
#include <kte/manipulators/detail/feasible_angles.hpp>
#include <kte/manipulators/detail/free_body_answer.hpp>
#include <kte/manipulators/detail/in_limits.hpp>
#include <kte/manipulators/detail/why_no_closed_form.hpp>
#include <kte/manipulators/ik_answers.hpp>
#include <kte/manipulators/manipulator.hpp>

/// Arguments of inverse kinematics, and solutions in the form that users get.
namespace kte::detail {

/// The values of coordinates that do not move the tool.
template <class S, class Arm>
auto starting_configuration(const Arm& arm) {
  return neutral_configuration(arm).template cast<S>().eval();
}

/// Fails to compile if the type of a static arm rules out a closed form for all its numbers.
template <class Chain, key_type First, key_type... More>
constexpr void refuse_by_type(const manipulator<Chain, tool_keys<First, More...>>&) {
  static_assert(sizeof...(More) == 0,
                "kte: inverse kinematics in closed form needs an arm with one tool; kte::numerical_inverse_kinematics "
                "takes goals of several");
  static_assert(sizeof...(More) > 0 || may_have_closed_form<First, Chain>(),
                "kte: no closed form of inverse kinematics: it needs an arm with three, four, six or seven joints of "
                "one free coordinate each between base and tool, or a body that moves freely; "
                "kte::numerical_inverse_kinematics solves others");
}
template <class Arm>
constexpr void refuse_by_type(const Arm&) {}

/// Throws unless the arm has a closed form.
template <class Arm>
void check_closed_form(const Arm& arm) {
  if (arm.tools().size() != 1)
    raise<bad_argument>("kte: inverse kinematics in closed form needs an arm with one tool; this one has " +
                        std::to_string(arm.tools().size()));
  if (arm.structure().form == closed_form::none)
    raise<no_closed_form>("kte: " + why_no_closed_form(arm.structure()) +
                          "; kte::numerical_inverse_kinematics needs none");
}

/// A configuration, by joint.
template <class S, class Q>
by_joint<S> raw_angles(const arm_geometry& arm, const Q& q) {
  by_joint<S> t{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(arm.n); ++i) t[i] = S(q[static_cast<Eigen::Index>(arm.in_q[i])]);
  return t;
}

/// Moves angles into the limits where possible; `within` is 1 where it succeeds, otherwise 0.
template <class Arm, class S, class Q>
void put_within_limits(const Arm& arm, const arm_structure& s, const Q& start, solved_answers<S>& solved,
                       typename solved_answers<S>::row& within) {
  using L = typename answer_pack<S>::type;
  within.fill(S(1));
  for (std::size_t i = 0; i < static_cast<std::size_t>(s.original.n); ++i) {
    const auto v = static_cast<std::size_t>(s.original.in_v[i]);
    const double lower = arm.limits().lower[v], upper = arm.limits().upper[v];
    const L from = L(start[s.original.in_q[i]]);
    for (std::size_t a = 0; a < solved.at.size; a += answer_pack<S>::count) {
      L t = load_pack(solved.at.t[i].data() + a);
      const auto inside = bring_within(lower, upper, s.original.slides[i], from, t);
      store_pack(t, solved.at.t[i].data() + a);
      store_pack(L(select(inside, load_pack(within.data() + a), L(0))), within.data() + a);
    }
  }
}
/// Bits over v for bits over joints.
inline unsigned bits_of_v(const arm_structure& s, unsigned joints) {
  unsigned bits = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(s.arm.n); ++k)
    if (joints >> k & 1u) bits |= 1u << s.original.in_v[s.joint(k)];
  return bits;
}
/// The coordinates that the formulas report as free; for packs per lane.
template <class S>
auto free_coordinates(const arm_structure& s, const S& joints) {
  for_each_lane<S, unsigned> bits{};
  if (any(joints != S(0))) {
    if constexpr (is_pack<S>) {
      for (std::size_t i = 0; i < bits.size(); ++i) bits[i] = bits_of_v(s, static_cast<unsigned>(joints[i]));
    } else {
      bits = bits_of_v(s, static_cast<unsigned>(double_of(joints)));
    }
  }
  return bits;
}

/// Throws if there are no formulas for packs of poses.
template <class S>
void check_packs(const arm_structure& s) {
  if constexpr (is_pack<S>)
    if (s.form == closed_form::free_body || is_rough(s))
      raise<no_closed_form>(
          "kte: inverse kinematics of packs of poses is limited to arms whose closed forms need no "
          "equations of degree four and no tolerance; take the poses of this one by one");
}

/// All solutions in the form that users get: with limits, in the order of q.
template <class Arm, class S, class Q>
ik_answers<Q> all_finished(const Arm& arm, const arm_structure& s, const plain_pose_of<S>& x, const Q& start,
                           const S& extra) {
  const S least = S(64 * std::numeric_limits<S>::epsilon());
  const auto larger = [&least](double tolerance) { return select(least > S(tolerance), least, S(tolerance)); };
  const S most_m = S(s.reach) * larger(ik_tolerance{}.position), most_rad = larger(ik_tolerance{}.rotation);
  const auto rate = [&](ik_answer<Q>& a, const pose_gap<S>& gap) {
    a.position = gap.position, a.rotation = gap.rotation;
    a.exact = both<truth<S>>(a.position <= most_m, a.rotation <= most_rad);
  };
  check_packs<S>(s);
  ik_answers<Q> all;
  if constexpr (!is_pack<S>)
    if (s.form == closed_form::free_body) {
      auto& a = all.add(start);
      rate(a, place_free_body(s.original, x, a.q));
      a.within_limits = free_body_within(s.original, arm.limits(), start, a.q);
      return all;
    }
  auto solved = solve_closed_form(s, x, raw_angles<S>(s.original, start), extra);
  typename solved_answers<S>::row within;
  put_within_limits(arm, s, start, solved, within);
  for (std::size_t k = 0; k < solved.at.size; ++k) {
    auto& a = all.add(start);
    a.branch = solved.branch[k], a.within_limits = within[k] > S(0);
    rate(a, {solved.position[k], solved.rotation[k]});
    for (std::size_t i = 0; i < static_cast<std::size_t>(s.original.n); ++i)
      a.q[s.original.in_q[i]] = solved.at.t[i][k];
    a.free = free_coordinates(s, solved.free[k]);
  }
  return all;
}
template <class Arm>
void check_arm_angle(const Arm& arm) {
  check_closed_form(arm);
  if (arm.family() != arm_family::srs)
    raise<bad_argument>(
        "kte: this arm has no arm angle: its first three axes and its last three axes must each meet in a point");
}
template <class Arm>
limits_by_joint limits_of_joints(const Arm& arm) {
  const auto& original = arm.structure().original;
  limits_by_joint limits;
  for (std::size_t i = 0; i < static_cast<std::size_t>(original.n); ++i) {
    const auto v = static_cast<std::size_t>(original.in_v[i]);
    limits.lower[i] = arm.limits().lower[v], limits.upper[i] = arm.limits().upper[v];
  }
  return limits;
}
/// The structure of an arm with seven joints with one of them locked.
template <class Arm>
arm_structure structure_locked(const Arm& arm, std::string_view coordinate) {
  check_closed_form(arm);
  const arm_structure& s = arm.structure();
  const int last = s.original.n - 1;
  for (const auto& e : layout(arm)) {
    if (std::string_view(e.name) != coordinate) continue;
    for (const int i : {0, last})
      if (last == 6 && s.original.in_q[static_cast<std::size_t>(i)] == e.q) {
        const auto held = with_held(s.original, i, s.tolerance);
        if (held.form != closed_form::none) return held;
      }
    raise<no_closed_form>(
        "kte: no closed form of inverse kinematics with '" + std::string(coordinate) +
        "' locked: it is for the first or the last of seven joints, if the other six turn and have one");
  }
  raise<unknown_name>("kte: this chain has no coordinate '" + std::string(coordinate) + "'");
}

}  // namespace kte::detail
