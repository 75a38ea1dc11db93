#include "recorded_scene.hpp"

#include <kte/dynamics/state_vectors.hpp>
#include <kte/view/scene_of.hpp>

#include <algorithm>

#include "option_names.hpp"
#include "state_input.hpp"

namespace kte_tool {

namespace {
kte::scene with_names_of_program(kte::scene s) {
  for (auto& note : s.notes) note = with_option_names(note);
  return s;
}
/// Throws `bad_argument` for quantities that depend on more than coordinates, or on rates that the recording lacks.
void check_computed(const kte::runtime_chain& c, const std::vector<std::string>& names, bool has_rates) {
  for (const auto& name : names)
    for (const auto& cell : kte::detail::recording(kte::detail::slots_of(c), {name}).cells) {
      char group = 'f';
      kte::detail::with_kind(cell.what, [&]<kte::kind K>() {
        if constexpr (kte::is_frame(K) || kte::is_coordinate(K))
          group = kte::detail::quantities<K, double>[cell.quantity].group;
      });
      if (group == 'q' || (group == 'v' && has_rates)) continue;
      throw kte::bad_argument("kte: the recording has no column '" + name + "'" +
                              (group == 'v' ? ", and none of the velocities, which determine it" : "") +
                              ": kte simulate --record writes it with --column " + name);
    }
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

kte::scene scene_of(const mechanism& m, kte::table recording, const std::string& name,
                    const std::vector<std::string>& plotted) {
  const auto& c = m.chain();
  const recorded_state recorded(c);
  const evaluate::column_order order(kte::layout(c), coordinates_of(m, c));
  const auto in_file = recording.names;
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
  std::vector<std::string> there, computed;
  for (const auto& wanted : plotted) {
    const auto before = there.size();
    const auto is_wanted = [&](const std::string& n) { return n == wanted || n.starts_with(wanted + "/"); };
    for (std::size_t i = 0; i < in_file.size(); ++i)
      if (is_wanted(in_file[i]) || is_wanted(recording.names[i])) there.push_back(recording.names[i]);
    if (there.size() == before) computed.push_back(wanted);
  }
  auto s = with_names_of_program(kte::scene_of(m.robot, recording, {.name = name, .columns = computed}));
  auto& r = s.recordings.front();
  check_computed(c, computed, !r.v.empty());
  r.plotted.insert(r.plotted.begin(), there.begin(), there.end());
  return s;
}

std::vector<std::string> meshes_not_drawn(const mechanism& m) {
  std::vector<std::string> all;
  const auto& shapes = m.robot.shapes;
  const auto is_mesh = [](const auto& s) { return s.is == kte::robot_shape::form::mesh; };
  if (std::none_of(shapes.begin(), shapes.end(), is_mesh)) return all;
  try {
    for (const auto& note : kte::not_drawn(scene_of(m, start_options{})))
      if (note.starts_with("mesh ")) all.push_back(note);
  } catch (const kte::error&) {  // loops that do not close, which are a separate finding
  }
  return all;
}

}  // namespace kte_tool
