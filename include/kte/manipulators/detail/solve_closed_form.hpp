#pragma once

#include <kte/manipulators/detail/newton_step.hpp>
#include <kte/manipulators/detail/planar_axes.hpp>
#include <kte/manipulators/detail/quartic_axes.hpp>
#include <kte/manipulators/detail/srs_axes.hpp>
#include <kte/manipulators/detail/tool_pose.hpp>
#include <kte/math/atan2.hpp>

namespace kte::detail {

/// What the formulas work on: the turn of all joints of `arm` together, and where the origin of the last is.
template <class S>
struct arm_goal {
  rotation_matrix<S> R;
  vec3<S> position;
};
template <class S>
arm_goal<S> goal_of(const arm_structure& s, const plain_pose_of<S>& x) {
  const rotation_matrix<S> R = x.rotation * as<S>(transpose(s.arm.tool.rotation));
  return {R, x.position - R * as<S>(s.arm.tool.position - s.p(s.arm.n - 1))};
}

/// What is wanted of `arm_structure::arm` when the joint that is held stands at `value`.
template <class S>
plain_pose_of<S> pose_for_formulas(const arm_structure& s, plain_pose_of<S> x, const S& value,
                                   const solved_angle<S>& turn) {
  if (s.held >= 0) {
    const auto i = static_cast<std::size_t>(s.held);
    const auto back = inverse(joint_pose<S>(s.original, i, value, turn));
    const plain_pose_of<S> tool{as<S>(s.original.tool.rotation), as<S>(s.original.tool.position)};
    x = i == 0 ? compose(back, x) : compose(x, compose(inverse(tool), compose(back, tool)));
  }
  return s.backwards ? plain_pose_of<S>(inverse(x)) : x;
}

template <class S>
raw_answers<S> answers_by_formulas(const arm_structure& s, const plain_pose_of<S>& x, const joint_turns<S>& seed,
                                   const solved_angle<S>& extra) {
  const auto [R, p] = goal_of(s, x);
  switch (s.form) {
    case closed_form::wrist_parallel:
      return wrist_and_parallel(s, R, p, seed);
    case closed_form::parallel_meeting:
      return parallel_and_meeting(s, R, p, seed);
    case closed_form::wrist_general:
      return wrist_and_three_axes(s, R, p, seed);
    case closed_form::parallel_general:
      return parallel_and_two_axes(s, R, p, seed);
    case closed_form::srs:
      return shoulder_and_wrist(s, R, p, extra, seed);
    case closed_form::planar:
    case closed_form::scara:
      return planar_and_slide(s, x.rotation, x.position, seed);
    default:
      return {};
  }
}

/// An answer by joint of `arm_structure::original`: rad in [-pi, pi], m.
template <class S>
struct solved_answer {
  by_joint<S> t;
  unsigned branch, free;
  pose_gap<S> gap;  ///< by which the tool is away
};
template <class S>
struct solved_answers {
  std::array<solved_answer<S>, raw_answers<S>::most> all;
  std::size_t size = 0;
};

/// What the formulas gave, by joint of `original`; the joint that is held stands at `value`, of which `turn` is the
/// sine and cosine.
template <class S>
postures<S> postures_of(const arm_structure& s, const raw_answers<S>& raw, const S& value,
                        const solved_angle<S>& turn) {
  postures<S> all;
  all.size = raw.size;
  constexpr std::size_t lanes = tree::lanes_of<S>::count;
  const std::size_t full = (raw.size + lanes - 1) / lanes * lanes;
  for (std::size_t k = 0; k < static_cast<std::size_t>(s.arm.n); ++k) {
    const auto j = s.joint(k);
    for (std::size_t a = 0; a < full; ++a) {
      const auto& x = raw.all[a < raw.size ? a : 0];
      all.sine[j][a] = S(s.sign[k]) * x.turn.sine[k] + S(0), all.cosine[j][a] = x.turn.cosine[k];  // pi, never -pi
      if (s.arm.slides[k]) all.t[j][a] = S(s.sign[k]) * x.slide;
    }
    if (!s.arm.slides[k]) atan2_each(all.sine[j].data(), all.cosine[j].data(), all.t[j].data(), full);
  }
  if (s.held >= 0) {
    const auto j = static_cast<std::size_t>(s.held);
    all.sine[j].fill(turn.sin), all.cosine[j].fill(turn.cos), all.t[j].fill(value);
  }
  return all;
}

/// Newton's steps where roots of equations of degree four are worse than rounding, as long as they bring nearer: next
/// to double roots with damping. And where axes are not quite as formulas have them (a tolerance was given), more of
/// them, and longer.
template <class S>
void polish(const arm_structure& s, const plain_pose_of<S>& wanted, solved_answer<S>& y) {
  const bool loose = s.tolerance > arm_structure::strict && s.original.n >= 6;
  if (!loose && s.form != closed_form::wrist_general && s.form != closed_form::parallel_general) return;
  const std::size_t first = s.held == 0 ? 1 : 0;
  const auto far = [&](const pose_gap<S>& g) { return double_of(g.position) / s.reach + double_of(g.rotation); };
  const double least = 8 * double_of(std::numeric_limits<S>::epsilon());
  const auto at = [&](const by_joint<S>& t) { return gap_between(tool_pose(s.original, t), wanted); };
  const auto towards = [&] { return towards_pose(s.original, first, wanted, y.t, s.reach); };
  for (int k = 0; k < (loose ? 8 : 2) && far(y.gap) > least; ++k) {
    auto t = y.t;
    newton_step(towards(), first, t, loose ? 0.1 : 1e-3);
    const auto gap = at(t);
    if (!loose && !(far(gap) < far(y.gap))) break;
    y.t = t, y.gap = gap;
  }
  for (int k = 0; k < 30 && far(y.gap) > least && far(y.gap) < 1e-4; ++k) {
    auto t = y.t;
    damped_step(towards(), first, t);
    const auto gap = at(t);
    if (!(far(gap) < 0.9 * far(y.gap))) return;
    y.t = t, y.gap = gap;
  }
}

/// All answers of an arm; angles that are free are as in `seed`. `extra` is the arm angle, or the value of the joint
/// that is held.
template <class S>
solved_answers<S> solve_closed_form(const arm_structure& s, const plain_pose_of<S>& wanted, const by_joint<S>& seed,
                                    const S& extra) {
  const auto n = static_cast<std::size_t>(s.arm.n);
  by_joint<S> start{};
  for (std::size_t k = 0; k < n; ++k) start[k] = S(s.sign[k]) * seed[s.joint(k)];
  const auto turn = angle_of(extra);
  const auto raw = answers_by_formulas(s, pose_for_formulas(s, wanted, extra, turn), turns_of(start), turn);
  const auto found = postures_of(s, raw, extra, turn);
  std::array<pose_gap<S>, raw_answers<S>::most> gap;
  found.look_at_gaps(s.original, wanted, gap);

  solved_answers<S> out;
  out.size = raw.size;
  for (std::size_t a = 0; a < raw.size; ++a) {
    auto& y = out.all[a];
    y.t = {}, y.branch = raw.all[a].branch, y.free = 0, y.gap = gap[a];
    for (std::size_t j = 0; j < static_cast<std::size_t>(s.original.n); ++j) y.t[j] = found.t[j][a];
    if (raw.all[a].free != 0)
      for (std::size_t k = 0; k < n; ++k)
        if (raw.all[a].free >> k & 1u) y.free |= 1u << s.joint(k);
    polish(s, wanted, y);
  }
  return out;
}

}  // namespace kte::detail
