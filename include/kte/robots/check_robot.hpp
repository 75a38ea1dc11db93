#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/robots/to_robot.hpp>

namespace kte {

/// What is odd about a robot, in words, each with its line if it is from a file: what reading it warned of (inertias
/// that no matter has, angles that are nearly quarter turns, axes of other lengths), what makes no tree, joints that
/// move no mass, ranges of nothing, efforts and rates of 0, and a mass matrix that is nearly singular at one of twenty
/// random configurations (always the same). No findings: an empty list.
std::vector<robot_note> check_robot(const robot_description& d, const robot_options& options = {});
/// The same of a robot as it is, by its coordinates.
std::vector<robot_note> check_robot(const robot& r);

}  // namespace kte

#ifdef KTE_FUNCTION
#  include <kte/robots/detail/robot_findings.hpp>
#endif
