#pragma once

#include <kte/view/svg/plot/ticks.hpp>

namespace kte::detail::svg {

/// The label of an axis with the offset and factor of its ticks: "elbow - 1.5 (10^-6 rad)".
inline raised_text axis_label(std::string name, const std::string& unit, const tick_list& list) {
  if (!list.offset.empty()) {
    const bool below = list.offset.starts_with("−");
    if (name.empty()) name = "value";
    name += below ? " + " + list.offset.substr(std::string_view("−").size()) : " − " + list.offset;
  }
  const std::string open = name.empty() ? "(" : " (";
  if (list.exponent != 0)
    return {name + open + "10", signed_text(list.exponent), (unit.empty() ? "" : " " + unit) + ")"};
  return {unit.empty() ? name : name + open + unit + ")"};
}

}  // namespace kte::detail::svg
