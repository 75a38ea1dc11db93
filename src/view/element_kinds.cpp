#include "element_kinds.hpp"

#include <kte/elements/compiled_elements.hpp>

#include <algorithm>
#include <iterator>

namespace kte::view {

namespace {
/// Elements with special symbols, by their type.
constexpr element_kind listed_kinds[]{{"ang_velocity_control", drawn::link, ""},
                                      {"base", drawn::base, ""},
                                      {"brake", drawn::force, "friction"},
                                      {"bristle_contact", drawn::force, "contact"},
                                      {"bushing", drawn::force, "bushing"},
                                      {"coincident_frames", drawn::force, "loop"},
                                      {"coincident_points", drawn::force, "loop"},
                                      {"compliant_contact", drawn::force, "contact"},
                                      {"compliant_disc_contact", drawn::force, "contact"},
                                      {"coupled_coordinates", drawn::force, "loop"},
                                      {"cylindrical", drawn::force, "loop"},
                                      {"damper", drawn::force, "damper"},
                                      {"dc_motor", drawn::force, "motor"},
                                      {"disc_contact", drawn::force, "contact"},
                                      {"distance", drawn::force, "loop"},
                                      {"driving_actuator", drawn::force, "motor"},
                                      {"dry_revolute_joint", drawn::joint, "revolute"},
                                      {"dyad_bar1", drawn::force, "loop"},
                                      {"dyad_bar2", drawn::force, "loop"},
                                      {"flexible_beam", drawn::force, "beam"},
                                      {"force_actuator", drawn::force, "motor"},
                                      {"force_law", drawn::force, "other"},
                                      {"four_bar_coupler", drawn::force, "loop"},
                                      {"four_bar_rocker", drawn::force, "loop"},
                                      {"free_joint", drawn::joint, "free"},
                                      {"hinge", drawn::force, "loop"},
                                      {"inertia", drawn::body, ""},
                                      {"inertial_beam", drawn::force, "beam"},
                                      {"joint_backlash", drawn::force, "limit"},
                                      {"joint_backlash_mode", drawn::force, "limit"},
                                      {"joint_cubic_damping", drawn::force, "damper"},
                                      {"joint_cubic_stiffness", drawn::force, "spring"},
                                      {"joint_damping", drawn::force, "damper"},
                                      {"joint_elasto_plastic", drawn::force, "friction"},
                                      {"joint_friction", drawn::force, "friction"},
                                      {"joint_limit", drawn::force, "limit"},
                                      {"joint_lugre", drawn::force, "friction"},
                                      {"joint_motor", drawn::force, "motor"},
                                      {"joint_stiction", drawn::force, "friction"},
                                      {"joint_stiffness", drawn::force, "spring"},
                                      {"law_follower", drawn::force, "other"},
                                      {"implicit_follower", drawn::force, "other"},
                                      {"law_signal", drawn::force, "other"},
                                      {"law_spring", drawn::force, "spring"},
                                      {"line_point_mindist", drawn::link, ""},
                                      {"planar_joint", drawn::joint, "planar"},
                                      {"plane_point_mindist", drawn::link, ""},
                                      {"point_on_line", drawn::force, "loop"},
                                      {"point_on_plane", drawn::force, "loop"},
                                      {"position_control", drawn::link, ""},
                                      {"prismatic_joint", drawn::joint, "prismatic"},
                                      {"pull", drawn::pull, ""},
                                      {"revolute_joint", drawn::joint, "revolute"},
                                      {"rigid_link", drawn::link, ""},
                                      {"rotation_control", drawn::link, ""},
                                      {"rotor", drawn::force, "motor"},
                                      {"screw_joint", drawn::joint, "screw"},
                                      {"variable_pitch_screw_joint", drawn::joint, "screw"},
                                      {"slider_crank_rod", drawn::force, "loop"},
                                      {"slider_crank_slider", drawn::force, "loop"},
                                      {"sliding", drawn::force, "loop"},
                                      {"sphere_contact", drawn::force, "contact"},
                                      {"spherical_joint", drawn::joint, "spherical"},
                                      {"spring", drawn::force, "spring"},
                                      {"sticking_prismatic_joint", drawn::joint, "prismatic"},
                                      {"sticking_revolute_joint", drawn::joint, "revolute"},
                                      {"table_spring", drawn::force, "spring"},
                                      {"torque_speed_motor", drawn::force, "motor"},
                                      {"torsion_damper", drawn::force, "damper"},
                                      {"torsion_spring", drawn::force, "torsion_spring"},
                                      {"universal", drawn::force, "loop"},
                                      {"velocity_control", drawn::link, ""},
                                      {"virtual_kte_interface", drawn::link, ""},
                                      {"vmc_revolute_joint", drawn::joint, "revolute"}};

struct shape {
  std::string_view type;
  drawn as;
};
template <class Core>
constexpr drawn drawn_by_shape = detail::is_transmission<Core>&& detail::coordinates_of<Core> > 0 ? drawn::joint
                                 : Core::ports.back().how == access::base                         ? drawn::base
                                                                                                  : drawn::force;
/// The shapes of all elements of the library; used if an element is not listed above.
template <class... Core>
std::array<shape, sizeof...(Core)> shapes_of(detail::core_list<void, Core...>) {
  return {{{Core::type, drawn_by_shape<Core>}...}};
}
drawn drawn_in_library(std::string_view type) {
  static const auto all = shapes_of(detail::all_cores{});
  const auto found = std::find_if(all.begin(), all.end(), [&](const shape& s) { return s.type == type; });
  return found == all.end() ? drawn::unknown : found->as;
}
}  // namespace

element_kind kind_of_element(std::string_view type) {
  auto stem = type;
  for (const std::string_view suffix : {"_gen", "_2D", "_3D"})
    if (stem.ends_with(suffix)) {
      stem.remove_suffix(suffix.size());
      break;
    }
  const auto found = std::lower_bound(std::begin(listed_kinds), std::end(listed_kinds), stem,
                                      [](const element_kind& k, std::string_view s) { return k.stem < s; });
  if (found != std::end(listed_kinds) && found->stem == stem) return *found;
  return {stem, drawn_in_library(type), "other"};
}

}  // namespace kte::view
