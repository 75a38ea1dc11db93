#pragma once

#include <kte/manipulators/detail/goal_sums.hpp>
#include <kte/manipulators/nearest.hpp>
#include <kte/manipulators/tool_goals.hpp>

#include <tuple>

namespace kte::detail {

/// If the only goal is a pose of the only tool, and the arm has a closed form: replaces q by the nearest solution
/// within limits. Returns false if there is none.
template <class Arm, class Goals, class Q>
bool start_at_closed_form(const Arm&, const Goals&, Q&) {
  return false;
}
template <class Arm, class Tool, class Q>
bool start_at_closed_form(const Arm& arm, const std::tuple<reach_goal<Tool>>& goals, Q& q) {
  const auto& goal = std::get<0>(goals);
  if (arm.tools().size() != 1 || arm.structure().form == closed_form::none || !(goal.weights.position > 0) ||
      !(goal.weights.rotation > 0))
    return false;
  using S = typename Q::Scalar;
  auto now = starting_configuration<S>(arm);
  for (Eigen::Index i = 0; i < q.size(); ++i) now[i] = q[i];
  const auto wanted = checked_pose(plain_pose_of<S>{as<S>(matrix(goal.wanted.rotation)), as<S>(goal.wanted.position)});
  const auto best = best_near(arm, wanted, now);
  if (best.is != best.good) return false;
  q = best.answer.q;
  return true;
}

}  // namespace kte::detail
