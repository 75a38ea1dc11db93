#pragma once

#include <kte/detail/interruption.hpp>
#include <kte/robots/detail/physical.hpp>
#include <kte/robots/detail/robot_contacts.hpp>
#include <kte/robots/detail/robot_forces.hpp>
#include <kte/robots/detail/robot_loops.hpp>
#include <kte/robots/detail/robot_results.hpp>

namespace kte::detail {

/// Makes the chain of a robot, joint by joint.
class chain_builder {
 public:
  chain_builder(const robot_description& d, const robot_options& o)
      : d_(d), o_(o), tree_(d, o.root), bodies_(d.links.size()), to_(d), forces_(to_, out_.warnings, d, o) {}

  robot build() {
    out_.name = d_.name, out_.actuators = d_.actuators;
    out_.file = d_.source, out_.search_path = o_.search_path;
    out_.not_read = d_.not_read, out_.warnings = d_.warnings;
    gather_bodies();
    to_.chain().gravity(gravity());
    append_base();
    append_body(tree_.root());
    for (const auto& s : tree_.steps()) append_joint(s);
    forces_.append_spring_dampers();
    append_frames();
    append_closures();
    if (o_.contacts.requested()) robot_contacts(to_, out_, d_, o_, tree_).append();
    out_.chain = std::move(to_.chain());
    list_joints(out_, d_), list_shapes(out_, d_);
    read_limits(out_, d_, tree_), read_configurations(out_, d_);
    judge(out_, d_, o_.strict);
    return std::move(out_);
  }

 private:
  using kind = robot_joint::kind;
  const robot_joint& joint(const robot_tree::step& s) const { return d_.joints[s.joint]; }

  vec3<> gravity() const { return o_.gravity ? *o_.gravity : d_.gravity ? *d_.gravity : vec3<>{0, 0, -9.81}; }

  void append_base() {
    const auto& root = d_.links[tree_.root()].name;
    if (!o_.floating_base) return to_.append(base_3D(root));
    for (const auto* name : {&o_.world, &o_.base_coordinate})
      if (to_.has(*name))
        raise<bad_argument>("kte: the robot '" + d_.name + "' has a link or joint '" + *name +
                            "': robot_options::world and base_coordinate of a floating base need other names");
    to_.append(free_joint_3D(o_.base_coordinate, o_.world, root));
  }

