#pragma once

#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/looped/mass_matrix_inverse.hpp>
#include <kte/robots/detail/robot_elements.hpp>
#include <kte/robots/to_robot.hpp>
#include <kte/runtime_chain.hpp>

#include <algorithm>
#include <unordered_map>

namespace kte::detail {

/// The forces and inertias of joints: springs, dampers, friction and inertias of rotors.
class robot_forces {
 public:
  robot_forces(robot_elements& to, std::vector<robot_note>& warnings, const robot_description& d,
               const robot_options& o)
      : to_(to), warnings_(warnings), d_(d), o_(o) {}

  /// Appends the forces of a joint between two frames; `placement` is in the first.
  void append(const robot_joint& j, const std::string& from, const std::string& end, const robot_pose& placement) {
    const auto& x = j.dynamics;
    if (x == robot_joint_dynamics{} || !o_.joint_dynamics) return;
    if (!has_one_coordinate(j)) return append_of_ball(j, from, end, placement);
    if (x.time_constant == 0) append_spring(j, x);
    if (x.armature != 0) to_.append(inertia_gen(j.name, x.armature));
  }
  /// Appends the dampers and springs of joints, of followers too, with a time constant T and a damping ratio z: d = 2
  /// I/T and k = I/(T z)^2, where 1/I is the diagonal entry of the joint in M^-1 at the configuration of the file, as
  /// if no joint followed another and loops were open (as in MuJoCo).
  void append_spring_dampers();

 private:
  void append_spring(const robot_joint& j, const robot_joint_dynamics& x);
  void append_of_ball(const robot_joint& j, const std::string& from, const std::string& end,
                      const robot_pose& placement);
  std::unordered_map<std::string, double> inverse_masses() const;

  robot_elements& to_;
  std::vector<robot_note>& warnings_;
  const robot_description& d_;
  const robot_options& o_;
};

/// Damping alone is a `joint_damping_gen`, which is linear and cheaper than friction. Damping with dry friction is one
/// `joint_friction_gen`. Cubic laws have their own elements.
inline void robot_forces::append_spring(const robot_joint& j, const robot_joint_dynamics& x) {
  const auto [d_2, d_3] = x.damping_powers;
  const auto [k_2, k_3] = x.stiffness_powers;
  const bool cubic = d_2 != 0 || d_3 != 0;
  if (cubic) to_.append(joint_cubic_damping_gen(j.name, {x.damping, d_2, d_3}));
  if (x.friction != 0)
    to_.append(joint_friction_gen(j.name, {cubic ? 0 : x.damping, x.friction, 0, 1, o_.friction_smoothing}));
  else if (x.damping != 0 && !cubic)
    to_.append(joint_damping_gen(j.name, x.damping));
  if (k_2 != 0 || k_3 != 0)
    to_.append(joint_cubic_stiffness_gen(j.name, {x.stiffness, k_2, k_3, x.rest}));
  else if (x.stiffness != 0)
    to_.append(joint_stiffness_gen(j.name, x.stiffness, x.rest));
}

inline void robot_forces::append_spring_dampers() {
  const auto has = [](const robot_joint& j) { return has_one_coordinate(j) && j.dynamics.time_constant > 0; };
  if (!o_.joint_dynamics || std::none_of(d_.joints.begin(), d_.joints.end(), has)) return;
  const auto inverse = inverse_masses();
  for (const auto& j : d_.joints) {
    if (!has(j)) continue;
    auto x = j.dynamics;
    const double inertia = 1 / inverse.at(j.name), t = x.time_constant, tz = t * x.damping_ratio;
    x.damping = 2 * inertia / t, x.stiffness = inertia / (tz * tz);
    append_spring(j, x);
  }
}
/// The diagonal of M^-1 by joints, at the configuration of the file, of the tree without followers and closures.
inline std::unordered_map<std::string, double> robot_forces::inverse_masses() const {
  robot_description bare = d_;
  bare.closures.clear(), bare.configurations.clear();
  for (auto& j : bare.joints) j.mimic.reset(), j.dynamics.time_constant = 0;
  auto options = o_;
  options.contacts = {}, options.strict = false;
  const auto c = to_robot(bare, options).chain;
  auto q = neutral_configuration(c);
  std::unordered_map<std::string, double> all;
  for (const auto& j : d_.joints) all[j.name] = j.reference;
  const auto places = layout(c);
  for (const auto& e : places)
    if (e.what == kind::gen) q[e.q] = all[e.name];
  auto s = c.make_state();
  try {
    const auto diagonal = take(c, s, q).call([&] { return inverse_mass_diagonal(runtime_elements{c}, s); });
    for (const auto& e : places)
      if (e.what == kind::gen) all[e.name] = diagonal[static_cast<std::size_t>(e.v)];
  } catch (const singular_mass_matrix&) {
    raise<bad_file>("kte: " + place_text(d_.source, 0) + "the mass matrix of the robot '" + d_.name +
                    "' is singular, so that springdamper has no meaning");
  }
  return all;
}

/// Damping d and stiffness k of a spherical or floating joint give the torque -d w - k r, with the angular velocity w
/// and the rotation vector r of the moving side in the placement; a floating body is also damped by the force -d v at
/// its origin.
inline void robot_forces::append_of_ball(const robot_joint& j, const std::string& from, const std::string& end,
                                         const robot_pose& placement) {
  auto left = j.dynamics;
  const bool ball = j.is == robot_joint::kind::spherical, free = j.is == robot_joint::kind::floating;
  if ((ball || free) && left.damping != 0) {
    to_.append(torsion_damper_3D(from, end, left.damping));
    if (free) to_.append(fluid_drag_3D(end, 0.0, left.damping, vec3<>{}));
    left.damping = 0;
  }
  if (ball && left.stiffness != 0) {
    to_.append(torsion_spring_3D(from, end, left.stiffness, 0.0, placement.rotation));
    left.stiffness = 0;
  }
  left.rest = 0;
  if (left == robot_joint_dynamics{}) return;
  const auto name = [](bool has, const char* what) { return has ? std::string(" ") + what : std::string(); };
  const robot_joint_dynamics::powers none{};
  warnings_.push_back({j.line,
                       "joint '" + j.name +
                           "': left out, as it has several degrees of freedom:" + name(left.damping != 0, "damping") +
                           name(left.damping_powers != none, "quadratic and cubic damping") +
                           name(left.friction != 0, "friction") + name(left.stiffness != 0, "stiffness") +
                           name(left.stiffness_powers != none, "quadratic and cubic stiffness") +
                           name(left.armature != 0, "armature") + name(left.time_constant != 0, "springdamper"),
                       j.file, true});
}

}  // namespace kte::detail
