#pragma once

#include <kte/manipulators/detail/goal_sums.hpp>
#include <kte/manipulators/inverse_kinematics.hpp>
#include <kte/manipulators/tool_goals.hpp>

#include <tuple>

namespace kte::detail {

/// Where all that is wanted of the only tool of an arm is a pose, and the arm has a closed form: puts the answer within
/// limits that is nearest to q into q. False if there is none.
template <class Arm, class Goals, class Q>
bool start_at_closed_form(const Arm&, const Goals&, Q&) {
  return false;
}
template <class Arm, class Tool, class Q>
bool start_at_closed_form(const Arm& arm, const std::tuple<reach_goal<Tool>>& goals, Q& q) {
  const auto& goal = std::get<0>(goals);
  if (arm.tools() != 1 || arm.structure().form == closed_form::none || !(goal.weights.position > 0) ||
      !(goal.weights.rotation > 0))
    return false;
  using S = typename Q::Scalar;
  S least = std::numeric_limits<S>::infinity();
  Q nearest = q;
  for (const auto& answer : inverse_kinematics(arm, goal.wanted)) {
    if (!answer.within_limits || !answer.exact) continue;
    Q candidate(q.size());
    for (Eigen::Index i = 0; i < q.size(); ++i) candidate[i] = S(answer.q[i]);
    if (const S away = difference(arm, q, candidate).squaredNorm(); away < least) least = away, nearest = candidate;
  }
  q = nearest;
  return least < std::numeric_limits<S>::infinity();
}

}  // namespace kte::detail
