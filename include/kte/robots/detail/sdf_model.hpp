#pragma once

#include <kte/robots/detail/sdf_joint.hpp>
#include <kte/robots/detail/sdf_link.hpp>
#include <kte/robots/detail/sdf_tree.hpp>

namespace kte::detail {

/// Reads a model in SDF, including nested models, as links and joints.
class sdf_model {
 public:
  sdf_model(robot_description& d, const robot_options& o)
      : d_(d), options_(o), links_(o, frames_, leftovers_), joints_(d, frames_) {}

  void read(const xml_item& m, bool windy) {
    d_.name = m.text_or("name", ""), windy_ = windy;
    stand(m);
    gather(m, {}, child_flag(m, "static", false));
    for (const auto& p : placed_) place_model(p);
    d_.links.reserve(parts_.size() + 1), d_.joints.reserve(moving_.size());
    for (const auto& p : parts_) d_.links.push_back(links_.read(p.x, p.scope, p.name, p.still, windy_));
    add_world(m);
    for (const auto& p : moving_) joints_.read(p.x, p.scope, p.name, p.frame);
    joints_.couple_gearboxes();
    free_followers(d_);
    sdf_tree tree(d_, [&](const std::string& a, const std::string& b) { return frames_.relative(m, a, b); });
    tree.fix(still_);
    turn_gravity(m, tree.join(frames_.canonical().empty() ? std::string() : frames_.link_of(m, frames_.canonical())));
    list_frames();
    leftovers_.warn();
  }

 private:
  struct part {
    xml_item x;
    sdf_scope scope;
    std::string name, frame{};  ///< full names; `frame`: for a joint the name of its frame
    bool still = false;
  };

  /// Places the world by the pose of the model, or of a frame in it, in the world.
  void stand(const xml_item& m) {
    if (const auto to = relative_to(m); !to.empty() && to != "world")
      m.moves_differently("its pose is relative to '" + excerpt(to) + "', and taken in the world");
    const auto from = sdf_scope{}.full(m.text_or("placement_frame", "__model__"));
    frames_.add(true_world, {from, inverse_of(sdf_pose(m, options_)), "", m});
    for (const auto& l : m.children("link"))
      if (l.text("name") == "world")
        return l.warn("it has the name that SDF keeps for the world: joints to the world are joints to it");
    frames_.add("world", {true_world, {}, "", m});
  }

