#pragma once

#include <kte/robots/detail/sdf_values.hpp>

namespace kte::detail {

/// Reads the gravity of a world and notes its joints with the named model. Returns whether a wind blows.
inline bool read_sdf_world(robot_description& d, const xml_item& w, const std::string& model) {
  w.only({"model", "include", "gravity", "wind", "joint"}, {"name"});
  d.gravity = child_vector(w, "gravity", {0, 0, -9.8});
  for (const auto& j : w.children("joint")) {
    bool ours = false;
    for (const auto* end : {"parent", "child"})
      if (const auto c = first_child(j, end)) {
        const auto name = trimmed_content(*c);
        ours |= name == model || name.starts_with(model + "::");
      }
    if (ours)
      j.moves_differently("joints of the world are not read: the robot is not connected to its surroundings");
    else
      j.not_read("not read");
  }
  const auto wind = first_child(w, "wind");
  return wind && child_vector(*wind, "linear_velocity", {}) != vec3<>{};
}

}  // namespace kte::detail
