#pragma once

#include <kte/runtime_chain/layout.hpp>

#include <limits>
#include <string>
#include <vector>

namespace kte {

namespace detail {
/// A std::array filled with x; for dynamic sizes an empty list.
template <class Numbers>
constexpr Numbers all_of(double x) {
  Numbers out{};
  for (auto& number : out) number = x;
  return out;
}
}  // namespace detail

/// Limits of the coordinates of a chain, each a list over v, in the order of the degrees of freedom:
///   lower, upper    of the coordinate, rad or m; for a pose or rotation along its numbers of v
///   rate            of |v|, rad/s or m/s
///   acceleration, jerk    of |v'|, |v''|
///   effort          of |tau|, Nm or N
/// Infinite (`none`) where there is no limit. Lists of dynamic size, such as std::vector, start with
/// `unlimited(chain)`. Limits do not change the dynamics of a chain (`joint_limit_gen` is an element that does):
/// inverse kinematics, planners and controllers read them.
template <class Numbers = std::vector<double>>
struct joint_limits {
  static constexpr double none = std::numeric_limits<double>::infinity();

  Numbers lower = detail::all_of<Numbers>(-none);
  Numbers upper = detail::all_of<Numbers>(none);
  Numbers rate = detail::all_of<Numbers>(none);
  Numbers acceleration = detail::all_of<Numbers>(none);
  Numbers jerk = detail::all_of<Numbers>(none);
  Numbers effort = detail::all_of<Numbers>(none);
  bool operator==(const joint_limits&) const = default;
};

/// Infinite limits for all coordinates of the chain.
template <class Gravity, class... E>
[[nodiscard]] constexpr auto unlimited(const static_chain<Gravity, E...>&) {
  return joint_limits<std::array<double, static_cast<std::size_t>(static_chain<Gravity, E...>::dofs)>>{};
}
[[nodiscard]] inline joint_limits<> unlimited(const runtime_chain& c) {
  const std::vector<double> none(static_cast<std::size_t>(c.dofs()), joint_limits<>::none);
  return {std::vector<double>(none.size(), -joint_limits<>::none), none, none, none, none, none};
}

namespace detail {
/// Text for number i of v: "coordinate 'elbow'", "coordinate 'trunk', number 2 of v".
template <class Table>
std::string text_of_rate(const Table& table, int i) {
  for (const auto& e : table)
    if (e.v <= i && i < e.v + e.nv)
      return "coordinate '" + std::string(e.name) + "'" +
             (e.nv > 1 ? ", number " + std::to_string(i - e.v + 1) + " of v" : "");
  return {};
}
}  // namespace detail

/// Throws `bad_parameter`, naming the coordinate, unless the lists have the size of v, lower <= upper, and the others
/// are not negative. Infinity is valid, NaN is not.
template <class Chain, class Numbers>
constexpr void check_limits(const Chain& chain, const joint_limits<Numbers>& limits) {
  const auto table = layout(chain);
  std::size_t n = 0;
  for (const auto& e : table) n += static_cast<std::size_t>(e.nv);
  const auto refuse = [&table](std::size_t i, const std::string& why) {
    detail::raise<bad_parameter>("kte: limits of " + detail::text_of_rate(table, static_cast<int>(i)) + why);
  };
  const auto sized = [n](const Numbers& list, const char* which) {
    if (list.size() != n)
      detail::raise<bad_parameter>("kte: limits: " + std::string(which) + " must have " + std::to_string(n) +
                                   " numbers, one for each of v, got " + std::to_string(list.size()));
  };
  sized(limits.lower, "lower"), sized(limits.upper, "upper");
  for (std::size_t i = 0; i < n; ++i)
    if (!(limits.lower[i] <= limits.upper[i]))
      refuse(i, ": lower must not be above upper, got " + detail::number(limits.lower[i]) + " and " +
                    detail::number(limits.upper[i]));
  const auto not_negative = [&](const Numbers& list, const char* which) {
    sized(list, which);
    for (std::size_t i = 0; i < n; ++i)
      if (!(list[i] >= 0))
        refuse(i, ": " + std::string(which) + " must not be negative, got " + detail::number(list[i]));
  };
  not_negative(limits.rate, "rate"), not_negative(limits.acceleration, "acceleration");
  not_negative(limits.jerk, "jerk"), not_negative(limits.effort, "effort");
}

}  // namespace kte