  void gather(const xml_item& m, const sdf_scope& scope, bool still) {
    m.only({"link", "joint", "frame", "model", "pose", "static", "plugin", "gripper", "enable_wind",
            "drake:ball_constraint", "drake:linear_bushing_rpy", "drake:linear_spring_damper", "drake:joint"},
           {"name", "canonical_link", "placement_frame", "kte:merge"});
    if (still) m.not_read("it is static: its links stand still, and its joints do not move");
    for (const auto& x : m.children("link")) {
      const auto& p = parts_.emplace_back(part{x, scope, scope.full(x.text("name")), {}, still});
      frames_.add(p.name, {frame_for(scope, relative_to(x), scope.model), sdf_pose(x, options_), "", x});
      if (still) still_.insert(p.name);
    }
    for (const auto& x : m.children("model")) nest(x, scope, still);
    for (const auto& x : m.children("frame")) {
      const auto to = frame_for(scope, x.text_or("attached_to", ""), scope.model);
      const auto& p = named_.emplace_back(part{x, scope, scope.full(x.text("name"))});
      frames_.add(p.name, {frame_for(scope, relative_to(x), to), sdf_pose(x, options_), to, x});
    }
    for (const auto& x : m.children("joint")) {
      const auto child = frame_for(scope, child_text(x, "child"), scope.model), name = scope.full(x.text("name"));
      // in older files a link may have the name of a joint; the name then means the link
      const auto& p = moving_.emplace_back(part{x, scope, name, frames_.has(name) ? name + " (joint)" : name});
      frames_.add(p.frame, {frame_for(scope, relative_to(x), child), sdf_pose(x, options_), child, x});
    }
    attach(m, scope);
    leave_out(m);
  }
  void nest(const xml_item& x, const sdf_scope& outer, bool still) {
    const auto name = x.text("name"), full = outer.prefix + name;
    const bool merged = x.has("kte:merge");
    const sdf_scope scope{merged ? outer.prefix : full + "::", merged ? full + " (merged)" : full};
    frames_.add(scope.model, {frame_for(outer, relative_to(x), outer.model), sdf_pose(x, options_), scope.model, x});
    gather(x, scope, still || child_flag(x, "static", false));
    if (x.has("placement_frame"))
      placed_.push_back({x, scope, scope.model, frame_for(scope, x.text("placement_frame"), scope.model)});
  }
  /// Places the model so that one of its frames is at the written pose.
  void place_model(const part& p) {
    const auto inside = frames_.inside(p.x, p.name, p.frame);
    frames_.place(p.name, sdf_pose(p.x, options_) * inverse_of(inside));
  }
  /// Attaches a model to its canonical link: that of its attribute, otherwise its first link, otherwise that of its
  /// first nested model.
  void attach(const xml_item& m, const sdf_scope& scope) {
    std::string to;
    if (m.has("canonical_link") && !m.text_or("canonical_link", "").empty())
      to = frames_.find(m, scope, m.text("canonical_link"));
    else if (const auto link = m.children("link").first())
      to = scope.full(link->text("name"));
    else if (const auto model = m.children("model").first())
      to = scope.full(model->text("name")) + (model->has("kte:merge") ? " (merged)" : "");
    if (scope.model == "__model__")
      frames_.set_canonical(to);
    else if (!to.empty())
      frames_.attach(scope.model, to);
  }
  std::string frame_for(const sdf_scope& scope, const std::string& name, const std::string& usual) const {
    if (name.empty()) return usual;
    auto full = scope.full(name);
    return name == "world" && !frames_.has(full) ? name : full;
  }
  void leave_out(const xml_item& m) {
    for (const auto& p : m.children("plugin")) leftovers_.plugin(p);
    for (const auto& w : m.children("enable_wind"))
      if (windy_ && child_flag(m, "enable_wind", false))
        w.moves_differently("the wind is not modelled");
      else
        w.not_read("not read");
    for (const auto* of :
         {"gripper", "drake:ball_constraint", "drake:linear_bushing_rpy", "drake:linear_spring_damper", "drake:joint"})
      for (const auto& x : m.children(of)) x.moves_differently("not read");
  }

  /// Adds the world as a link where joints or static nested models need it.
  void add_world(const xml_item& m) {
    bool needed = !still_.empty() && !child_flag(m, "static", false);
    for (const auto& p : moving_)
      for (const char* end : {"parent", "child"})
        needed |= frames_.link_of(p.x, frames_.find(p.x, p.scope, child_text(p.x, end))) == "world";
    const auto is_world = [](const auto& l) { return l.name == "world"; };
    if (needed && std::none_of(d_.links.begin(), d_.links.end(), is_world))
      d_.links.emplace(d_.links.begin())->name = "world";
  }

  /// Rotates gravity from the axes of the world, in which SDF has it, into those of the root.
  void turn_gravity(const xml_item& m, const std::string& root) {
    if (root.empty()) return;
    const auto turned = frames_.relative(m, true_world, root).rotation;
    if (turned == robot_pose{}.rotation) return;
    const vec3<> g = transpose(turned) * d_.gravity.value_or(vec3<>{0, 0, -9.81});
    d_.gravity = vec3<>{g.x + 0.0, g.y + 0.0, g.z + 0.0};
  }
  void list_frames() {
    std::unordered_set<std::string_view> links;
    for (const auto& l : d_.links) links.insert(l.name);
    for (const auto& p : named_) {
      const auto link = frames_.link_of(p.x, p.name);
      if (links.contains(link))
        d_.frames.push_back({p.name, p.x.line(), link, frames_.relative(p.x, link, p.name)});
      else
        p.x.not_read("it is attached to the world, not to the robot");
    }
  }

  static constexpr const char* true_world = "__world__";

  robot_description& d_;
  const robot_options& options_;
  sdf_frames frames_;
  sdf_leftovers leftovers_;
  sdf_links links_;
  sdf_joints joints_;
  std::vector<part> parts_, moving_, named_, placed_;  ///< links, joints, frames, and models with placement frames
  std::set<std::string> still_;                        ///< full names of links that do not move
  bool windy_ = false;
};

}  // namespace kte::detail
