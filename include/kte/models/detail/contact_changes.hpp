#pragma once

#include <kte/dynamics/contacts/contact_forces.hpp>
#include <kte/models/detail/contact_slip_state.hpp>

namespace kte::detail {

/// What happened to a contact at an event.
struct contact_change {
  const char* impact = nullptr;
  double rest_time = -1;  ///< of bounces that get smaller, s
  bool bounces = false;
  contact_mode before{}, after{};
  vec3<> direction{};  ///< of sliding, before
  bool turns = false;
  bool passes = false;       ///< begins to pass through its surface
  bool has_no_load = false;  ///< whether the normal force has fallen to zero
  bool has_no_grip = false;  ///< whether the reserve of friction has fallen to zero
  bool yields = false;       ///< opens, or slides, because of these
  slip_state slip = slip_state::as_found;
  vec3<> slip_direction{};  ///< in which it slides if `is_sliding(slip)`

  bool is_change() const { return impact || passes || turns || before != after; }
};
/// What all contacts do; if none has changed at the event of contact `event_of`, what this one still does.
inline std::string text_of_changes(const chain_constraints& c, const contact_solver& m,
                                   const std::vector<contact_change>& all, int event_of) {
  std::string text;
  const auto name = [&](std::size_t i) { return "'" + c.loop_name(m.place(m.contacts[i]).loop) + "': "; };
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& x = all[i];
    std::string words;
    const auto say = [&words](const std::string& w) { words += (words.empty() ? "" : ", ") + w; };
    if (x.impact) say(x.impact);
    if (x.passes) say("passes");
    if (x.rest_time >= 0) say("rests at " + number(x.rest_time) + " s");
    if (x.before != x.after || x.impact)
      say(x.after == contact_mode::sticks   ? "sticks"
          : x.after == contact_mode::slides ? "slides"
          : x.impact                        ? "bounces"
                                            : "lifts");
    else if (x.turns)
      say("turns");
    if (words.empty()) continue;
    text += (text.empty() ? "" : "; ") + name(i) + words;
  }
  if (!text.empty()) return text;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (m.contacts[i].slot == event_of)
      text = name(i) + (all[i].after == contact_mode::sticks   ? "still sticks"
                        : all[i].after == contact_mode::slides ? "still slides"
                                                               : "still open");
  return text;
}

}  // namespace kte::detail
