#pragma once

#include <kte/dynamics/runtime.hpp>
#include <kte/elements/compiled_elements.hpp>
#include <kte/robots/detail/no_limit.hpp>
#include <kte/robots/detail/physical.hpp>
#include <kte/robots/detail/robot_tree.hpp>
#include <kte/robots/robot.hpp>

#include <Eigen/Cholesky>

#include <algorithm>
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
    for (const auto& x : d_.frames) taken_.insert(x.name);
    gather_bodies();
    out_.chain.gravity(gravity());
    append_base();
    append_body(tree_.root());
    for (const auto& s : tree_.steps()) append_joint(s);
    append_spring_dampers();
    append_frames();
    list_joints(), list_shapes(), read_limits(), read_configurations();
    judge();
    return std::move(out_);
  }

 private:
  using kind = robot_joint::kind;
  template <class E>
  [[gnu::cold, gnu::noinline]] void append(const E& e) {
    out_.chain << e;
  }
  const robot_joint& joint(const robot_tree::step& s) const { return d_.joints[s.joint]; }
  static bool has_number(const robot_joint& j) { return has_one_coordinate(j); }

  vec3<> gravity() const { return o_.gravity ? *o_.gravity : d_.gravity ? *d_.gravity : vec3<>{0, 0, -9.81}; }

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
      out_.warnings.push_back({l.line, "link '" + l.name + "': " + why + "; it is taken as published", l.file});
    }
    append(inertia_3D(l.name, b));
  }
  /// A force at the centre of mass, against a part of the weight.
  void append_compensation(const robot_link& l) {
    if (l.gravity_compensation == 0 || !l.inertial || l.inertial->mass == 0) return;
    const auto centre = l.inertial->com == vec3<>{} ? l.name : fresh(l.name + ".com");
    if (centre != l.name) append_link(l.name, centre, {l.inertial->com, robot_pose{}.rotation});
    append(constant_force_3D(centre, (0.0 - l.gravity_compensation * l.inertial->mass) * gravity(), vec3<>{}));
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
      append_dynamics(j, from, end, seat);
    }
    append_body(tree_.link(to));
    append_compensation(d_.links[tree_.link(to)]);
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
      append_link(f.link, f.name, f.origin);
    }
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
    if (j.is == kind::screw) return placed(screw_joint_3D(j.name, from, to, n, j.pitch));
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
  void append_dynamics(const robot_joint& j, const std::string& from, const std::string& to, const robot_pose& seat);
  void append_spring(const robot_joint& j, const robot_joint_dynamics& x);
  void append_spring_dampers();
  void append_dynamics_of_ball(const robot_joint& j, const std::string& from, const std::string& to,
                               const robot_pose& seat);

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
      hard.lower[i] = limit_from_file(j.lower), hard.upper[i] = limit_from_file(j.upper);
      hard.rate[i] = limit_from_file(j.rate), hard.effort[i] = limit_from_file(j.effort);
      soft.lower[i] = (std::max)(hard.lower[i], limit_from_file(j.soft_lower));
      soft.upper[i] = (std::min)(hard.upper[i], limit_from_file(j.soft_upper));
    }
    out_.soft_limits = hard;
    out_.soft_limits.lower = soft.lower, out_.soft_limits.upper = soft.upper;
  }
  void read_configurations() {
    if (d_.configurations.empty()) return;
    std::unordered_map<std::string, layout_entry<std::string>> places;
    for (const auto& e : layout(out_.chain)) places.emplace(e.name, e);
    for (const auto& c : d_.configurations) {
      auto& made = out_.configurations.emplace_back();
      const auto q = neutral_configuration(out_.chain);
      made.name = c.name, made.q.assign(q.data(), q.data() + q.size());
      for (const auto& [joint, numbers] : c.joints) {
        const auto e = places.find(joint);
        if (e == places.end()) continue;  // it follows another, or is fixed
        if (static_cast<int>(numbers.size()) != e->second.nq)
          raise<bad_file>("kte: " + place_text(d_.source, c.line) + "configuration '" + c.name + "': joint '" + joint +
                          "' has " + std::to_string(e->second.nq) + " numbers, got " + std::to_string(numbers.size()));
        std::copy(numbers.begin(), numbers.end(), made.q.begin() + e->second.q);
      }
    }
  }
  /// Warnings of what moves differently come first, or are refused.
  void judge() {
    auto& all = out_.warnings;
    const auto differs = [](const robot_note& n) { return n.changes_motion; };
    const auto end = std::stable_partition(all.begin(), all.end(), differs);
    if (!o_.strict || end == all.begin()) return;
    std::string why;
    for (auto n = all.begin(); n != end; ++n)
      why += "\n  " + place_text(n->file.empty() ? d_.source : n->file, n->line) + n->text;
    raise<bad_file>("kte: the robot '" + d_.name + "' would move differently from that of its file:" + why);
  }

  const robot_description& d_;
  const robot_options& o_;
  robot_tree tree_;
  std::vector<std::optional<rigid_body<>>> bodies_;  ///< by links
  robot out_;
  std::unordered_set<std::string> taken_, followers_;
};

