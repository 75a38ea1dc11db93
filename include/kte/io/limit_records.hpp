#pragma once

#include <kte/models/joint_limits.hpp>

#include <cmath>

/// Limits as plain data, by the names of coordinates, and back.
namespace kte {

namespace detail {
/// Calls visit(name, list, value without a limit) for all lists.
template <class Limits, class Visit>
void visit_limits(Limits& l, const Visit& visit) {
  constexpr double none = std::numeric_limits<double>::infinity();
  visit("lower", l.lower, -none), visit("upper", l.upper, none), visit("rate", l.rate, none);
  visit("acceleration", l.acceleration, none), visit("jerk", l.jerk, none), visit("effort", l.effort, none);
}
}  // namespace detail

/// The finite limits of a chain as records. Throws `bad_parameter` like `check_limits`.
template <class Chain, class Numbers>
[[nodiscard]] std::vector<limit_record> limit_records(const Chain& c, const joint_limits<Numbers>& limits) {
  check_limits(c, limits);
  std::vector<limit_record> all;
  for (const auto& e : layout(c)) {
    limit_record r{std::string(e.name), {}};
    detail::visit_limits(limits, [&](const char* name, const auto& list, double none) {
      const auto first = list.begin() + e.v, last = first + e.nv;
      if (std::any_of(first, last, [none](double x) { return x != none; }))
        r.limits.push_back({name, std::vector<double>(first, last)});
    });
    if (!r.limits.empty()) all.push_back(std::move(r));
  }
  return all;
}

/// The limits of a chain in the record of a model, by the names of its coordinates. Throws `unknown_name`,
/// `bad_parameter`, and `bad_file` for a number of limits other than that of v of the coordinate.
template <class Chain>
[[nodiscard]] auto limits_of(const Chain& c, const model_record& m) {
  auto limits = unlimited(c);
  const auto table = layout(c);
  for (const auto& r : m.limits) {
    const auto e = std::find_if(table.begin(), table.end(), [&r](const auto& x) { return x.name == r.coordinate; });
    if (e == table.end())
      detail::raise<unknown_name>("kte: " + to_string(r.place) + "limits of '" + r.coordinate +
                                  "', which is not a degree of freedom of the chain");
    detail::visit_limits(limits, [&](const char* name, auto& list, double) {
      for (const auto& p : r.limits) {
        if (p.name != name) continue;
        if (p.values.size() != static_cast<std::size_t>(e->nv))
          detail::raise<bad_file>("kte: " + to_string(p.place) + "limits of '" + r.coordinate + "': " + name +
                                  " must have " + std::to_string(e->nv) + " numbers, got " +
                                  std::to_string(p.values.size()));
        std::copy(p.values.begin(), p.values.end(), list.begin() + e->v);
      }
    });
  }
  check_limits(c, limits);
  return limits;
}

}  // namespace kte
