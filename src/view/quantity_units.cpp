#include "quantity_units.hpp"

#include <kte/io/quantities.hpp>

#include <algorithm>

namespace kte::view {

namespace {
/// The unit of a coordinate with one number, and of its rates.
std::string unit_of_number(const std::string& unit, std::string_view quantity) {
  if (unit != "rad" && unit != "m") return {};
  if (quantity == "v") return unit + "/s";
  if (quantity == "a") return unit + "/s^2";
  if (quantity == "f") return unit == "rad" ? "N m" : "N";
  return unit;
}
std::string unit_of_name(std::string_view quantity) {
  if (quantity == "position") return "m";
  if (quantity == "angle") return "rad";
  if (quantity == "velocity") return "m/s";
  if (quantity == "ang_velocity") return "rad/s";
  if (quantity == "acceleration") return "m/s^2";
  if (quantity == "ang_acceleration") return "rad/s^2";
  if (quantity == "force") return "N";
  if (quantity == "torque") return "N m";
  return quantity == "rotation" ? "1" : "";
}
}  // namespace

std::string unit_of_quantity(const detail::chain_parts& chain, const scene& s, const detail::recorded& x) {
  if (x.is_energy()) return "J";
  std::string unit;
  detail::with_kind(x.what, [&]<kind K>() {
    const auto quantity = detail::quantities<K, double>[x.quantity].name;
    if constexpr (K == kind::gen) {
      for (const auto& slot : chain.slots[static_cast<std::size_t>(K)]) {
        if (slot.slot != x.slot) continue;
        for (const auto& c : s.coordinates)
          if (c.name == slot.name) unit = unit_of_number(c.unit, quantity);
      }
    } else {
      unit = unit_of_name(quantity);
    }
  });
  return unit;
}
std::string unit_of_column(const detail::chain_parts& chain, const scene& s, const std::string& name) {
  try {
    const detail::recording found(chain.slots, {name}, detail::energy_columns::allowed);
    return found.cells.empty() ? "s" : unit_of_quantity(chain, s, found.cells.front());
  } catch (const unknown_name&) {
    return {};
  }
}

}  // namespace kte::view
