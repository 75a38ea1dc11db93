#include "recorded_scene.hpp"

#include <kte/dynamics/state_vectors.hpp>
#include <kte/view/scene_of.hpp>

#include "option_names.hpp"
#include "state_input.hpp"

namespace kte_tool {

namespace {
kte::scene with_names_of_program(kte::scene s) {
  for (auto& note : s.notes) note = with_option_names(note);
  return s;
}
}  // namespace

kte::scene scene_of(const mechanism& m, const start_options& start) {
  if (!start.given()) return with_names_of_program(kte::scene_of(m.robot));
  auto s = m.chain().make_state();
  const initial_state first(start, m, m.chain());
  kte::set_positions(s, first.q), kte::set_velocities(s, first.v);
  m.chain().doMotion(s);
  return with_names_of_program(kte::scene_of(m.robot, s));
}

kte::scene scene_of(const mechanism& m, kte::table recording, const std::string& name) {
  const auto& c = m.chain();
  const recorded_state recorded(c);
  const evaluate::column_order order(kte::layout(c), coordinates_of(m, c));
  for (auto& column : recording.names)
    for (const auto& x : recorded.columns()) {
      const auto numbered = [&](const char* prefix, const std::vector<int>& places, recorded_column::part part) {
        for (std::size_t i = 0; i < places.size(); ++i)
          if (x.is == part && x.index == places[i] && column == prefix + std::to_string(i)) return true;
        return false;
      };
      if (column == x.name || numbered("q_", order.q, recorded_column::part::q) ||
          numbered("v_", order.v, recorded_column::part::v)) {
        column = x.whole;
        break;
      }
    }
  return with_names_of_program(kte::scene_of(m.robot, recording, {.name = name}));
}

}  // namespace kte_tool
