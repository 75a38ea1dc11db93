#pragma once

#include <kte/elements/compiled_elements.hpp>
#include <kte/robots/detail/physical.hpp>
#include <kte/robots/detail/robot_tree.hpp>
#include <kte/robots/robot.hpp>

#include <unordered_set>

namespace kte::detail {

/// Makes the chain of a robot, joint by joint.
class chain_builder {
 public:
  chain_builder(const robot_description& d, const robot_options& o)
      : d_(d), o_(o), tree_(d, o.root), bodies_(d.links.size()) {}

  robot build() {
    out_.name = d_.name, out_.actuators = d_.actuators;
    out_.not_read = d_.not_read, out_.warnings = d_.warnings;
    for (const auto& l : d_.links) taken_.insert(l.name);
    for (const auto& j : d_.joints) taken_.insert(j.name);
    gather_bodies();
    out_.chain.gravity(o_.gravity ? *o_.gravity : d_.gravity ? *d_.gravity : vec3<>{0, 0, -9.81});
    append_base();
    append_body(tree_.root());
    for (const auto& s : tree_.steps()) append_joint(s);
    list_joints(), list_shapes(), read_limits();
    return std::move(out_);
  }

 private:
  using kind = robot_joint::kind;
  template <class E>
  [[gnu::cold, gnu::noinline]] void append(const E& e) {
    out_.chain << e;
  }
  const robot_joint& joint(const robot_tree::step& s) const { return d_.joints[s.joint]; }
  static bool has_number(const robot_joint& j) { return j.is == kind::revolute || j.is == kind::prismatic; }

  /// A name that is nobody's: of frames in between.
  std::string fresh(std::string name) {
    while (!taken_.insert(name).second) name += '\'';
    return name;
  }

  void append_base() {
    const auto& root = d_.links[tree_.root()].name;
    if (!o_.floating_base) return append(base_3D(root));
    for (const auto* name : {&o_.world, &o_.base_coordinate})
      if (taken_.contains(*name))
        raise<bad_argument>("kte: the robot '" + d_.name + "' has a link or joint '" + *name +
                            "': robot_options::world and base_coordinate of a floating base need other names");
    append(free_joint_3D(o_.base_coordinate, o_.world, root));
  }

