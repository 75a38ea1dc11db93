#pragma once

#include <kte/dynamics/configuration_space.hpp>
#include <kte/manipulators/detail/arm_angle_reference.hpp>
#include <kte/manipulators/detail/feasible_angles.hpp>
#include <kte/manipulators/detail/wanted_pose.hpp>
#include <kte/manipulators/detail/why_no_closed_form.hpp>
#include <kte/manipulators/ik_answers.hpp>
#include <kte/manipulators/ik_requests.hpp>
#include <kte/manipulators/manipulator.hpp>

namespace kte {

namespace detail {
/// Where coordinates are that nobody asks for.
template <class S, class Arm>
auto starting_configuration(const Arm& arm) {
  return neutral_configuration(arm).template cast<S>().eval();
}

/// Does not compile where the type of a static arm says that it has no closed form, whatever its numbers are.
template <class Chain, key_type First, key_type... More>
constexpr void refuse_by_type(const manipulator<Chain, tool_keys<First, More...>>&) {
  static_assert(sizeof...(More) == 0,
                "kte: inverse kinematics in closed form is of an arm with one tool; kte::clik takes goals of several");
  static_assert(sizeof...(More) > 0 || may_have_closed_form<First, Chain>(),
                "kte: no closed form of inverse kinematics: for that an arm has three, four, six or seven joints of "
                "one free coordinate each between base and tool; kte::clik solves others");
}
template <class Arm>
constexpr void refuse_by_type(const Arm&) {}

/// Throws unless this arm has a closed form.
template <class Arm>
void check_closed_form(const Arm& arm) {
  if (arm.tools().size() != 1)
    raise<bad_argument>("kte: inverse kinematics in closed form is of an arm with one tool; this one has " +
                        std::to_string(arm.tools().size()));
  if (arm.structure().form == closed_form::none)
    raise<no_closed_form>("kte: " + why_no_closed_form(arm.structure()) + "; kte::clik needs none");
}

/// A configuration, by joint.
template <class S, class Q>
by_joint<S> raw_angles(const arm_geometry& arm, const Q& q) {
  by_joint<S> t{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(arm.n); ++i) t[i] = S(q[static_cast<Eigen::Index>(arm.in_q[i])]);
  return t;
}

/// All answers as users get them: with limits, in the order of q.
template <class Arm, class S, class Q>
ik_answers<Q> all_finished(const Arm& arm, const arm_structure& s, const plain_pose_of<S>& x, const Q& start,
                           const S& extra) {
  const auto solved = solve_closed_form(s, x, raw_angles<S>(s.original, start), extra);
  const S least = S(64 * std::numeric_limits<S>::epsilon());
  const auto larger = [&least](double tolerance) { return least > S(tolerance) ? least : S(tolerance); };
  const S most_m = S(s.reach) * larger(ik_tolerance{}.position), most_rad = larger(ik_tolerance{}.rotation);
  ik_answers<Q> all;
  for (std::size_t k = 0; k < solved.size; ++k) {
    const auto& y = solved.all[k];
    auto& a = all.add(start);
    a.branch = y.branch, a.within_limits = true;
    a.position = y.gap.position, a.rotation = y.gap.rotation;
    a.exact = a.position <= most_m && a.rotation <= most_rad;
    for (std::size_t i = 0; i < static_cast<std::size_t>(s.original.n); ++i) {
      const auto v = static_cast<std::size_t>(s.original.in_v[i]);
      const Eigen::Index q = s.original.in_q[i];
      S t = y.t[i];
      a.within_limits &= bring_within(arm.limits().lower[v], arm.limits().upper[v], s.original.slides[i], start[q], t);
      a.q[q] = t;
      if (y.free >> i & 1u) a.free |= 1u << v;
    }
  }
  return all;
}
template <class Arm>
void check_arm_angle(const Arm& arm) {
  check_closed_form(arm);
  if (arm.family() != arm_family::srs)
    raise<bad_argument>("kte: this arm has no arm angle: of its axes, not the first and the last three meet");
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
/// The structure of an arm of seven joints of which one is held.
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
}  // namespace detail

/// Every posture by which the first tool of an arm has a pose (in axes of the base; rotation and position, as
/// `forward_kinematics` gives it), by formulas, in a fixed order of branches:
///
///   for (const auto& a : kte::inverse_kinematics(arm, pose)) if (a.exact && a.within_limits) use(a.q);
///
/// An arm of seven joints has infinitely many: these are those of arm angle 0, or with the held joint at 0
/// (`arm_angle`, `locked`). Angles are between -pi and pi, or within their limits if a multiple of 2 pi takes them
/// there. Coordinates that do not move the tool are as in `neutral_configuration`. What cannot be reached has answers
/// of least squares, which are not `exact`.
///
/// Generic in the scalar of the pose, so also derivatives by dual numbers. Throws `no_closed_form`, and `bad_argument`
/// for a pose that is none; where the type of a static arm says that it has no closed form, it does not compile.
template <class Chain, class Tools, class Rotation, class Position>
auto inverse_kinematics(const manipulator<Chain, Tools>& arm, const pose<Rotation, Position>& wanted) {
  detail::refuse_by_type(arm);
  detail::check_closed_form(arm);
  const auto x = detail::checked_pose(detail::spatial(wanted));
  using S = std::remove_cvref_t<decltype(x.position.x)>;
  return detail::all_finished(arm, arm.structure(), x, detail::starting_configuration<S>(arm), S(0));
}

/// The same of an arm of seven axes at an arm angle.
template <class Chain, class Tools, class Rotation, class Position>
auto inverse_kinematics(const manipulator<Chain, Tools>& arm, const pose<Rotation, Position>& wanted, arm_angle angle) {
  detail::refuse_by_type(arm);
  detail::check_arm_angle(arm);
  if (!(angle.psi - angle.psi == 0)) detail::raise<bad_argument>("kte: an arm angle must be finite");
  const auto x = detail::checked_pose(detail::spatial(wanted));
  using S = std::remove_cvref_t<decltype(x.position.x)>;
  const S psi = S(angle.psi) + detail::to_stereographic(arm.structure(), detail::goal_of(arm.structure(), x).position,
                                                        angle.reference);
  return detail::all_finished(arm, arm.structure(), x, detail::starting_configuration<S>(arm), psi);
}

/// The same of an arm of seven joints whose first or last stands still.
template <class Chain, class Tools, class Rotation, class Position>
auto inverse_kinematics(const manipulator<Chain, Tools>& arm, const pose<Rotation, Position>& wanted,
                        const locked_joint& joint) {
  detail::refuse_by_type(arm);
  if (!(joint.value - joint.value == 0)) detail::raise<bad_argument>("kte: the value of a locked joint must be finite");
  const auto s = detail::structure_locked(arm, joint.coordinate);
  const auto x = detail::checked_pose(detail::spatial(wanted));
  using S = std::remove_cvref_t<decltype(x.position.x)>;
  return detail::all_finished(arm, s, x, detail::starting_configuration<S>(arm), S(joint.value));
}

/// At which arm angles an arm of seven axes has a pose with all joints within limits: for each branch all intervals,
/// their ends to rounding (next to singular postures of shoulder or wrist, to its square root). Between them there is
/// no answer within limits, however narrow they are. Of shoulders and wrists with right angles.
template <class Chain, class Tools, class Rotation, class Position>
detail::arm_angle_list arm_angle_intervals(const manipulator<Chain, Tools>& arm, const pose<Rotation, Position>& wanted,
                                           arm_angle_from reference = arm_angle_from::stereographic) {
  detail::check_arm_angle(arm);
  const auto x = detail::checked_pose(detail::spatial(wanted));
  const auto [R, p] = detail::goal_of(arm.structure(), x);
  auto all = detail::feasible_angles(arm.structure(), R, p, detail::limits_of_joints(arm));
  if (const double offset = detail::to_stereographic(arm.structure(), p, reference); offset != 0)
    for (std::size_t i = 0; i < all.size(); ++i) {
      auto& way = all.item[i];
      const double size = way.upper - way.lower;
      way.lower = std::remainder(way.lower - offset, 2 * std::numbers::pi), way.upper = way.lower + size;
    }
  return all;
}

/// The arm angle of a posture.
template <class Chain, class Tools, indexable Q>
auto arm_angle_of(const manipulator<Chain, Tools>& arm, const Q& q,
                  arm_angle_from reference = arm_angle_from::stereographic) {
  detail::check_arm_angle(arm);
  using S = value_of<Q>;
  const auto& s = arm.structure();
  const auto joints = detail::raw_angles<S>(s.original, q);
  const auto position = detail::goal_of(s, detail::tool_pose(s.original, joints)).position;
  return detail::wrapped(
      S(detail::arm_angle_at<S>(s, position, joints) - detail::to_stereographic<S>(s, position, reference)));
}

}  // namespace kte
