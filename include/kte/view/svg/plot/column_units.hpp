#pragma once

#include <map>
#include <string>
#include <string_view>

namespace kte {

/// Units by names, of coordinates and inputs or of columns: `{{"elbow", "rad"}, {"slide", "m"}, {"motor", "N m"}}`.
using unit_map = std::map<std::string, std::string, std::less<>>;

namespace detail::svg {

/// What the numbers of a column are.
struct column_meaning {
  std::string unit;      ///< "m/s"; empty where it is not known, or 1
  std::string quantity;  ///< "velocity"; empty where it is not known
  friend bool operator==(const column_meaning&, const column_meaning&) = default;
};

/// What recorders name behind the name of a frame or of a coordinate (see `recorder`).
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

/// Of a coordinate, its rates, and the force on it, by its own unit; q, v, a, f is which.
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

/// As it is printed: "m/s²" for "m/s^2".
inline std::string printed_unit(std::string unit) {
  for (const auto& [plain, raised] : {std::pair("^2", "²"), std::pair("^3", "³")})
    for (auto at = unit.find(plain); at != unit.npos; at = unit.find(plain)) unit.replace(at, 2, raised);
  return unit;
}

/// What recorders mean by the name of a column.
inline column_meaning meaning_of_column(std::string_view name, const unit_map& units) {
  if (const auto u = units.find(name); u != units.end()) return meaning_on_coordinate('q', printed_unit(u->second));
  if (name == "t" || name == "time") return {"s", "time"};
  std::string_view thing = name, part;
  const auto cut = [&] {
    const auto slash = thing.rfind('/');
    part = slash == thing.npos ? std::string_view() : thing.substr(slash + 1);
    if (slash != thing.npos) thing = thing.substr(0, slash);
  };
  cut();
  for (const auto& q : recorded_quantities)
    if (part == q.name) return {std::string(q.unit), std::string(q.quantity)};
  if (part.size() != 1) return {};
  for (const std::string_view prefix : {"coordinate:", "signal:"})
    if (units.find(thing) == units.end() && thing.starts_with(prefix)) thing.remove_prefix(prefix.size());
  if (part == "v" || part == "a" || part == "f") {
    const auto u = units.find(thing);
    return meaning_on_coordinate(part[0], u == units.end() ? std::string_view() : std::string_view(u->second));
  }
  if (const auto u = units.find(thing); u != units.end())
    return meaning_on_coordinate('q', printed_unit(u->second));  // pull/x
  const char component = part[0];
  cut();
  for (const auto& q : recorded_quantities)
    if (part == q.name && q.components.find(component) != q.components.npos)
      return {std::string(q.unit), std::string(q.quantity)};
  return {};
}

}  // namespace detail::svg
}  // namespace kte