  /// The bodies of links; of links fixed to others, on request, added to theirs.
  void gather_bodies() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) bodies_[i] = d_.links[i].inertial;
    if (!o_.fold_fixed) return;
    for (auto s = tree_.steps().rbegin(); s != tree_.steps().rend(); ++s) {
      const auto& j = joint(*s);
      const std::size_t from = tree_.link(s->reversed ? j.child : j.parent);
      const std::size_t to = tree_.link(s->reversed ? j.parent : j.child);
      if (j.is != kind::fixed || !bodies_[to]) continue;
      const auto moved = moved_body(place_of(*s), *bodies_[to]);
      bodies_[from] = bodies_[from] ? together(*bodies_[from], moved) : moved;
      bodies_[to].reset();
    }
  }
  void append_body(std::size_t i) {
    if (!bodies_[i]) return;
    auto b = *bodies_[i];
    if (b.mass == 0 && b.inertia == sym3<>{}) return;
    const auto& l = d_.links[i];
    if (const auto why = unphysical(b); !why.empty()) {
      b.published = true;
      out_.warnings.push_back({l.line, "link '" + l.name + "': " + why + "; it is taken as published"});
    }
    append(inertia_3D(l.name, b));
  }

  /// Of a joint that does not move: where what it carries stands in what carries it.
  robot_pose place_of(const robot_tree::step& s) const {
    const auto& j = joint(s);
    const auto place = j.origin * j.child_pose;
    return s.reversed ? inverse_of(place) : place;
  }
  void append_link(const std::string& from, const std::string& to, const robot_pose& place) {
    append(rigid_link_3D(from, to, place.position, place.rotation));
  }

  /// X_child = origin J(q) child_pose; turned round X_parent = child_pose^-1 J(q)^-1 origin^-1, where J^-1 is J about
  /// the opposite axis.
  void append_joint(const robot_tree::step& s) {
    const auto& j = joint(s);
    const auto& from = s.reversed ? j.child : j.parent;
    const auto& to = s.reversed ? j.parent : j.child;
    if (j.is == kind::fixed) {
      append_link(from, to, place_of(s));
    } else {
      if (s.reversed && !has_number(j))
        raise<bad_argument>("kte: " + place_text(d_.source, j.line) + "joint '" + j.name +
                            "' has no single coordinate and cannot be turned round: choose a root above it");
      auto seat = s.reversed ? inverse_of(j.child_pose) : j.origin;
      auto rest = s.reversed ? inverse_of(j.origin) : j.child_pose;
      const vec3<> axis = s.reversed ? vec3<>{0.0 - j.axis.x, 0.0 - j.axis.y, 0.0 - j.axis.z} : j.axis;
      if (j.is == kind::planar) {
        const robot_pose plane{{}, turn_of_z_to(axis)};
        seat = seat * plane, rest = inverse_of(plane) * rest;
      }
      const auto end = is_nothing(rest) ? to : fresh(to + ".joint");
      if (j.mimic) append_mimic(j);
      append_moving(j, from, end, seat, axis);
      if (end != to) append_link(end, to, rest);
    }
    append_body(tree_.link(to));
    if (j.is != kind::fixed) append_dynamics(j);
  }

  void append_moving(const robot_joint& j, const std::string& from, const std::string& to, const robot_pose& seat,
                     const vec3<>& n) {
    const auto placed = [&](const auto& e) { append(e.at(seat.position, seat.rotation)); };
    if (j.is == kind::revolute) {
      if (n == as<double>(axis::x)) return placed(revolute_joint_3D(j.name, from, to, axis::x));
      if (n == as<double>(axis::y)) return placed(revolute_joint_3D(j.name, from, to, axis::y));
      if (n == as<double>(axis::z)) return placed(revolute_joint_3D(j.name, from, to, axis::z));
      return placed(revolute_joint_3D(j.name, from, to, n));
    }
    if (j.is == kind::prismatic) return placed(prismatic_joint_3D(j.name, from, to, n));
    if (j.is == kind::spherical) return placed(spherical_joint_3D(j.name, from, to));
    if (j.is == kind::planar) return placed(planar_joint_3D(j.name, from, to));
    return placed(free_joint_3D(j.name, from, to));
  }
  /// A coordinate that follows must be written before it is read.
  void append_mimic(const robot_joint& j) {
    std::vector<const robot_joint*> following;
    for (const auto* k = &j; k->mimic && followers_.insert(k->name).second;
         k = &d_.joints[tree_.joint(k->mimic->joint)])
      following.push_back(k);
    for (auto k = following.rbegin(); k != following.rend(); ++k)
      append(mimic_gen((*k)->mimic->joint, (*k)->name, (*k)->mimic->ratio, (*k)->mimic->offset));
  }
  void append_dynamics(const robot_joint& j);

  void list_joints() {
    for (const auto& j : d_.joints)
      if (j.is != kind::fixed) out_.joints.push_back(j.name);
  }
  void list_shapes() {
    for (const auto& l : d_.links) {
      for (const auto& v : l.visuals) out_.shapes.push_back({v, l.name, false});
      for (const auto& c : l.collisions) out_.shapes.push_back({c, l.name, true});
    }
  }
  void read_limits() {
    auto& hard = out_.limits;
    hard = unlimited(out_.chain);
    auto soft = hard;
    for (const auto& e : layout(out_.chain)) {
      if (e.what != kte::kind::gen) continue;
      const auto& j = d_.joints[tree_.joint(e.name)];
      const auto i = static_cast<std::size_t>(e.v);
      hard.lower[i] = j.lower, hard.upper[i] = j.upper, hard.rate[i] = j.rate, hard.effort[i] = j.effort;
      soft.lower[i] = std::max(j.lower, j.soft_lower), soft.upper[i] = std::min(j.upper, j.soft_upper);
    }
    out_.soft_limits = hard;
    out_.soft_limits.lower = soft.lower, out_.soft_limits.upper = soft.upper;
  }

  const robot_description& d_;
  const robot_options& o_;
  robot_tree tree_;
  std::vector<std::optional<rigid_body<>>> bodies_;  ///< by links
  robot out_;
  std::unordered_set<std::string> taken_, followers_;
  std::string rest_;  ///< a coordinate at rest, from which springs and dampers act
};

/// Damping by itself is a `damper_gen` from a coordinate at rest: linear, and cheaper than friction. With dry friction
/// both are one `joint_friction_gen`.
inline void chain_builder::append_dynamics(const robot_joint& j) {
  const auto& x = j.dynamics;
  const bool any = x.damping != 0 || x.friction != 0 || x.stiffness != 0 || x.armature != 0;
  if (!any || !o_.joint_dynamics) return;
  if (!has_number(j)) {
    out_.not_read.push_back({j.line, "joint '" + j.name +
                                         "': damping, friction, springs and rotors are only those of " +
                                         "joints of one coordinate"});
    return;
  }
  if (rest_.empty() && (x.stiffness != 0 || (x.damping != 0 && x.friction == 0))) {
    rest_ = fresh("rest");
    append(base_gen(rest_));
  }
  if (x.friction != 0)
    append(joint_friction_gen(j.name, {x.damping, x.friction, 0, 1, o_.friction_smoothing}));
  else if (x.damping != 0)
    append(damper_gen(rest_, j.name, x.damping));
  if (x.stiffness != 0) append(spring_gen(rest_, j.name, x.rest, x.stiffness));
  if (x.armature != 0) append(inertia_gen(j.name, x.armature));
}

}  // namespace kte::detail
