#pragma once

#include <kte/manipulators/inverse_kinematics.hpp>

namespace kte {

namespace detail {
/// The best solution: the exact solution within limits nearest to the present posture.
template <class Q>
struct best_answer {
  ik_answer<Q> answer;
  double way = 1e300;
  enum rank_of { none, away, beyond_limits, good } is = none;

  /// |q - q_now|^2 over the joints; for solutions that are not exact, their error.
  void look_at(const arm_structure& s, const ik_answer<Q>& a, const Q& now) {
    double apart = 0;
    const auto rank = !a.exact ? away : a.within_limits ? good : beyond_limits;
    if (rank == away) {
      apart = double_of(a.position) / s.reach + double_of(a.rotation);
    } else {
      for (std::size_t i = 0; i < static_cast<std::size_t>(s.original.n); ++i) {
        const double d = double_of(a.q[s.original.in_q[i]]) - double_of(now[s.original.in_q[i]]);
        apart += d * d;
      }
    }
    if (rank < is || (rank == is && !(apart < way))) return;
    answer = a, way = apart, is = rank;
  }
};

template <class S, class Arm, class Q>
void look_at_all(const Arm& arm, const plain_pose_of<S>& x, const Q& now, double extra, best_answer<Q>& best) {
  for (const auto& a : all_finished(arm, arm.structure(), x, now, S(extra))) best.look_at(arm.structure(), a, now);
}

/// Seven axes: searches at the present arm angle, or at the nearest one with a solution within limits.
template <class S, class Arm, class Q>
void look_for_arm_angle(const Arm& arm, const plain_pose_of<S>& x, const Q& now, best_answer<Q>& best) {
  const double psi = double_of(arm_angle_of(arm, now));
  look_at_all(arm, x, now, psi, best);
  if (best.is == best_answer<Q>::good) return;
  plain_pose_of<double> y;
  const auto copy = [](const vec3<S>& v) { return vec3<>{double_of(v.x), double_of(v.y), double_of(v.z)}; };
  y = {{copy(x.rotation.x), copy(x.rotation.y), copy(x.rotation.z)}, copy(x.position)};
  const auto [R, p] = goal_of(arm.structure(), y);
  for (const auto& way : feasible_angles(arm.structure(), R, p, limits_of_joints(arm))) {
    // Slightly inside, so that rounding does not violate the limit.
    const double inside = (std::min)(1e-12, (way.upper - way.lower) / 4), lower = way.lower + inside,
                 upper = way.upper - inside;
    const double to_lower = std::remainder(lower - psi, 2 * std::numbers::pi);
    const double to_upper = std::remainder(upper - psi, 2 * std::numbers::pi);
    look_at_all(arm, x, now, std::abs(to_lower) < std::abs(to_upper) ? lower : upper, best);
  }
}

/// The search range and step of a locked joint. A revolute joint is searched around its present value in steps of 0.05
/// rad. A prismatic joint is searched where the arm reaches from its first joint to the tool,
///
///   |p - p_1 - t h| <= reach,  h along the slide, p the position of the tool,       (1)
///
/// starting at the value nearest to the present one, in steps of 1/32 of the reach. A slide at the tool is treated as
/// one at the base, for the reversed arm.
struct held_joint_search {
  double from, step;
};
template <class S>
held_joint_search search_of(const arm_structure& s, const plain_pose_of<S>& x, double here) {
  const auto joint = static_cast<std::size_t>(s.held);
  if (!s.original.slides[joint]) return {here, 0.05};
  using std::sqrt;
  const bool first = joint == 0;
  const auto arm = first ? s.original : reversed(s.original);
  const auto pose = first ? x : plain_pose_of<S>(inverse(x));
  const vec3<S> way = pose.position - as<S>(arm.point[1]);
  const double along = double_of(S(dot(as<S>(arm.axis[0]), way)));
  const double room = s.reach * s.reach + along * along - double_of(S(dot(way, way)));
  const double half = room > 0 ? sqrt(room) : 0;
  return {(std::min)((std::max)(here, along - half), along + half), s.reach / 32};
}

/// Locks the joint at its present value, or at the nearest value with a solution within limits. Searches in steps, then
/// by bisection.
template <class S, class Arm, class Q>
void look_for_held_joint(const Arm& arm, const plain_pose_of<S>& x, const Q& now, best_answer<Q>& best) {
  const auto& s = arm.structure();
  const auto joint = static_cast<std::size_t>(s.held);
  const double here = double_of(now[s.original.in_q[joint]]);
  const auto v = static_cast<std::size_t>(s.original.in_v[joint]);
  const double lower = arm.limits().lower[v], upper = arm.limits().upper[v];
  const auto good_at = [&](double t) {
    best_answer<Q> one;
    if (t < lower || t > upper) return false;
    look_at_all(arm, x, now, t, one);
    if (one.is >= best.is) best.look_at(s, one.answer, now);
    return one.is == best_answer<Q>::good;
  };
  if (good_at(here)) return;
  const auto [there, step] = search_of(s, x, here);
  const double from = (std::min)((std::max)(there, lower), upper);
  if (from != here && good_at(from)) return;
  for (int k = 1; k <= 64; ++k)
    for (const double side : {step, -step}) {
      if (!good_at(from + k * side)) continue;
      double good = k, bad = k - 1;
      for (int half = 0; half < 30; ++half) {
        const double middle = (good + bad) / 2;
        (good_at(from + middle * side) ? good : bad) = middle;
      }
      return;
    }
}

template <class S, class Arm, class Q>
best_answer<Q> best_near(const Arm& arm, const plain_pose_of<S>& x, const Q& now) {
  best_answer<Q> best;
  if (arm.family() == arm_family::srs)
    look_for_arm_angle(arm, x, now, best);
  else if (arm.structure().held >= 0)
    look_for_held_joint(arm, x, now, best);
  else
    look_at_all(arm, x, now, 0.0, best);
  return best;
}
}  // namespace detail

/// The exact solution within limits that is nearest to a posture: the least |q - q_now|, including multiples of 2 pi
/// within the limits. Arbitrary angles are unchanged. An arm with seven joints keeps its arm angle (or its locked
/// joint). If there is no solution within limits at this value, the nearest value with one is used; a locked joint is
/// searched in steps of 0.05 rad, a track in steps of 1/32 of the reach.
///
/// Throws `unreachable` with the best posture if there is no solution. If the closed form has no solution at all, the
/// error has no posture and infinite errors.
template <class Chain, class Tools, class Rotation, class Position, class Q>
[[nodiscard]] auto inverse_kinematics(const manipulator<Chain, Tools>& arm, const pose<Rotation, Position>& wanted,
                                      const nearest_to<Q>& to) {
  using namespace detail;
  refuse_by_type(arm);
  check_closed_form(arm);
  const auto x = checked_pose(spatial(wanted));
  using S = std::remove_cvref_t<decltype(x.position.x)>;
  static_assert(!is_pack<S>, "kte: the nearest posture needs a single pose, not a pack");
  auto now = starting_configuration<S>(arm);
  check_configuration_of(arm, to.q, "q_now");
  for (Eigen::Index i = 0; i < now.size(); ++i) now[i] = S(to.q[static_cast<std::size_t>(i)]);
  const auto best = best_near(arm, x, now);
  if (best.is == best.none)  // equations of degree four may have no solution at all
    raise<unreachable>("kte: this pose cannot be reached", unreachable_reason::distance, std::vector<double>{},
                       std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity());
  if (best.is != best.good) {
    std::vector<double> q;
    for (Eigen::Index i = 0; i < best.answer.q.size(); ++i) q.push_back(double_of(best.answer.q[i]));
    const double m = double_of(best.answer.position), rad = double_of(best.answer.rotation);
    const bool limits = best.is == best.beyond_limits;
    raise<unreachable>(limits ? "kte: this pose is reached beyond the limits of joints only"
                              : "kte: this pose cannot be reached; the nearest posture found has an error of " +
                                    number(m) + " m and " + number(rad) + " rad",
                       limits ? unreachable_reason::limits : unreachable_reason::distance, std::move(q), m, rad);
  }
  return best.answer;
}

/// All solutions within limits, with every multiple of a turn that the limits of each joint permit, for joints with a
/// range of more than one turn.
template <class Chain, class Tools, class Q>
[[nodiscard]] std::vector<ik_answer<Q>> unwrapped(const manipulator<Chain, Tools>& arm, const ik_answers<Q>& answers) {
  using S = value_of<Q>;
  const auto& original = arm.structure().original;
  const S turn = S(2) * detail::half_turn<S>();
  std::vector<ik_answer<Q>> all;
  for (const auto& a : answers) {
    if (!a.within_limits) continue;
    std::size_t first = all.size();
    all.push_back(a);
    for (std::size_t i = 0; i < static_cast<std::size_t>(original.n); ++i) {
      const auto v = static_cast<std::size_t>(original.in_v[i]);
      const double lower = arm.limits().lower[v], upper = arm.limits().upper[v];
      if (original.slides[i] || lower < -1e300 || upper > 1e300) continue;
      const std::size_t last = all.size();
      const Eigen::Index q = original.in_q[i];
      for (std::size_t k = first; k < last; ++k) {
        auto more = all[k];
        for (more.q[q] += turn; more.q[q] <= S(upper); more.q[q] += turn) all.push_back(more);
        for (more.q[q] = all[k].q[q] - turn; more.q[q] >= S(lower); more.q[q] -= turn) all.push_back(more);
      }
    }
  }
  return all;
}

}  // namespace kte
