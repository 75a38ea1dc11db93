#pragma once

#include <kte/robots/detail/physical.hpp>
#include <kte/robots/detail/robot_tree.hpp>
#include <kte/robots/detail/write_mjcf_weight.hpp>

namespace kte::detail {

/// A body of MJCF: a link and the joints that move it, one after another.
struct mjcf_body {
  std::size_t link;
  std::vector<std::size_t> joints;
  robot_pose place;                ///< in the parent body, with all coordinates 0
  std::vector<robot_pose> behind;  ///< by joint: the pose of the body in the frame that the joint moves
};

/// Distributes the links and joints of a description without child poses over bodies of MJCF. MuJoCo accepts no moving
/// body without mass, so joints with only a massless frame between them share a body.
class mjcf_plan {
 public:
  using kind = robot_joint::kind;

  explicit mjcf_plan(const robot_description& d) : d_(d), tree_(d, {}), below_(d.links.size()), rest_(d.links.size()) {
    rest_[root()] = robot_pose{};
    for (const auto& s : tree_.steps()) {
      const auto& j = d.joints[s.joint];
      const auto from = tree_.base(s);
      below_[from].push_back(s.joint);
      if (j.is == kind::fixed && rest_[from]) rest_[child(s.joint)] = *rest_[from] * j.origin;
    }
    for (const auto& l : d.links) bodies_.push_back(l.inertial);
    for (auto& b : bodies_)
      if (b && b->mass == 0 && b->inertia == sym3<>{}) b.reset();
    carried_.resize(bodies_.size());
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      if (const auto& b = bodies_[i]) carried_[i] = {b->mass, principal_moments(b->inertia)[2]};
    for (auto s = tree_.steps().rbegin(); s != tree_.steps().rend(); ++s) {
      const auto& more = carried_[child(s->joint)];
      auto& sum = carried_[tree_.base(*s)];
      sum.first += more.first, sum.second += more.second;
    }
  }

  std::size_t root() const { return tree_.root(); }
  std::size_t child(std::size_t joint) const { return tree_.child(joint); }
  const std::vector<std::size_t>& below(std::size_t link) const { return below_[link]; }
  /// The pose in the world of a link that does not move.
  const std::optional<robot_pose>& rest(const std::string& link) const { return rest_[tree_.link(link)]; }
  std::optional<rigid_body<>>& weight(std::size_t link) { return bodies_[link]; }

  mjcf_body body(std::size_t first) const {
    mjcf_body b{child(first), {first}, {}, {}};
    while (goes_on(b)) b.joints.push_back(below_[b.link][0]), b.link = child(b.joints.back());
    for (std::size_t i = b.joints.size(); i-- > 0;) {
      b.behind.insert(b.behind.begin(), b.place);
      const auto& j = d_.joints[b.joints[i]];
      b.place = j.is == kind::floating ? robot_pose{} : j.origin * b.place;
    }
    return b;
  }

  /// Whether MuJoCo accepts the link as a moving body: it has mass, or a link fixed directly to it has.
  bool may_move(std::size_t link) const {
    if (is_heavy(link)) return true;
    for (const auto k : below_[link])
      if (d_.joints[k].is == kind::fixed && is_heavy(child(k))) return true;
    return false;
  }
  /// The mass of a link and of the links fixed to it, which are then left without mass.
  std::optional<rigid_body<>> gathered(std::size_t link, std::vector<std::size_t>& from) {
    struct branch {
      std::size_t link;
      const robot_pose* origin;  ///< in the branch above
      std::optional<rigid_body<>> all;
      std::size_t next = 0;
    };
    std::vector<branch> open;  // no recursion: chains of fixed links may be long
    const auto enter = [&](std::size_t l, const robot_pose* origin) {
      open.push_back({l, origin, std::exchange(bodies_[l], std::nullopt)});
      if (open.back().all) from.push_back(l);
    };
    for (enter(link, nullptr);;) {
      auto& now = open.back();
      if (now.next < below_[now.link].size()) {
        const auto k = below_[now.link][now.next++];
        if (d_.joints[k].is == kind::fixed) enter(child(k), &d_.joints[k].origin);
        continue;
      }
      const auto done = now;
      open.pop_back();
      if (open.empty()) return done.all;
      if (!done.all) continue;
      const auto moved = moved_body(*done.origin, *done.all);
      auto& sum = open.back().all;
      sum = sum ? together(*sum, moved) : moved;
    }
  }
  /// The total mass, and the sum of the least principal moments, of a link and of all links that it carries.
  const std::pair<double, double>& carried(std::size_t link) const { return carried_[link]; }

 private:
  bool is_heavy(std::size_t link) const {
    const auto& b = bodies_[link];
    return b && mjcf_weight(*b).moves();
  }
  static int dofs(kind is) { return is == kind::fixed ? 0 : is == kind::spherical || is == kind::planar ? 3 : 1; }
  /// Whether the link is only a frame between its joints and one further joint, which can belong to the same body.
  bool goes_on(const mjcf_body& b) const {
    const auto& l = d_.links[b.link];
    if (bodies_[b.link] || !l.visuals.empty() || !l.collisions.empty() || below_[b.link].size() != 1) return false;
    const auto& next = d_.joints[below_[b.link][0]];
    if (next.is == kind::floating || d_.joints[b.joints[0]].is == kind::fixed) return false;
    if (next.is == kind::fixed && !l.name.starts_with(next.child + ".joint") && may_move(b.link)) return false;
    bool ball = false;
    int sum = dofs(next.is);
    for (const auto i : b.joints) {
      const auto is = d_.joints[i].is;
      if (is == kind::floating) return false;
      sum += dofs(is), ball |= is == kind::spherical;
    }
    const bool turns = next.is != kind::fixed && next.is != kind::prismatic;
    return sum <= 6 && !(ball && (turns || next.origin.rotation != robot_pose{}.rotation));
  }

  const robot_description& d_;
  robot_tree tree_;
  std::vector<std::vector<std::size_t>> below_;
  std::vector<std::optional<robot_pose>> rest_;
  std::vector<std::optional<rigid_body<>>> bodies_;
  std::vector<std::pair<double, double>> carried_;  ///< by link
};

}  // namespace kte::detail
