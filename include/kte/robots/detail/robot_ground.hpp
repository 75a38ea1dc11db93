#pragma once

#include <kte/robots/detail/link_groups.hpp>
#include <kte/robots/detail/robot_elements.hpp>
#include <kte/robots/options.hpp>

#include <algorithm>
#include <unordered_set>

namespace kte::detail {

/// A surface of the ground: a plane, or the height field of a shape.
struct ground_surface {
  std::string name, link;  ///< of its shape, if it is one of the file
  std::string frame;       ///< its frame in the chain
  vec3<> normal{0, 0, 1};  ///< of a plane, in axes of the frame
  const robot_shape* shape = nullptr;
  /// A plane that is not in the file touches all shapes that touch any.
  robot_touch touch() const {
    if (shape != nullptr) return shape->touch;
    robot_touch all;
    all.type = all.affinity = ~std::uint32_t{0};
    return all;
  }
  bool is_plane() const { return shape == nullptr || shape->is == robot_shape::form::plane; }
};

/// The ground of a robot (robot_contact_options::ground): the planes and height fields of links that are fixed to its
/// frame, or the plane z = 0 of the frame.
class robot_ground {
 public:
  static constexpr std::size_t no_group = ~std::size_t{0};

  robot_ground(robot_elements& to, const robot_description& d, const robot_options& o, const robot_tree& tree,
               const link_groups& groups)
      : to_(to), d_(d), group_(group_of(o, tree, groups)) {
    for (const auto& p : d.contact_pairs)
      if (!p.excluded) in_pairs_.insert({p.name1, p.name2});
    for (std::size_t i = 0; i < d.links.size(); ++i)
      if (groups.of(i) == group_)
        for (const auto& s : d.links[i].collisions) add(d.links[i], s);
    for (std::size_t i = 0; i < d.links.size(); ++i)  // shapes that touch in pairs only
      if (groups.of(i) == group_)
        for (const auto& s : d.links[i].visuals)
          if (in_pair(s.name) && !has(s.name)) add(d.links[i], s);
    if (surfaces_.empty()) surfaces_.push_back({"", "", o.contacts.ground});
  }
  /// The group of links that are fixed to the ground; `no_group` if none is.
  std::size_t group() const { return group_; }
  const std::vector<ground_surface>& surfaces() const { return surfaces_; }
  /// Whether the file has a contact of a shape of this name in a pair.
  bool in_pair(const std::string& name) const { return !name.empty() && in_pairs_.contains(name); }

 private:
  std::size_t group_of(const robot_options& o, const robot_tree& tree, const link_groups& groups) const {
    const auto& name = o.contacts.ground;
    if (o.floating_base && name == o.world) return no_group;
    if (tree.has_link(name)) return groups.of(tree.link(name));
    for (const auto& f : d_.frames)
      if (f.name == name) return groups.of(tree.link(f.link));
    const auto& root = d_.links[tree.root()].name;
    raise<bad_argument>("kte: the robot '" + d_.name + "' has no link or frame '" + name +
                        "' for the ground (robot_options::contacts): its base is '" +
                        (o.floating_base ? o.world : root) +
                        (o.floating_base ? "'" : "', or '" + o.world + "' with robot_options::floating_base"));
  }
  bool has(const std::string& name) const {
    return std::any_of(surfaces_.begin(), surfaces_.end(), [&](const auto& s) { return s.name == name; });
  }
  void add(const robot_link& l, const robot_shape& s) {
    using form = robot_shape::form;
    if (s.is != form::plane && (s.is != form::height_field || s.heights.empty())) return;
    ground_surface g{s.name, l.name, l.name};
    g.shape = &s;
    if (s.is == form::plane && s.origin.position == vec3<>{}) {
      g.normal = as<double>(s.origin.rotation * g.normal);
    } else if (!is_nothing(s.origin)) {
      g.frame = to_.fresh(s.name.empty() ? l.name + ".ground" : s.name);
      to_.append_link(l.name, g.frame, s.origin);
    }
    surfaces_.push_back(std::move(g));
  }

  robot_elements& to_;
  const robot_description& d_;
  std::size_t group_;
  std::vector<ground_surface> surfaces_;
  std::unordered_set<std::string_view> in_pairs_;  ///< the shapes of contacts in pairs
};

}  // namespace kte::detail
