#pragma once

#include <map>
#include <string>
#include <string_view>

namespace kte {

/// Units by names, of coordinates and inputs or of columns: `{{"elbow", "rad"}, {"slide", "m"}, {"motor", "N m"}}`.
using unit_map = std::map<std::string, std::string, std::less<>>;

namespace detail::svg {

/// The unit and quantity of a column.
struct column_meaning {
  std::string unit;      ///< "m/s"; empty if unknown, or 1
  std::string quantity;  ///< "velocity"; empty if unknown
  friend bool operator==(const column_meaning&, const column_meaning&) = default;
};

/// Suffixes that recorders append to the name of a frame or coordinate (see `recorder`).
inline constexpr struct {
  std::string_view name, components, unit, quantity;
} recorded_quantities[]{{"position", "xyz", "m", "position"},
                        {"rotation", "wxyz", "", "quaternion"},
                        {"angle", "", "rad", "angle"},
                        {"velocity", "xyz", "m/s", "velocity"},
                        {"ang_velocity", "xyz", "rad/s", "angular velocity"},
                        {"acceleration", "xyz", "m/s²", "acceleration"},
                        {"ang_acceleration", "xyz", "rad/s²", "angular acceleration"},
                        {"force", "xyz", "N", "force"},
                        {"torque", "xyz", "N m", "torque"}};

/// The unit of a coordinate, its rates, or the force on it (q, v, a, f), by the unit of the coordinate.
inline column_meaning meaning_on_coordinate(char which, std::string_view unit) {
  const bool angle = unit == "rad", length = unit == "m", known = !unit.empty();
  const std::string u(unit);
  switch (which) {
    case 'v':
      return {known ? u + "/s" : "", angle ? "angular velocity" : length ? "velocity" : "rate"};
    case 'a':
      return {known ? u + "/s²" : "", angle ? "angular acceleration" : length ? "acceleration" : "second rate"};
    case 'f':
      return {angle ? "N m" : length ? "N" : "", angle ? "torque" : length ? "force" : "generalised force"};
    default:
      return {unit == "1" ? "" : u, angle ? "angle" : length ? "position" : ""};
  }
}

/// For display: "m/s²" for "m/s^2".
inline std::string printed_unit(std::string unit) {
  for (const auto& [plain, raised] : {std::pair("^2", "²"), std::pair("^3", "³")})
    for (auto at = unit.find(plain); at != unit.npos; at = unit.find(plain)) unit.replace(at, 2, raised);
  return unit;
}

/// The meaning of a column by its name, or of an object with its own unit.
inline column_meaning meaning_by_name(std::string_view name, const unit_map& units) {
  if (name == "t" || name == "time") return {"s", "time"};
  if (name == "energy" || name.starts_with("energy/")) return {"J", "energy"};
  const auto unit_of = [&units](std::string_view thing) {
    auto u = units.find(thing);
    for (const std::string_view prefix : {"coordinate:", "signal:"})
      if (u == units.end() && thing.starts_with(prefix)) u = units.find(thing.substr(prefix.size()));
    return u == units.end() ? std::string() : printed_unit(u->second);
  };
  std::string_view thing = name, part;
  const auto cut = [&] {
    const auto slash = thing.rfind('/');
    part = slash == thing.npos ? std::string_view() : thing.substr(slash + 1);
    if (slash != thing.npos) thing = thing.substr(0, slash);
  };
  cut();
  for (const auto& q : recorded_quantities)
    if (part == q.name) return {std::string(q.unit), std::string(q.quantity)};
  if (part.empty()) return meaning_on_coordinate('q', unit_of(name));
  if (part == "v" || part == "a" || part == "f") return meaning_on_coordinate(part[0], unit_of(thing));
  const char component = part[0];
  if (part.size() != 1 || std::string_view("wxyz").find(component) == std::string_view::npos) return {};
  if (const auto u = unit_of(thing); !u.empty()) return meaning_on_coordinate('q', u);  // a component, such as pull/x
  cut();
  for (const auto& q : recorded_quantities)
    if (part == q.name && q.components.find(component) != q.components.npos)
      return {std::string(q.unit), std::string(q.quantity)};
  return {};
}
/// The unit of a column; `units` may contain its full name.
inline column_meaning meaning_of_column(std::string_view name, const unit_map& units) {
  auto meaning = meaning_by_name(name, units);
  const auto u = units.find(name);
  if (u == units.end()) return meaning;
  if (meaning.quantity.empty()) return meaning_on_coordinate('q', printed_unit(u->second));
  meaning.unit = u->second == "1" ? "" : printed_unit(u->second);
  return meaning;
}

}  // namespace detail::svg
}  // namespace kte
