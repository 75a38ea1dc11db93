#pragma once

#include <kte/robots/detail/mjcf_unread.hpp>

namespace kte::detail {

/// Reads the options of a file and its flags, which may disable gravity, springs, dampers and dry friction, and with
/// contact or equality disabled suppress their warnings. The last value of a repeated option is used.
inline void read_mjcf_options(const xml_item& root, robot_description& d, mjcf_unread& unread) {
  bool gravity = true, springs = true, dampers = true, friction = true, equality = true, contact = true;
  const auto flag = [](const xml_item& f, const char* name, bool& on) {
    if (f.has(name)) on = keyword(f, name, {"enable", "disable"}) == "enable";
  };
  for (const auto& o : root.children("option")) {
    unread.option(o);
    if (o.has("gravity")) d.gravity = o.vector("gravity");
    for (const auto& f : o.children("flag")) {
      flag(f, "passive", springs), flag(f, "passive", dampers), flag(f, "spring", springs), flag(f, "damper", dampers);
      flag(f, "gravity", gravity), flag(f, "frictionloss", friction), flag(f, "equality", equality);
      flag(f, "contact", contact);
      for (bool* on : {&friction, &equality, &contact}) flag(f, "constraint", *on);
    }
  }
  if (!gravity) d.gravity = vec3<>{};
  for (auto& j : d.joints) {
    auto& y = j.dynamics;
    if (!springs) y.stiffness = 0, y.stiffness_powers = {};
    if (!springs) y.damping_ratio = robot_joint::none;  // of a time constant the damper is left
    if (!dampers) y.damping = 0, y.damping_powers = {};
    if (!dampers && springs && y.time_constant > 0)
      d.warnings.push_back(
          {j.line, "joint '" + j.name + "': springdamper without dampers is not modelled", j.file, true});
    if (!dampers) y.time_constant = 0;
    if (y.time_constant == 0) y.damping_ratio = 0;
    if (!friction) y.friction = 0;
  }
  unread.switch_off(!equality, !contact);
  if (!contact)
    for (auto& l : d.links)
      for (auto& s : l.collisions) s.touch.type = s.touch.affinity = 0;
  if (!springs && !dampers)
    for (auto& l : d.links) l.gravity_compensation = 0;
}

}  // namespace kte::detail