  /// Collects the bodies of links; on request those of fixed links are merged into their parents' bodies.
  void gather_bodies() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) bodies_[i] = d_.links[i].inertial;
    if (!o_.fold_fixed) return;
    for (auto s = tree_.steps().rbegin(); s != tree_.steps().rend(); ++s) {
      const auto& j = joint(*s);
      const std::size_t from = tree_.base(*s), to = tree_.end(*s);
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
      out_.warnings.push_back({l.line, "link '" + l.name + "': " + why + "; it is taken as published", l.file});
    }
    to_.append(inertia_3D(l.name, b));
  }
  /// Appends a force at the centre of mass that compensates a part of the weight.
  void append_compensation(const robot_link& l) {
    if (l.gravity_compensation == 0 || !l.inertial || l.inertial->mass == 0) return;
    const auto centre = l.inertial->com == vec3<>{} ? l.name : to_.fresh(l.name + ".com");
    if (centre != l.name) to_.append_link(l.name, centre, {l.inertial->com, robot_pose{}.rotation});
    to_.append(constant_force_3D(centre, (0.0 - l.gravity_compensation * l.inertial->mass) * gravity(), vec3<>{}));
  }

  /// The pose of the child of a fixed joint in its parent.
  robot_pose place_of(const robot_tree::step& s) const {
    const auto& j = joint(s);
    const auto place = j.origin * j.child_pose;
    return s.reversed ? inverse_of(place) : place;
  }

  /// X_child = origin J(q) child_pose; reversed, X_parent = child_pose^-1 J(q)^-1 origin^-1, where J^-1 is J about the
  /// opposite axis.
  void append_joint(const robot_tree::step& s) {
    look_for_interruption();
    const auto& j = joint(s);
    const auto& from = s.reversed ? j.child : j.parent;
    const auto& to = s.reversed ? j.parent : j.child;
    if (j.is == kind::fixed) {
      to_.append_link(from, to, place_of(s));
    } else {
      if (s.reversed && !has_one_coordinate(j))
        raise<bad_argument>("kte: " + place_text(d_.source, j.line) + "joint '" + j.name +
                            "' has no single coordinate and cannot be turned round: choose a root above it");
      auto placement = s.reversed ? inverse_of(j.child_pose) : j.origin;
      auto rest = s.reversed ? inverse_of(j.origin) : j.child_pose;
      const vec3<> axis = s.reversed ? vec3<>{0.0 - j.axis.x, 0.0 - j.axis.y, 0.0 - j.axis.z} : j.axis;
      if (j.is == kind::planar) {
        const robot_pose plane{{}, turn_of_z_to(axis)};
        placement = placement * plane, rest = inverse_of(plane) * rest;
      }
      const auto end = is_nothing(rest) ? to : to_.fresh(to + ".joint");
      if (j.mimic) append_mimic(j);
      append_moving(j, from, end, placement, axis);
      if (end != to) to_.append_link(end, to, rest);
      forces_.append(j, from, end, placement);
    }
    append_body(tree_.end(s));
    append_compensation(d_.links[tree_.end(s)]);
  }
  void append_frames() {
    std::unordered_set<std::string> frames;
    for (const auto& f : d_.frames) {
      const auto refuse = [&](const std::string& why) {
        raise<bad_file>("kte: " + place_text(d_.source, f.line) + "frame '" + f.name + "': " + why);
      };
      if (!tree_.has_link(f.link)) refuse("there is no link '" + f.link + "' for it to stand in");
      if (f.name.empty() || tree_.has_link(f.name) || !frames.insert(f.name).second)
        refuse("another frame or a link has its name");
      to_.append_link(f.link, f.name, f.origin);
    }
  }

  void append_closures() {
    robot_loops loops(to_, d_, tree_);
    for (const auto& c : d_.closures)
      if (o_.closures)
        out_.loops.push_back(loops.append(c));
      else
        out_.warnings.push_back(
            {c.line, "closure '" + c.name + "': its loop is open: robot_options::closures", c.file, true});
  }

  void append_moving(const robot_joint& j, const std::string& from, const std::string& to, const robot_pose& placement,
                     const vec3<>& n) {
    const auto placed = [&](const auto& e) { to_.append(e.at(placement.position, placement.rotation)); };
    if (j.is == kind::revolute) {
      if (n == as<double>(axis::x)) return placed(revolute_joint_3D(j.name, from, to, axis::x));
      if (n == as<double>(axis::y)) return placed(revolute_joint_3D(j.name, from, to, axis::y));
      if (n == as<double>(axis::z)) return placed(revolute_joint_3D(j.name, from, to, axis::z));
      return placed(revolute_joint_3D(j.name, from, to, n));
    }
    if (j.is == kind::prismatic) return placed(prismatic_joint_3D(j.name, from, to, n));
    if (j.is == kind::screw) return placed(screw_joint_3D(j.name, from, to, n, j.pitch));
    if (j.is == kind::spherical) return placed(spherical_joint_3D(j.name, from, to));
    if (j.is == kind::planar) return placed(planar_joint_3D(j.name, from, to));
    return placed(free_joint_3D(j.name, from, to));
  }
  /// Appends a follower, after the joints that it follows if these are followers themselves.
  void append_mimic(const robot_joint& j) {
    std::vector<const robot_joint*> following;
    for (const auto* k = &j; k->mimic && followers_.insert(k->name).second;
         k = &d_.joints[tree_.joint(k->mimic->joint)])
      following.push_back(k);
    for (auto k = following.rbegin(); k != following.rend(); ++k)
      to_.append(mimic_gen((*k)->mimic->joint, (*k)->name, (*k)->mimic->ratio, (*k)->mimic->offset));
  }

  const robot_description& d_;
  const robot_options& o_;
  robot_tree tree_;
  std::vector<std::optional<rigid_body<>>> bodies_;  ///< by link
  robot out_;
  robot_elements to_;
  robot_forces forces_;
  std::unordered_set<std::string> followers_;
};

}  // namespace kte::detail
