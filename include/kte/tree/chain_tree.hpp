#pragma once

#include <kte/contract/element_numbers.hpp>
#include <kte/tree/build.hpp>
#include <kte/tree/plan.hpp>

#include <algorithm>

/// What the loops over records need of a chain, worked out from its wiring and the numbers of its elements.
namespace kte::detail {

/// P: its numbers. Plan: of `arrange`, or a reference to one.
template <class P, class Plan>
class chain_tree {
 public:
  Plan plan;
  tree::forest<P> forest;
  std::vector<int> slot_of_base;  ///< of plan.bases
  struct rotor {
    int coordinate;
    P mass;
  };
  std::vector<rotor> rotors;  ///< masses on generalized coordinates, and nothing more
  std::vector<P> own_mass;    ///< of all elements on coordinates, by row
  bool has_own_mass = false;
  bool only_bodies = false;                   ///< a tree of degrees of freedom with nothing but bodies on it
  std::vector<int> angles;                    ///< records of which sine and cosine are wanted
  std::vector<int> followers;                 ///< elements, in order
  std::vector<int> on_coordinates;            ///< elements that act on coordinates alone, in order
  std::vector<int> on_frames;                 ///< elements that act on frames and are no rigid bodies
  std::vector<int> weights;                   ///< those of them that have a mass
  std::vector<std::pair<kind, int>> touched;  ///< the frames that these act on
  std::vector<std::pair<kind, int>> turned;   ///< coordinates whose sines or matrices are read, but by joints
  /// An element that is more than records say, and why; -1: none. Passes alone know such chains.
  int irregular = -1;
  const char* why = "";

  /// `c` as for `arrange`; each_element(f): f(e, its `element_numbers<P>`) for all, in order.
  template <class Connections, class Each>
  chain_tree(const Connections& c, Plan p, const Each& each_element)
      : plan(std::forward<Plan>(p)), own_mass(static_cast<std::size_t>(plan.coordinates), P(0)), dofs_(c.dofs()) {
    frames_[0].resize(static_cast<std::size_t>(c.count(kind::frame_2D)));
    frames_[1].resize(static_cast<std::size_t>(c.count(kind::frame_3D)));
    builder b;
    for (const auto& [k, i] : plan.bases) {
      frame(k, i) = b.add_base();
      slot_of_base.push_back(frame(k, i).slot);
    }
    each_element([&](std::size_t e, const element_numbers<P>& n) {
      const auto index = [&](std::size_t port) { return c.index(e, port); };
      add(static_cast<int>(e), c.ports(e), index, n, b);
    });
    forest = b.finish(std::move(frames_));
    for (std::size_t i = 0; i < forest.records.size(); ++i) {
      const auto m = forest.records[i].moves;
      if (m == tree::joint::revolute || m == tree::joint::screw) angles.push_back(static_cast<int>(i));
    }
    for (const P& m : own_mass) has_own_mass |= m != P(0);
    only_bodies = irregular < 0 && plan.tree && plan.coordinates == dofs_ && plan.lone_rows.empty() &&
                  on_coordinates.empty() && on_frames.empty() && followers.empty();
    for (auto* list : {&touched, &turned}) {
      std::sort(list->begin(), list->end());
      list->erase(std::unique(list->begin(), list->end()), list->end());
    }
  }

 private:
  using builder = tree::forest_builder<P>;
  using place = typename builder::place_type;

  place& frame(kind k, int i) { return frames_[k == kind::frame_2D ? 0 : 1][static_cast<std::size_t>(i)]; }

  template <class Index>
  void add(int number, std::span<const port> ports, const Index& index, const element_numbers<P>& n, builder& b) {
    const auto at = [&](std::size_t p) -> place& { return frame(ports[p].what, index(p)); };
    if (n.is != part::stiff)
      for (std::size_t p = 0; p < ports.size(); ++p)
        if (ports[p].how == access::angle) turned.emplace_back(ports[p].what, index(p));
    switch (n.is) {
      case part::base:
        break;
      case part::stiff: {
        if (!n.plain_loads)
          exclude(number, " has a `doForce` of its own: put that force into an element on the coordinate");
        if (ports.size() == 2) {
          at(1) = builder::link(at(0), n.stiff);
          break;
        }
        const int row = plan.joint_row[static_cast<std::size_t>(number)];
        at(2) = b.add_joint(at(1), n.stiff, ports[0].what, index(0), row, row < dofs_);
        if (!b.moves_by_axes(n.stiff, at(2)))
          exclude(number, " does not move along axes that are constant in its end, as joints must");
        break;
      }
      case part::body:
        if (ports[0].what == kind::gen) {
          add_mass(index(0), n.mass);
          rotors.push_back({index(0), n.mass});
        } else {
          b.add_body(at(0), n.body);
        }
        break;
      case part::weight:
        b.add_weight(at(0), n.weight);
        weights.push_back(number);
        touch(number, ports, index);
        break;
      case part::follower:
        followers.push_back(number);
        break;
      case part::mover:
        exclude(number, " moves a frame and is no joint or link");
        break;
      case part::force: {
        if (n.mass != P(0)) add_mass(index(0), n.mass);
        bool frames = false;
        for (const auto& p : ports) frames |= is_frame(p.what);
        if (frames)
          touch(number, ports, index);
        else
          on_coordinates.push_back(number);
      }
    }
  }
  void add_mass(int coordinate, const P& mass) {
    own_mass[static_cast<std::size_t>(plan.row_of_gen[static_cast<std::size_t>(coordinate)])] += mass;
  }
  template <class Index>
  void touch(int number, std::span<const port> ports, const Index& index) {
    on_frames.push_back(number);
    for (std::size_t p = 0; p < ports.size(); ++p)
      if (is_frame(ports[p].what)) touched.emplace_back(ports[p].what, index(p));
  }
  void exclude(int number, const char* reason) {
    if (irregular < 0) irregular = number, why = reason;
  }

  std::array<std::vector<place>, 2> frames_;  ///< until they are in the forest
  int dofs_;
};

}  // namespace kte::detail
