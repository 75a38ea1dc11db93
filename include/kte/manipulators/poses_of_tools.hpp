#pragma once

#include <kte/frames/fitted_pose.hpp>
#include <kte/manipulators/inverse_kinematics.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace kte {

/// The pose of a body that moves freely (`uav`, `free_floater`) for which all its tools have the given poses, in their
/// order. There is one solution,
///
///   auto r = kte::inverse_kinematics(floater, std::array{left_pose, right_pose});
///
/// by (1) of frames/fitted_pose.hpp, with rotations weighted by the square of the largest distance between tools (1 m
/// for a single tool). It is `exact` if every tool has its pose, up to rounding of positions far from the origin.
/// Throws `no_closed_form` for other arms and for tools that are not on the body, `bad_argument` for an invalid pose or
/// a wrong number of poses.
template <class Chain, class Tools, class Poses>
requires requires(const Poses& x) { x[0].rotation, x[0].position, x.size(); }
auto inverse_kinematics(const manipulator<Chain, Tools>& arm, const Poses& wanted) {
  using namespace detail;
  const arm_structure& s = arm.structure();
  if (s.form != closed_form::free_body)
    raise<no_closed_form>(
        "kte: poses of several tools have a closed form where a body moves freely; kte::numerical_inverse_kinematics "
        "takes "
        "them of any arm");
  const auto start = starting_configuration<double>(arm);
  const auto still = arm.getDependentPoses(start);
  if (wanted.size() != still.size())
    raise<bad_argument>("kte: inverse kinematics of " + std::to_string(still.size()) +
                        " tools needs as many poses, got " + std::to_string(wanted.size()));
  std::vector<plain_pose_of<double>> from, to;
  double apart = 0, away = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    from.push_back(checked_pose(plain_pose_of<double>(spatial(still[i]))));
    to.push_back(checked_pose(plain_pose_of<double>(spatial(wanted[i]))));
    away = (std::max)(away, std::sqrt(dot(to[i].position, to[i].position)));
    for (const auto& x : from) {
      const vec3<> d = from[i].position - x.position;
      apart = (std::max)(apart, std::sqrt(dot(d, d)));
    }
  }
  fitted_motion fit;
  for (std::size_t i = 0; i < from.size(); ++i) {
    fit.add(from[i].position, to[i].position);
    fit.add(from[i].rotation, to[i].rotation, apart > 0 ? apart * apart : 1);
  }
  const auto moved = fit.motion(s.original.moves == arm_geometry::freely::in_plane);

  ik_answers<std::remove_cvref_t<decltype(start)>> all;
  auto& a = all.add(start);
  place_free_body(s.original, plain_pose_of<double>(compose(moved, from[0])), a.q);
  const auto there = arm.getDependentPoses(a.q);
  const double rounding = 16 * std::numeric_limits<double>::epsilon() * away;  // of positions far from the origin
  for (std::size_t i = 0; i < from.size(); ++i) {
    const plain_pose_of<double> tool = spatial(there[i]);
    const auto off = gap_between(tool, plain_pose_of<double>(compose(moved, from[i])));
    if (!(off.position <= 1e-9 * (1 + apart) + rounding && off.rotation <= 1e-9))
      raise<no_closed_form>("kte: tool " + std::to_string(i + 1) + " of these is not on the body that moves freely");
    const auto gap = gap_between(tool, to[i]);
    a.position = (std::max)(a.position, gap.position), a.rotation = (std::max)(a.rotation, gap.rotation);
  }
  a.exact = a.position <= ik_tolerance{}.position * (s.reach + apart) + rounding &&
            a.rotation <= ik_tolerance{}.rotation + (apart > 0 ? rounding / apart : 0);
  a.within_limits = free_body_within(s.original, arm.limits(), start, a.q);
  return all;
}

}  // namespace kte
