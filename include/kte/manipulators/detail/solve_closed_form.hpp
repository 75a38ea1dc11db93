#pragma once

#include <kte/manipulators/detail/newton_step.hpp>
#include <kte/manipulators/detail/planar_axes.hpp>
#include <kte/manipulators/detail/quartic_axes.hpp>
#include <kte/manipulators/detail/srs_axes.hpp>
#include <kte/manipulators/detail/tool_pose.hpp>
#include <kte/math/atan2.hpp>

namespace kte::detail {

/// The pose for the formulas: the rotation of all joints of `arm` together, and the position of the last origin.
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

/// The pose for the joints of `arm_structure::arm`, with the locked joint at `value`.
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
    case closed_form::srs:
      return shoulder_and_wrist(s, R, p, extra, seed);
    case closed_form::planar:
    case closed_form::scara:
      return planar_and_slide(s, x.rotation, x.position, seed);
    default:
      break;
  }
  if constexpr (!is_pack<S>) {
    if (s.form == closed_form::wrist_general) return wrist_and_three_axes(s, R, p, seed);
    if (s.form == closed_form::parallel_general) return parallel_and_two_axes(s, R, p, seed);
  }
  return {};
}

/// All solutions, by joint of `arm_structure::original`: rad in [-pi, pi], m. Rows as in `raw_answers`.
template <class S>
struct solved_answers {
  using row = typename raw_answers<S>::row;

  postures<S> at;
  row position, rotation;  ///< errors of the tool, m and rad
  row free;                ///< sum of 2^i over the free joints i of `arm_structure::arm`
  std::array<unsigned, raw_answers<S>::most> branch;
};

/// Stores the results of the formulas, by joint of `original`. The locked joint is at `value`, with sine and cosine
/// `turn`.
template <class S>
void put_postures(const arm_structure& s, const raw_answers<S>& raw, const S& value, const solved_angle<S>& turn,
                  postures<S>& all) {
  all.size = raw.size;
  const std::size_t full = raw.padded(raw.size);
  for (std::size_t k = 0; k < static_cast<std::size_t>(s.arm.n); ++k) {
    const auto j = s.joint(k);
    const S sign = S(s.sign[k]);
    if (s.arm.slides[k]) {
      for (std::size_t a = 0; a < full; ++a) all.t[j][a] = sign * raw.slide[a];
      continue;
    }
    for (std::size_t a = 0; a < full; ++a) {
      all.sine[j][a] = sign * raw.sine[k][a] + S(0);  // pi, never -pi
      all.cosine[j][a] = raw.cosine[k][a];
    }
    atan2_each(all.sine[j].data(), all.cosine[j].data(), all.t[j].data(), full);
  }
  if (s.held >= 0) {
    const auto j = static_cast<std::size_t>(s.held);
    all.sine[j].fill(turn.sin), all.cosine[j].fill(turn.cos), all.t[j].fill(value);
  }
}

/// Whether solutions need `polish`: roots of equations of degree four are less accurate than rounding, and axes may
/// deviate from the formulas (if a tolerance was given).
constexpr bool is_loose(const arm_structure& s) { return s.tolerance > arm_structure::strict && s.original.n >= 6; }
constexpr bool is_rough(const arm_structure& s) {
  return is_loose(s) || s.form == closed_form::wrist_general || s.form == closed_form::parallel_general;
}

/// Newton steps for solution a, as long as they reduce the error; with damping near double roots. If axes deviate from
/// the formulas, more and longer steps.
template <class S>
void polish(const arm_structure& s, const plain_pose_of<S>& wanted, solved_answers<S>& all, std::size_t a) {
  const bool loose = is_loose(s);
  const std::size_t first = s.held == 0 ? 1 : 0;
  const auto away = [&](const pose_gap<S>& g) { return double_of(g.position) / s.reach + double_of(g.rotation); };
  const double least = 8 * double_of(std::numeric_limits<S>::epsilon());
  const auto at = [&](const by_joint<S>& t) { return gap_between(tool_pose(s.original, t), wanted); };
  auto best = all.at.posture(a);
  pose_gap<S> gap{all.position[a], all.rotation[a]};
  const auto towards = [&] { return towards_pose(s.original, first, wanted, best, s.reach); };
  const auto take = [&](const by_joint<S>& t, const pose_gap<S>& now) { best = t, gap = now; };
  for (int k = 0; k < (loose ? 8 : 2) && away(gap) > least; ++k) {
    auto t = best;
    newton_step(towards(), first, t, loose ? 0.1 : 1e-3);
    const auto now = at(t);
    if (!loose && !(away(now) < away(gap))) break;
    take(t, now);
  }
  for (int k = 0; k < 30 && away(gap) > least && away(gap) < 1e-4; ++k) {
    auto t = best;
    damped_step(towards(), first, t);
    const auto now = at(t);
    if (!(away(now) < 0.9 * away(gap))) break;
    take(t, now);
  }
  for (std::size_t j = 0; j < static_cast<std::size_t>(s.original.n); ++j) all.at.t[j][a] = best[j];
  all.position[a] = gap.position, all.rotation[a] = gap.rotation;
}

/// All solutions of an arm. Free angles are those of `seed`. `extra`: the arm angle, or the value of the locked joint.
template <class S>
solved_answers<S> solve_closed_form(const arm_structure& s, const plain_pose_of<S>& wanted, const by_joint<S>& seed,
                                    const S& extra) {
  const auto n = static_cast<std::size_t>(s.arm.n);
  by_joint<S> start{};
  for (std::size_t k = 0; k < n; ++k) start[k] = S(s.sign[k]) * seed[s.joint(k)];
  const auto turn = angle_of(extra);
  const auto raw = answers_by_formulas(s, pose_for_formulas(s, wanted, extra, turn), turns_of(start), turn);
  solved_answers<S> out;
  put_postures(s, raw, extra, turn, out.at);
  out.at.look_at_gaps(s.original, wanted, out.position, out.rotation);
  out.branch = raw.branch, out.free = raw.free;
  if constexpr (!is_pack<S>)
    if (is_rough(s))
      for (std::size_t a = 0; a < out.at.size; ++a) polish(s, wanted, out, a);
  return out;
}

}  // namespace kte::detail

#ifdef KTE_EXTERN
namespace kte::detail {
KTE_EXTERN template solved_answers<double> solve_closed_form(const arm_structure&, const plain_pose_of<double>&,
                                                             const by_joint<double>&, const double&);
}
#endif
