#pragma once

#include <kte/manipulators/posture_goals.hpp>
#include <kte/manipulators/tool_goals.hpp>

#include <tuple>

/// Goals of `numerical_inverse_kinematics`. `reach`, `reach_position` and `look_at` are hard: they are attained, or the
/// result says that they are not. `posture`, `away_from_limits`, `manipulability`, and hard goals made soft by `soft`,
/// are attained as closely as the hard goals permit.
namespace kte {

namespace detail {
template <class Goal>
struct soft_goal {
  static constexpr bool hard = false;
  Goal goal;
  double weight;
  template <class At, class Sum>
  void add_to(const At& at, Sum& sum) const {
    using S = typename At::scalar;
    const auto weighted = [&](const S& e, const S& w, const auto& row) { sum(e, S(S(weight) * w), row); };
    goal.add_to(at, weighted);
  }
};

/// The goals of the first level, and those for the remaining freedom.
template <class First, class Second>
struct goal_levels {
  First first;
  Second second;
};
template <bool Hard, class Goal>
auto only(const Goal& g) {
  if constexpr (Goal::hard == Hard) {
    return std::tuple{g};
  } else {
    return std::tuple{};
  }
}
template <class First, class Second>
auto levels(const First& first, const Second& second) {
  if constexpr (std::tuple_size_v<First> == 0) {
    return goal_levels<Second, std::tuple<>>{second, {}};
  } else {
    return goal_levels<First, Second>{first, second};
  }
}
template <class First, class Second>
auto all_of_levels(const goal_levels<First, Second>& g) {
  return std::tuple_cat(g.first, g.second);
}
template <class Goal>
requires requires { Goal::hard; }
auto all_of_levels(const Goal& g) { return std::tuple{g}; }
template <class First, class Second>
auto as_levels(const goal_levels<First, Second>& g) {
  return g;
}
template <class Goal>
requires requires { Goal::hard; }
auto as_levels(const Goal& g) { return levels(std::tuple{g}, std::tuple{}); }
}  // namespace detail

/// Makes a goal soft, with a weight of its squares among the soft goals.
template <class Goal>
[[nodiscard]] auto soft(double weight, const Goal& goal) {
  if (!(weight >= 0) || weight - weight != 0)
    detail::raise<bad_argument>("kte: the weight of a goal must be finite and not negative");
  return detail::soft_goal<Goal>{goal, weight};
}
/// Several goals: soft goals are attained as far as the hard ones allow.
template <class... Goal>
[[nodiscard]] auto goals(const Goal&... each) {
  return detail::levels(std::tuple_cat(detail::only<true>(each)...), std::tuple_cat(detail::only<false>(each)...));
}
/// Goals on two levels: the first, with its hard and soft goals, is attained as well as possible; the second within the
/// remaining freedom.
template <class First, class Second>
[[nodiscard]] auto then(const First& first, const Second& second) {
  const auto a = detail::all_of_levels(first);
  const auto b = detail::all_of_levels(second);
  return detail::goal_levels<std::remove_const_t<decltype(a)>, std::remove_const_t<decltype(b)>>{a, b};
}

}  // namespace kte
