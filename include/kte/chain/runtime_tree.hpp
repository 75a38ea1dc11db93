#pragma once

#include <kte/chain/kte_map.hpp>
#include <kte/chain/plan.hpp>
#include <kte/chain/topology.hpp>

/// What the loops over records need of a runtime chain, worked out once for all its states.
namespace kte::detail {

/// What `arrange` asks of a runtime chain.
struct runtime_connections {
  const topology& t;
  std::size_t elements() const { return t.elements.size(); }
  std::span<const port> ports(std::size_t e) const { return t.elements[e].ports; }
  int index(std::size_t e, std::size_t p) const { return t.elements[e].index[p]; }
  bool stiff(std::size_t e) const { return t.elements[e].stiff; }
  int count(kind k) const { return static_cast<int>(t.names[static_cast<std::size_t>(k)].size()); }
  int writer(kind k, int i) const { return t.writers[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)]; }
  std::size_t freedoms() const { return t.free.size(); }
  freedom freedom_at(std::size_t f) const { return t.free[f]; }
  int dofs() const { return t.nv; }
  bool is_angle(int i) const { return t.is_angle(i); }
};

class runtime_tree {
 public:
  tree::forest<double> forest;
  runtime_plan plan;
  std::vector<int> slot_of_base;  ///< of plan.bases
  std::vector<double> own_mass;   ///< on coordinates, by row
  bool has_own_mass = false;
  bool only_bodies = false;                   ///< a tree of degrees of freedom with nothing but bodies on it
  std::vector<int> angles;                    ///< records of which sine and cosine are wanted
  std::vector<int> followers;                 ///< elements, in order
  std::vector<int> on_coordinates;            ///< elements that act on coordinates alone, in order
  std::vector<int> on_frames;                 ///< elements that act on frames and are no rigid bodies
  std::vector<int> weights;                   ///< those of them that have a mass
  std::vector<std::pair<kind, int>> touched;  ///< the frames that these act on
  /// An element that is more than records say, and why; -1: none. Passes alone know such chains.
  int irregular = -1;
  const char* why = "";

  runtime_tree() = default;
  explicit runtime_tree(const topology& t)
      : plan(arrange<growing_list>(runtime_connections{t})), own_mass(static_cast<std::size_t>(plan.coordinates)) {
    std::array<std::vector<place>, 2> frames{std::vector<place>(t.names[1].size()),
                                             std::vector<place>(t.names[2].size())};
    const auto at = [&frames](kind k, int i) -> place& {
      return frames[k == kind::frame_2D ? 0 : 1][static_cast<std::size_t>(i)];
    };
    builder b;
    for (const auto& [k, i] : plan.bases) {
      at(k, i) = b.add_base();
      slot_of_base.push_back(at(k, i).slot);
    }
    for (std::size_t e = 0; e < t.elements.size(); ++e) add(t, static_cast<int>(e), at, b);
    forest = b.finish(std::move(frames));
    for (std::size_t i = 0; i < forest.records.size(); ++i) {
      const auto m = forest.records[i].moves;
      if (m == tree::joint::revolute || m == tree::joint::screw) angles.push_back(static_cast<int>(i));
    }
    for (const double m : own_mass) has_own_mass |= m != 0;
    only_bodies = irregular < 0 && plan.tree && plan.coordinates == t.nv && plan.lone_rows.empty() &&
                  on_coordinates.empty() && on_frames.empty() && followers.empty();
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  }

 private:
  using builder = tree::forest_builder<double>;
  using place = builder::place_type;

  template <class At>
  void add(const topology& t, int number, const At& at, builder& b) {
    const auto& e = t.elements[static_cast<std::size_t>(number)];
    const element_numbers n = e.element->numbers();
    const auto frame = [&](std::size_t p) -> place& { return at(e.ports[p].what, e.index[p]); };
    switch (n.is) {
      case part::base:
        break;
      case part::stiff: {
        if (!n.plain_loads)
          exclude(number, " has a `doForce` of its own: put that force into an element on the coordinate");
        const std::size_t base = e.ports.size() - 2;
        if (base == 0) {
          frame(1) = builder::link(frame(0), n.stiff);
          break;
        }
        const auto& x = plan.places[static_cast<std::size_t>(number)];
        frame(2) = b.add_joint(frame(1), n.stiff, e.ports[0].what, e.index[0], x.row, x.free);
        if (!b.moves_by_axes(n.stiff, frame(2)))
          exclude(number, " does not move along axes that are constant in its end, as joints must");
        break;
      }
      case part::body:
        b.add_body(frame(0), n.body);
        break;
      case part::weight:
        b.add_weight(frame(0), n.weight);
        weights.push_back(number);
        touch(e, number);
        break;
      case part::follower:
        followers.push_back(number);
        break;
      case part::mover:
        exclude(number, " moves a frame and is no joint or link");
        break;
      case part::force: {
        if (n.mass != 0)
          own_mass[static_cast<std::size_t>(plan.row_of_gen[static_cast<std::size_t>(e.index[0])])] += n.mass;
        bool frames = false;
        for (const auto& p : e.ports) frames |= is_frame(p.what);
        if (frames)
          touch(e, number);
        else
          on_coordinates.push_back(number);
      }
    }
  }
  void touch(const topology::connection& e, int number) {
    on_frames.push_back(number);
    for (std::size_t p = 0; p < e.ports.size(); ++p)
      if (is_frame(e.ports[p].what)) touched.emplace_back(e.ports[p].what, e.index[p]);
  }
  void exclude(int number, const char* reason) {
    if (irregular < 0) irregular = number, why = reason;
  }
};

}  // namespace kte::detail
