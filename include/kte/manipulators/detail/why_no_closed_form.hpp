#pragma once

#include <kte/errors.hpp>
#include <kte/manipulators/detail/arm_structure.hpp>

#include <cmath>
#include <numbers>

namespace kte::detail {

/// A text that says why the axes of an arm have no closed form.
std::string why_no_closed_form(const arm_structure& s);

}  // namespace kte::detail

#ifdef KTE_FUNCTION
namespace kte::detail {

KTE_FUNCTION std::string why_no_closed_form(const arm_structure& s) {
  const arm_geometry& arm = s.original;
  if (arm.refused != nullptr) return std::string("no closed form of inverse kinematics: the arm ") + arm.refused;
  const std::string few = "no closed form of inverse kinematics for an arm of ";
  if (arm.n > 0 && arm.n <= 6 && s.reach > 0 && singular_everywhere(arm, s.reach))
    return few + std::to_string(arm.n) +
           " joints that is singular in every posture, as where four axes meet in a point";
  const auto turning = std::to_string(arm.turning()) + " joints that turn";
  const bool serial = arm.turning() == arm.n && (arm.n == 6 || arm.n == 7);
  if (!serial) {
    const bool slides = arm.turning() != arm.n;
    return few + turning + (slides ? " and " + std::to_string(arm.n - arm.turning()) + " that slide" : "") +
           (arm.n == 3 || arm.n == 4 ? ", whose axes are not parallel" : "");
  }
  const axes_of a{arm};
  const auto m = [](double x) { return number(x) + " m"; };
  const auto meeting = [&](int i) {
    const double miss = a.meet(i, i + 1, i + 2).miss;
    const auto n = [](int k) { return std::to_string(k + 1); };
    const auto axes = "axes " + n(i) + ", " + n(i + 1) + ", " + n(i + 2);
    return axes + (miss < 1e200 ? " pass within " + m(miss) : " are parallel");
  };
  std::string parallel;
  for (int i = 1; i + 3 < arm.n; ++i) {
    const double off = a.sine(i, i + 1) > a.sine(i, i + 2) ? a.sine(i, i + 1) : a.sine(i, i + 2);
    parallel += ", axes " + std::to_string(i + 1) + ", " + std::to_string(i + 2) + ", " + std::to_string(i + 3) +
                " are " + number(off < 1 ? std::asin(off) : std::numbers::pi / 2) + " rad from parallel";
  }
  return few + turning + ": " + meeting(0) + ", " + meeting(arm.n - 3) + parallel;
}

}  // namespace kte::detail
#endif
