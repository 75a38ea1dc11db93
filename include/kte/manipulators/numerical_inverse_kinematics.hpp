#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/manipulators/detail/closed_form_start.hpp>
#include <kte/manipulators/detail/descent.hpp>
#include <kte/manipulators/detail/second_level.hpp>
#include <kte/manipulators/goals.hpp>
#include <kte/manipulators/unreachable.hpp>
#ifdef KTE_COMPILED_HERE
#  include <kte/manipulators/runtime_manipulator.hpp>
#endif

namespace kte {

/// Options of `numerical_inverse_kinematics`.
struct numerical_ik_options {
  int iterations = 1000;    ///< largest number of iterations in total
  int draws = 16;           ///< random configurations per restart; the one with the smallest errors is used
  std::uint64_t seed = 1;   ///< of restarts: equal seeds give equal results
  double tolerance = 1e-9;  ///< relative to the reach, and in rad
  double length = 0;        ///< m per rad in errors; 0: reach/pi, so that half a turn counts as the reach
  bool numeric = false;     ///< do not start from the closed form, if any
  bool must_reach = false;  ///< throw `unreachable` instead of returning a status
};

/// How `numerical_inverse_kinematics` ended.
enum class numerical_ik_status {
  reached,        ///< all hard goals are attained within tolerance, soft ones as far as these allow
  at_limits,      ///< the best result found, at limits
  local_minimum,  ///< the best result found
};

/// The result of `numerical_inverse_kinematics`: the posture q, its `status`, and counts of `iterations` and
/// `restarts`.
template <class S, int N>
struct numerical_ik_result {
  joint_vector<S, N> q;  ///< within limits, always
  numerical_ik_status status;
  int iterations;
  int restarts;
  S position, rotation;  ///< largest errors of hard goals, m and rad
};

namespace detail {
/// The largest errors of the hard goals among these.
template <class Goals, class At>
auto largest_miss(const Goals& goals, const At& at) {
  goal_miss<typename At::scalar> most{};
  const auto add = [&](const auto& goal) {
    if constexpr (std::remove_cvref_t<decltype(goal)>::hard) {
      const auto m = goal.miss(at);
      most.linear = (std::max)(most.linear, m.linear), most.angular = (std::max)(most.angular, m.angular);
    }
  };
  std::apply([&](const auto&... goal) { (add(goal), ...); }, goals);
  return most;
}
template <class Goals>
inline constexpr bool has_hard = false;
template <class... Goal>
inline constexpr bool has_hard<std::tuple<Goal...>> = (Goal::hard || ...);
}  // namespace detail

/// Numerical inverse kinematics for any chain and any goals (`reach`, `reach_position`, `look_at`, `posture`,
/// `away_from_limits`, `manipulability`; several by `goals`, on two levels by `then`). Levenberg-Marquardt steps within
/// limits (manipulators/detail/descent.hpp) start at q_start, moved into the limits. If they do not attain the hard
/// goals, they restart from random configurations. If the only goal is a pose and the arm has a closed form, its
/// solutions are start values too; for non-redundant arms the nearest one is the first. Equal arguments give equal
/// results.
///
///   auto r = kte::numerical_inverse_kinematics(arm, kte::reach(tool, pose), q);
///   auto r = kte::numerical_inverse_kinematics(arm, kte::goals(kte::reach(tool, pose), kte::posture(rest)), q);
///
/// Throws `bad_argument` for arguments that are not finite or of wrong size, `bad_parameter` for limits of position of
/// a rotation or pose, `unreachable` with `must_reach`. Nothing is allocated for static chains, except by `posture` and
/// `manipulability`.
template <class Arm, class Goals, indexable Q>
[[nodiscard]] numerical_ik_result<value_of<Q>, detail::arm_at<Arm, value_of<Q>>::configuration::RowsAtCompileTime>
numerical_inverse_kinematics(const Arm& arm, const Goals& wanted, const Q& q_start,
                             const numerical_ik_options& options = {}) {
  using S = value_of<Q>;
  using at_type = detail::arm_at<Arm, S>;
  detail::check_limits_of_poses(arm);
  const double largest = (std::numeric_limits<double>::max)();
  if (options.iterations < 1 || options.draws < 1 || !(options.tolerance > 0 && options.tolerance <= largest))
    detail::raise<bad_argument>(
        "kte: options of numerical_inverse_kinematics: iterations, draws and tolerance must be greater than 0, and "
        "finite");
  if (!(options.length >= 0 && options.length <= largest))
    detail::raise<bad_argument>("kte: options of numerical_inverse_kinematics: length must be finite and not negative");
  const auto levels = detail::as_levels(wanted);
  const auto numbers = neutral_configuration(arm).size();
  detail::check_configuration_of(arm, q_start, "q_start");
  typename at_type::configuration start(numbers);
  for (Eigen::Index i = 0; i < numbers; ++i) start[i] = S(q_start[static_cast<std::size_t>(i)]);
  detail::clamp_to_limits(arm, start);

  const S reach = detail::reach_of<S>(arm, start);
  at_type at(arm, start, options.length > 0 ? S(options.length) : S(reach / S(std::numbers::pi)));
  constexpr bool hard = detail::has_hard<std::remove_const_t<decltype(levels.first)>>;
  const auto met_by = [&](double part) {
    if constexpr (!hard) return false;
    const auto m = detail::largest_miss(levels.first, at);
    return m.linear <= S(part * options.tolerance) * reach && m.angular <= S(part * options.tolerance);
  };
  const auto met = [&] { return met_by(1); };
  const double stall = hard ? 1e-4 : 1e-14;

  numerical_ik_result<S, at_type::configuration::RowsAtCompileTime> out{
      start, numerical_ik_status::local_minimum, 0, 0, S(0), S(0)};
  detail::even_numbers random(options.seed);
  S least = std::numeric_limits<S>::infinity();
  // For arms with finitely many solutions the closed form returns the nearest. For others it has to search, which takes
  // as long as about ten starts.
  const auto at_closed_form = [&] {
    auto answer = start;
    const bool found = !options.numeric && detail::start_at_closed_form(arm, levels.first, answer);
    if (found) at.move(answer);
    return found;
  };
  const bool redundant = detail::dofs_of(arm) > 6;
  if (!redundant) at_closed_form();
  for (;; ++out.restarts) {
    const int left = options.iterations - out.iterations;
    const int patience = hard ? 4 : left;  // a new start is cheaper than waiting
    const auto run = detail::descend(at, levels.first, left, patience, stall, met);
    out.iterations += run.iterations;
    if (const S half = detail::half_squares<S>(levels.first, at); run.done || half < least || out.restarts == 0) {
      least = half, out.q = at.q;
      out.status = run.done || !hard ? numerical_ik_status::reached
                   : run.held        ? numerical_ik_status::at_limits
                                     : numerical_ik_status::local_minimum;
    }
    if (out.status == numerical_ik_status::reached || out.iterations >= options.iterations) break;
    if (redundant && out.restarts == 9 && at_closed_form()) continue;
    S best = std::numeric_limits<S>::infinity();
    typename at_type::configuration next = start;
    for (int i = 0; i < options.draws; ++i) {
      at.move(detail::somewhere(arm, start, static_cast<double>(reach), random));
      if (const S half = detail::half_squares<S>(levels.first, at); half < best) best = half, next = at.q;
    }
    at.move(next);
  }
  at.move(out.q);
  if (out.status == numerical_ik_status::reached)
    out.iterations +=
        detail::use_freedom(at, levels.first, levels.second, options.iterations, [&] { return met_by(1e-4); });
  else  // the nearest solution
    out.iterations += detail::descend(at, levels.first, 100, 100, 1e-15, met).iterations;
  out.q = at.q;
  const auto missed = detail::largest_miss(levels.first, at);
  out.position = missed.linear, out.rotation = missed.angular;
  if (options.must_reach && out.status != numerical_ik_status::reached)
    detail::raise_unreachable(
        out.q, static_cast<double>(out.position), static_cast<double>(out.rotation),
        out.status == numerical_ik_status::at_limits ? unreachable_reason::limits : unreachable_reason::local_minimum);
  return out;
}

}  // namespace kte

#ifdef KTE_EXTERN
namespace kte {
class runtime_chain;
template <>
class manipulator<runtime_chain, void>;
KTE_EXTERN template numerical_ik_result<double, Eigen::Dynamic> numerical_inverse_kinematics(
    const manipulator<runtime_chain, void>&, const detail::reach_goal<std::string>&, const Eigen::VectorXd&,
    const numerical_ik_options&);
}  // namespace kte
#endif
