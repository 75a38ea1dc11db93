#pragma once

#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/looped/mass_matrix_inverse.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/robots/detail/robot_elements.hpp>
#include <kte/robots/detail/robot_tree.hpp>
#include <kte/robots/options.hpp>
#include <kte/runtime_chain.hpp>

#include <Eigen/Cholesky>

#include <algorithm>

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
  /// Appends the dampers and springs of joints with a time constant T and a damping ratio z: d = 2 I/T and k = I/(T
  /// z)^2, where 1/I is the diagonal entry of the joint in M^-1 at the configuration of the file. All bodies must be in
  /// the chain.
  void append_spring_dampers(const robot_tree& tree);

 private:
  void append_spring(const robot_joint& j, const robot_joint_dynamics& x);
  void append_of_ball(const robot_joint& j, const std::string& from, const std::string& end,
                      const robot_pose& placement);
  std::vector<double> inverse_masses(const Eigen::VectorXd& q);

  robot_elements& to_;
  std::vector<robot_note>& warnings_;
  const robot_description& d_;
  const robot_options& o_;
};

/// Damping alone is a `joint_damping_gen`, which is linear and cheaper than friction. Damping with dry friction is one
/// `joint_friction_gen`.
inline void robot_forces::append_spring(const robot_joint& j, const robot_joint_dynamics& x) {
  if (x.friction != 0)
    to_.append(joint_friction_gen(j.name, {x.damping, x.friction, 0, 1, o_.friction_smoothing}));
  else if (x.damping != 0)
    to_.append(joint_damping_gen(j.name, x.damping));
  if (x.stiffness != 0) to_.append(joint_stiffness_gen(j.name, x.stiffness, x.rest));
}

inline void robot_forces::append_spring_dampers(const robot_tree& tree) {
  const auto has = [](const robot_joint& j) { return has_one_coordinate(j) && j.dynamics.time_constant > 0; };
  if (!o_.joint_dynamics || std::none_of(d_.joints.begin(), d_.joints.end(), has)) return;
  auto q = neutral_configuration(to_.chain());
  const auto places = layout(to_.chain());
  for (const auto& e : places)
    if (e.what == kind::gen) q[e.q] = d_.joints[tree.joint(e.name)].reference;
  const auto inverse = inverse_masses(q);
  for (const auto& e : places) {
    if (e.what != kind::gen || !has(d_.joints[tree.joint(e.name)])) continue;
    const auto& j = d_.joints[tree.joint(e.name)];
    auto x = j.dynamics;
    const double inertia = 1 / inverse[static_cast<std::size_t>(e.v)], t = x.time_constant, tz = t * x.damping_ratio;
    x.damping = 2 * inertia / t, x.stiffness = inertia / (tz * tz);
    append_spring(j, x);
  }
}
/// The diagonal of M^-1: for a tree from articulated inertias, with followers from M.
inline std::vector<double> robot_forces::inverse_masses(const Eigen::VectorXd& q) {
  const auto& c = to_.chain();
  auto s = c.make_state();
  const auto refuse = [this] {
    raise<bad_file>("kte: " + place_text(d_.source, 0) + "the mass matrix of the robot '" + d_.name +
                    "' is singular, so that springdamper has no meaning");
  };
  if (s.tree().plan.tree) {
    try {
      return take(c, s, q).call([&] { return inverse_mass_diagonal(runtime_elements{c}, s); });
    } catch (const singular_mass_matrix&) {
      refuse();
    }
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(mass_matrix(c, s, q));
  if (factor.info() != Eigen::Success) refuse();
  const Eigen::MatrixXd inverse = factor.matrixL().solve(Eigen::MatrixXd::Identity(c.dofs(), c.dofs()));
  std::vector<double> diagonal(static_cast<std::size_t>(c.dofs()));
  for (int i = 0; i < c.dofs(); ++i) diagonal[static_cast<std::size_t>(i)] = inverse.col(i).squaredNorm();
  return diagonal;
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
  const auto name = [](double x, const char* what) { return x != 0 ? std::string(" ") + what : std::string(); };
  warnings_.push_back({j.line,
                       "joint '" + j.name +
                           "': left out, as it has several degrees of freedom:" + name(left.damping, "damping") +
                           name(left.friction, "friction") + name(left.stiffness, "stiffness") +
                           name(left.armature, "armature") + name(left.time_constant, "springdamper"),
                       j.file, true});
}

}  // namespace kte::detail