/// Damping by itself is a `joint_damping_gen`: linear, and cheaper than friction. With dry friction both are one
/// `joint_friction_gen`.
inline void chain_builder::append_dynamics(const robot_joint& j, const std::string& from, const std::string& to,
                                           const robot_pose& seat) {
  const auto& x = j.dynamics;
  if (x == robot_joint_dynamics{} || !o_.joint_dynamics) return;
  if (!has_number(j)) return append_dynamics_of_ball(j, from, to, seat);
  if (x.time_constant == 0) append_spring(j, x);
  if (x.armature != 0) append(inertia_gen(j.name, x.armature));
}
inline void chain_builder::append_spring(const robot_joint& j, const robot_joint_dynamics& x) {
  if (x.friction != 0)
    append(joint_friction_gen(j.name, {x.damping, x.friction, 0, 1, o_.friction_smoothing}));
  else if (x.damping != 0)
    append(joint_damping_gen(j.name, x.damping));
  if (x.stiffness != 0) append(joint_stiffness_gen(j.name, x.stiffness, x.rest));
}
/// Of joints with a time constant T and a damping ratio z, d = 2 I/T and k = I/(T z)^2, where 1/I is the joint's entry
/// on the diagonal of M^-1 with the robot as it is written.
inline void chain_builder::append_spring_dampers() {
  const auto has = [](const robot_joint& j) { return has_number(j) && j.dynamics.time_constant > 0; };
  if (!o_.joint_dynamics || std::none_of(d_.joints.begin(), d_.joints.end(), has)) return;
  auto q = neutral_configuration(out_.chain);
  const auto places = layout(out_.chain);
  for (const auto& e : places)
    if (e.what == kte::kind::gen) q[e.q] = d_.joints[tree_.joint(e.name)].reference;
  auto s = out_.chain.make_state();
  const Eigen::LLT<Eigen::MatrixXd> factor(mass_matrix(out_.chain, s, q));
  if (factor.info() != Eigen::Success)
    raise<bad_file>("kte: " + place_text(d_.source, 0) + "the mass matrix of the robot '" + d_.name +
                    "' is singular, so that springdamper has no meaning");
  for (const auto& e : places) {
    if (e.what != kte::kind::gen || !has(d_.joints[tree_.joint(e.name)])) continue;
    const auto& j = d_.joints[tree_.joint(e.name)];
    auto x = j.dynamics;
    const double inertia = 1 / factor.solve(Eigen::VectorXd::Unit(out_.chain.dofs(), e.v))[e.v], t = x.time_constant,
                 tz = t * x.damping_ratio;
    x.damping = 2 * inertia / t, x.stiffness = inertia / (tz * tz);
    append_spring(j, x);
  }
}

/// Damping d and stiffness k of what turns freely are a torque, -d w - k r, with the velocity w and the rotation vector
/// r of what the joint moves in its seat; a free body is also damped by the force -d v at its origin.
inline void chain_builder::append_dynamics_of_ball(const robot_joint& j, const std::string& from, const std::string& to,
                                                   const robot_pose& seat) {
  auto left = j.dynamics;
  const bool ball = j.is == kind::spherical, free = j.is == kind::floating;
  if ((ball || free) && left.damping != 0) {
    append(torsion_damper_3D(from, to, left.damping));
    if (free) append(fluid_drag_3D(to, 0.0, left.damping, vec3<>{}));
    left.damping = 0;
  }
  if (ball && left.stiffness != 0) {
    append(torsion_spring_3D(from, to, left.stiffness, 0.0, seat.rotation));
    left.stiffness = 0;
  }
  left.rest = 0;
  if (left == robot_joint_dynamics{}) return;
  const auto name = [](double x, const char* what) { return x != 0 ? std::string(" ") + what : std::string(); };
  out_.warnings.push_back({j.line,
                           "joint '" + j.name +
                               "': left out, as it has several degrees of freedom:" + name(left.damping, "damping") +
                               name(left.friction, "friction") + name(left.stiffness, "stiffness") +
                               name(left.armature, "armature") + name(left.time_constant, "springdamper"),
                           j.file, true});
}

}  // namespace kte::detail
