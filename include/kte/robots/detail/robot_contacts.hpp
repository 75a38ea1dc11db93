#pragma once

#include <kte/dynamics/configuration_space.hpp>
#include <kte/robots/detail/contact_maker.hpp>
#include <kte/robots/detail/contact_rules.hpp>
#include <kte/robots/detail/robot_feet.hpp>
#include <kte/robots/robot.hpp>
#include <kte/runtime_chain/layout.hpp>

namespace kte::detail {

/// Appends the contacts of the collision shapes of a robot with the ground (robot_options::contacts).
class robot_contacts {
 public:
  robot_contacts(robot_elements& to, robot& out, const robot_description& d, const robot_options& o,
                 const robot_tree& tree)
      : to_(to),
        out_(out),
        d_(d),
        o_(o),
        groups_(d, tree),
        maker_(to, o.contacts),
        ground_(to, d, o, tree, groups_),
        rules_(d, o.contacts),
        stand_(to.chain().make_state()),
        touched_(groups_.count(), false),
        meshes_(groups_.count()) {
    to.chain().doMotion(stand_);
  }

  void append() {
    for (std::size_t i = 0; i < d_.links.size(); ++i) {
      if (groups_.of(i) == ground_.group()) continue;
      const auto& l = d_.links[i];
      for (const auto& s : l.collisions) shape(l, s, groups_.of(i));
      for (const auto& s : l.visuals)  // shapes that touch in pairs only
        if (ground_.in_pair(s.name) && !has(l.collisions, s.name)) shape(l, s, groups_.of(i));
    }
    for (std::size_t k = 0; k < groups_.count(); ++k)
      if (!meshes_[k].empty()) feet(k);
    std::size_t bodies = 0;
    for (std::size_t k = 0; k < groups_.count(); ++k) bodies += touched_[k] || !meshes_[k].empty();
    if (bodies > 1) out_.not_read.push_back({0, "contacts between bodies of the robot are not modelled"});
    notes_.finish(out_.warnings);
    rules_.note_unused(out_.warnings);
    if (count_ == 0)
      out_.warnings.push_back({0, "the robot has no contacts: no shape that moves can touch the ground"});
    add_standing();
  }

 private:
  using form = robot_shape::form;
  static constexpr double nowhere = std::numeric_limits<double>::infinity();

  static bool has(const std::vector<robot_shape>& all, const std::string& name) {
    return std::any_of(all.begin(), all.end(), [&](const auto& s) { return s.name == name; });
  }
  /// The contacts of a shape with all surfaces that it touches.
  void shape(const robot_link& l, const robot_shape& s, std::size_t group) {
    std::vector<std::pair<const ground_surface*, contact_law>> on;
    for (const auto& g : ground_.surfaces())
      if (const auto law = rules_.law(g, l, s)) on.emplace_back(&g, *law);
    if (on.empty()) return;
    if (s.is == form::mesh) return meshes_[group].push_back({&l, &s, poses_of(*on[0].first, l.name)});
    const int rim_points = o_.contacts.rim_points;
    if (touching_parts(s, rim_points).empty())
      return notes_.add(s.is == form::ellipsoid ? "ellipsoids are not supported"
                        : s.is == form::none    ? "shapes of unknown form are not supported"
                                                : "planes and height fields that move are not supported",
                        l, s);
    for (const auto& [g, law] : on) {
      const bool as_points = s.is == form::cylinder && !g->is_plane() && rim_points == 0;
      if (as_points) notes_.add("the rims of cylinders touch height fields by 8 points each", l, s);
      add(*g, l, s, touching_parts(s, as_points ? 8 : rim_points), law);
    }
    touched_[group] = true;
  }
  void add(const ground_surface& g, const robot_link& l, const robot_shape& s, const std::vector<touching_part>& parts,
           const contact_law& law) {
    const auto own = s.name.empty() ? l.name : s.name;
    const auto& on = g.name.empty() ? g.frame : g.name;
    const auto name = maker_.name_for(ground_.surfaces().size() > 1 ? own + "/" + on : own);
    for (const auto& p : parts) {
      const auto made = maker_.add(g, name, l.name, p, law);
      if (!o_.contacts.are_compliant()) out_.contacts.push_back(made);
      if (g.is_plane()) lowest_ = (std::min)(lowest_, gap(g, poses_of(g, l.name), p));
    }
    count_ += parts.size();
  }
  /// Contacts of the meshes of links that are fixed to each other.
  void feet(std::size_t group) {
    const auto& meshes = meshes_[group];
    if (touched_[group] || groups_.carries(group)) {
      for (const auto& m : meshes) notes_.add("meshes are not supported, except for feet", *m.link, *m.shape);
      return;
    }
    const auto& g = ground_.surfaces()[0];
    const auto foot = robot_feet(d_, o_, notes_).find(meshes, g.normal);
    if (foot.link == nullptr) return;
    if (const auto law = rules_.law(g, *foot.link, *foot.shape)) add(g, *foot.link, *foot.shape, foot.parts, *law);
  }

  /// The pose of a link in the frame of a surface in the neutral configuration.
  robot_pose poses_of(const ground_surface& g, const std::string& link) const {
    const auto &a = stand_.frame_3D(g.frame), &b = stand_.frame_3D(link);
    return inverse_of({a.position, a.rotation}) * robot_pose{b.position, b.rotation};
  }
  /// The gap of a part of a link at a pose to a plane.
  static double gap(const ground_surface& g, const robot_pose& link, const touching_part& p) {
    double reach = p.radius;
    if (p.axis) {
      const vec3<> a = as<double>(link.rotation * *p.axis), across = g.normal - dot(g.normal, a) * a;
      reach *= std::sqrt(dot(across, across));
    }
    return dot(g.normal, as<double>(link.position + link.rotation * p.at)) - reach;
  }
  /// Adds the neutral configuration with the floating base at the height where the robot touches the plane.
  void add_standing() {
    if (!o_.floating_base || o_.contacts.ground != o_.world || !(lowest_ < nowhere)) return;
    const auto q = neutral_configuration(to_.chain());
    auto& c = out_.configurations.emplace_back();
    c.name = "standing", c.q.assign(q.data(), q.data() + q.size());
    for (const auto& e : layout(to_.chain()))
      if (e.name == o_.base_coordinate) c.q[static_cast<std::size_t>(e.q) + 2] = 0.0 - lowest_;
  }

  robot_elements& to_;
  robot& out_;
  const robot_description& d_;
  const robot_options& o_;
  link_groups groups_;
  contact_maker maker_;
  robot_ground ground_;
  contact_rules rules_;
  runtime_state stand_;                             ///< in the neutral configuration
  std::vector<bool> touched_;                       ///< by group
  std::vector<std::vector<standing_mesh>> meshes_;  ///< by group
  contact_notes notes_;
  std::size_t count_ = 0;
  double lowest_ = nowhere;
};

}  // namespace kte::detail
