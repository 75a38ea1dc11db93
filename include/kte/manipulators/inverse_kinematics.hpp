#pragma once

#include <kte/manipulators/detail/arm_angle_reference.hpp>
#include <kte/manipulators/detail/arm_coordinates.hpp>
#include <kte/manipulators/detail/finished_answers.hpp>
#include <kte/manipulators/detail/wanted_pose.hpp>
#include <kte/manipulators/ik_requests.hpp>

namespace kte {

/// All postures in which the first tool of an arm has a given pose, in closed form, in a fixed order of branches
/// (solution b of eight has branch b). The pose is in axes of the base, a rotation and a position, as returned by
/// `forward_kinematics`:
///
///   for (const auto& a : kte::inverse_kinematics(arm, pose)) if (a.exact && a.within_limits) use(a.q);
///
/// An arm with seven joints has infinitely many solutions; the result has those with arm angle 0, or with the locked
/// joint at 0 (`arm_angle`, `locked`). Angles are between -pi and pi, or within their limits if a multiple of 2 pi
/// moves them there. Coordinates that do not move the tool are those of `neutral_configuration`. For a pose out of
/// reach, solutions are least-squares solutions, which are not `exact`.
///
/// The function is generic in the scalar of the pose: dual numbers give derivatives, packs solve several poses at once,
///
///   kte::inverse_kinematics(arm, pose_of_packs)[b].q    // exact and within_limits are masks
///
/// for all arms except those with equations of degree four. Throws `no_closed_form`, and `bad_argument` for an invalid
/// pose. A static arm whose type rules out a closed form does not compile.
template <class Chain, class Tools, class Rotation, class Position>
[[nodiscard]] auto inverse_kinematics(const manipulator<Chain, Tools>& arm, const pose<Rotation, Position>& wanted) {
  detail::refuse_by_type(arm);
  detail::check_closed_form(arm);
  const auto x = detail::checked_pose(detail::spatial(wanted));
  using S = std::remove_cvref_t<decltype(x.position.x)>;
  return detail::all_finished(arm, arm.structure(), x, detail::starting_configuration<S>(arm), S(0));
}

/// All postures of an arm with seven axes at a given arm angle.
template <class Chain, class Tools, class Rotation, class Position>
[[nodiscard]] auto inverse_kinematics(const manipulator<Chain, Tools>& arm, const pose<Rotation, Position>& wanted,
                                      arm_angle angle) {
  detail::refuse_by_type(arm);
  detail::check_arm_angle(arm);
  if (!(angle.psi - angle.psi == 0)) detail::raise<bad_argument>("kte: an arm angle must be finite");
  const auto x = detail::checked_pose(detail::spatial(wanted));
  using S = std::remove_cvref_t<decltype(x.position.x)>;
  const S psi = S(angle.psi) + detail::to_stereographic(arm.structure(), detail::goal_of(arm.structure(), x).position,
                                                        angle.reference);
  return detail::all_finished(arm, arm.structure(), x, detail::starting_configuration<S>(arm), psi);
}

/// All postures of an arm with seven joints with its first or last joint locked.
template <class Chain, class Tools, class Rotation, class Position>
[[nodiscard]] auto inverse_kinematics(const manipulator<Chain, Tools>& arm, const pose<Rotation, Position>& wanted,
                                      const locked_joint& joint) {
  detail::refuse_by_type(arm);
  if (!(joint.value - joint.value == 0)) detail::raise<bad_argument>("kte: the value of a locked joint must be finite");
  const auto s = detail::structure_locked(arm, joint.coordinate);
  const auto x = detail::checked_pose(detail::spatial(wanted));
  using S = std::remove_cvref_t<decltype(x.position.x)>;
  return detail::all_finished(arm, s, x, detail::starting_configuration<S>(arm), S(joint.value));
}

/// The intervals of arm angles in which an arm with seven axes reaches a pose with all joints within limits, for each
/// branch. Interval ends are accurate to rounding, and near singular postures of shoulder or wrist to its square root.
/// All intervals are found, however narrow. For shoulders and wrists with orthogonal axes.
template <class Chain, class Tools, class Rotation, class Position>
[[nodiscard]] detail::arm_angle_list arm_angle_intervals(const manipulator<Chain, Tools>& arm,
                                                         const pose<Rotation, Position>& wanted,
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

/// The arm angle of a posture, rad. Throws `bad_argument` for a q of wrong size or that is not finite.
template <class Chain, class Tools, indexable Q>
[[nodiscard]] auto arm_angle_of(const manipulator<Chain, Tools>& arm, const Q& q,
                                arm_angle_from reference = arm_angle_from::stereographic) {
  detail::check_arm_angle(arm);
  detail::check_configuration_of(arm, q, "q");
  using S = value_of<Q>;
  const auto& s = arm.structure();
  const auto joints = detail::raw_angles<S>(s.original, q);
  const auto position = detail::goal_of(s, detail::tool_pose(s.original, joints)).position;
  return detail::wrapped(
      S(detail::arm_angle_at<S>(s, position, joints) - detail::to_stereographic<S>(s, position, reference)));
}

}  // namespace kte
