#pragma once

#include <kte/contract/element_numbers.hpp>
#include <kte/tree/build.hpp>
#include <kte/tree/clusters.hpp>
#include <kte/tree/plan.hpp>
#include <kte/tree/tree_in_lanes.hpp>

#include <algorithm>

/// The data that the loops over body nodes need of a chain, computed from its wiring and the numbers of its elements.
namespace kte::detail {

/// What the trees of chains that differ in numbers only have in common.
struct chain_structure {
  std::vector<int> slot_of_base;  ///< by base of the plan
  bool has_own_mass = false;
  bool only_bodies = false;  ///< whether the chain is a tree of degrees of freedom with bodies only
  std::vector<int> angles;   ///< body nodes whose sine and cosine are used
  /// Elements that write coordinates, signals and frames before bodies are placed (`followers`), and those that write
  /// signals and frames, on which forces depend, after it (`late`), in order.
  std::vector<int> followers, late;
  tree::cluster_layout clusters;    ///< of coordinates that follow others; none in trees
  std::vector<int> on_coordinates;  ///< elements that act on coordinates only, in order
  std::vector<int> on_frames;       ///< elements that act on frames and are not rigid bodies, and movers in `late`
  std::vector<int> weights;         ///< elements of `on_frames` with mass
  std::vector<int> distributed;     ///< elements with a mass between several ports
  std::vector<int> with_energy;     ///< elements that give an energy, other than rigid bodies
  bool energy_on_frames = false;    ///< whether some of them are on frames
  std::vector<int> readers;         ///< joints whose friction depends on what they carry
  std::vector<int> locks;           ///< elements that may hold a coordinate
  std::vector<std::pair<kind, int>> written;  ///< frames written by `late` elements
  std::vector<std::pair<kind, int>> touched;  ///< frames on which `on_frames` act
  std::vector<std::pair<kind, int>>
      turned;  ///< coordinates whose sines or matrices are read by elements other than joints
  /// An element that body nodes cannot represent, and the reason.
  struct exception {
    int element = -1;  ///< -1: there is no such element
    const char* why = "";
    explicit operator bool() const { return element >= 0; }
  };
  exception irregular;      ///< the first with an irregular motion or load: only passes support such chains
  exception moves_unknown;  ///< the first with an irregular motion
};
/// P: the type of its numbers. Plan: the result of `arrange`, or a reference to one.
template <class P, class Plan>
class chain_tree : public chain_structure {
 public:
  Plan plan;
  tree::body_tree<P> body_tree;
  struct rotor {
    int coordinate;
    P mass;
  };
  std::vector<rotor> rotors;  ///< masses on generalized coordinates
  std::vector<P> own_mass;    ///< by row: the sum of all masses on coordinates

  /// `c`: as for `arrange`. each_element(f) calls f(e, its `element_numbers<P>`) for all elements in order.
  template <class Connections, class Each>
  chain_tree(const Connections& c, Plan p, const Each& each_element)
      : plan(std::forward<Plan>(p)),
        own_mass(static_cast<std::size_t>(plan.coordinates), P(0)),
        depends_(dependencies_of<growing>(c)),
        dofs_(c.dofs()) {
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
    body_tree = b.finish(std::move(frames_));
    find_angles();
    if (!plan.tree && distributed.empty()) find_clusters(c);
    for (const P& m : own_mass) has_own_mass |= m != P(0);
    only_bodies = !irregular && plan.tree && plan.coordinates == dofs_ && plan.jointless_dofs.empty() &&
                  on_coordinates.empty() && on_frames.empty() && followers.empty() && late.empty() && readers.empty();
    std::erase_if(touched, [this](const auto& x) { return is_late(x.first, x.second); });
    for (const auto& [k, i] : written)
      body_tree.frames[k == kind::frame_2D ? 0 : 1][static_cast<std::size_t>(i)].slot = -1;
    depends_ = {};
    for (auto* list : {&touched, &turned}) {
      std::sort(list->begin(), list->end());
      list->erase(std::unique(list->begin(), list->end()), list->end());
    }
  }
  /// The trees of chains that differ in numbers only, as the lanes of packs P; one tree: in all lanes.
  template <class T>
  explicit chain_tree(std::span<const chain_tree<T, Plan>> trees) : chain_tree(trees, trees.front()) {}

 private:
  template <class T, class U>
  friend class chain_tree;
  template <class T>
  chain_tree(std::span<const chain_tree<T, Plan>> trees, const chain_tree<T, Plan>& one)
      : chain_structure(one), plan(one.plan), own_mass(one.own_mass.size()), dofs_(one.dofs_) {
    const auto lane = [&](std::size_t i) -> const auto& { return trees[i < trees.size() ? i : 0]; };
    body_tree = tree::tree_in_lanes<P>([&](std::size_t i) -> const auto& { return lane(i).body_tree; });
    find_angles();
    for (const auto& r : one.rotors) rotors.push_back({r.coordinate, P(r.mass)});
    for (std::size_t i = 0; i < std::size_t{P::lanes}; ++i) {
      const auto& x = lane(i);
      const tree::lane_writer<P> write(i);
      write(own_mass, x.own_mass);
      for (std::size_t k = 0; k < rotors.size(); ++k) rotors[k].mass.set(i, x.rotors[k].mass);
      has_own_mass |= x.has_own_mass, only_bodies &= x.only_bodies;
      if (!irregular && x.irregular) irregular = {x.irregular.element, x.irregular.why};
      if (!moves_unknown && x.moves_unknown) moves_unknown = {x.moves_unknown.element, x.moves_unknown.why};
    }
  }
  void find_angles() {
    angles.clear();
    for (std::size_t i = 0; i < body_tree.nodes.size(); ++i) {
      const auto m = body_tree.nodes[i].moves;
      if (m == tree::joint::revolute || m == tree::joint::screw) angles.push_back(static_cast<int>(i));
    }
  }
  template <class Connections>
  void find_clusters(const Connections& c) {
    std::vector<std::pair<int, int>> links;
    std::vector<tree::cluster_follower> all;
    const auto row = [this](int i) { return plan.row_of_gen[static_cast<std::size_t>(i)]; };
    for (const int f : followers) {
      const auto e = static_cast<std::size_t>(f);
      const auto ports = c.ports(e);
      const std::size_t last = ports.size() - 1;
      auto& x = all.emplace_back();
      x.element = f;
      if (ports[last].what != kind::gen) continue;
      x.written = c.index(e, last), x.row = row(x.written), x.alone = true;
      for (std::size_t p = 0; p < last; ++p) {
        x.alone &= !is_signal(ports[p].what) || ports[p].what == kind::internal;
        if (ports[p].what != kind::gen) continue;
        const int followed = c.index(e, p);
        links.emplace_back(row(followed), x.row);
        if (std::none_of(x.followed.begin(), x.followed.end(), [&](const auto& y) { return y.coordinate == followed; }))
          x.followed.push_back({p, followed, row(followed)});
      }
      x.alone &= x.followed.size() == 1;
    }
    clusters = tree::clusters_of(body_tree, plan.coordinates, dofs_, links);
    clusters.followers = std::move(all);
  }

  template <class T>
  using growing = std::vector<T>;
  using builder = tree::body_tree_builder<P>;
  using place = typename builder::place_type;

  place& frame(kind k, int i) { return frames_[k == kind::frame_2D ? 0 : 1][static_cast<std::size_t>(i)]; }

  /// Whether a frame is written from other frames by an element that is not a joint or link.
  bool is_late(kind k, int i) const {
    return std::find(written.begin(), written.end(), std::pair{k, i}) != written.end();
  }

  template <class Index>
  void add(int number, std::span<const port> ports, const Index& index, const element_numbers<P>& n, builder& b) {
    const auto at = [&](std::size_t p) -> place& { return frame(ports[p].what, index(p)); };
    if (n.is != part::rigid)
      for (std::size_t p = 0; p < ports.size(); ++p)
        if (ports[p].how == access::angle) turned.emplace_back(ports[p].what, index(p));
    if (n.is != part::force && n.is != part::rigid && is_frame(ports[0].what) && n.is < part::follower &&
        is_late(ports[0].what, index(0)))
      exclude_loads(number, " has a mass on a frame that follows others");
    if (n.has_energy && n.is != part::body) {
      with_energy.push_back(number);
      for (const auto& p : ports) energy_on_frames |= is_frame(p.what);
    }
    if (!n.power_dual) exclude_loads(number, " returns loads that are not the dual of its motion, for controllers");
    const std::size_t last = ports.size() - 1;
    switch (n.is) {
      case part::base:
      case part::closure:
        break;
      case part::rigid: {
        if (is_late(ports[last - 1].what, index(last - 1))) {
          exclude(number, " stands on a frame that follows others: joints and links cannot");
          break;
        }
        if (!n.plain_loads)
          exclude_loads(number, " has its own `doForce`: put that force into an element on the coordinate");
        if (ports.size() == 2) {
          at(1) = builder::link(at(0), n.rigid);
          break;
        }
        if (n.varying_axes) {
          add_varying_joint(number, ports, index, b);
          break;
        }
        const int row = plan.joint_row[static_cast<std::size_t>(number)];
        at(last) = b.add_joint(at(last - 1), n.rigid, ports[0].what, index(0), row, row < dofs_);
        if (!b.moves_by_axes(n.rigid, at(last)))
          exclude(number, " moves along axes that are not constant in its end: its core needs `varying_axes = true`");
        if (n.load_dependent_friction) {
          readers.push_back(number);
          turned.emplace_back(ports[0].what, index(0));
        }
        if (n.locks_coordinate) add_lock(number, index(0));
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
        for (std::size_t i = 0; i < last; ++i)
          if (is_signal(ports[i].what) && depends_.at(ports[i].what, index(i)) != level::given)
            exclude(number, " moves a coordinate by a signal that depends on coordinates or frames");
        if (depends_.at(kind::gen, index(last)) == level::bodies)
          exclude(number, " moves a coordinate by what depends on frames");
        followers.push_back(number);
        break;
      case part::mover:
      case part::signal: {
        const level known = depends_.at(ports[last].what, index(last));
        if (n.is == part::mover && known != level::given) written.emplace_back(ports[last].what, index(last));
        if (!depends_.matters[static_cast<std::size_t>(number)]) break;
        if (n.measures_accelerations) exclude(number, " measures an acceleration, on which a force depends");
        if (known == level::given || (n.is == part::signal && known == level::coordinates)) {
          followers.push_back(number);
          break;
        }
        late.push_back(number);
        if (n.is == part::mover) on_frames.push_back(number);
        for (std::size_t i = 0; i < last; ++i)
          if (is_frame(ports[i].what)) touched.emplace_back(ports[i].what, index(i));
        break;
      }
      case part::force: {
        if (n.locks_coordinate) add_lock(number, index(0));
        if (n.distributed_mass) {
          distributed.push_back(number);
          for (std::size_t p = 0; p <= last; ++p)
            if (is_frame(ports[p].what) && is_late(ports[p].what, index(p)))
              exclude_loads(number, " has a mass on a frame that follows others");
        }
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
  /// Adds a joint whose axes depend on its coordinates; these precede the base and the end among the ports.
  template <class Index>
  void add_varying_joint(int number, std::span<const port> ports, const Index& index, builder& b) {
    const std::size_t count = ports.size() - 2;
    std::vector<int> slots(count), rows(count);
    std::size_t free = 0;
    for (std::size_t k = 0; k < count; ++k) {
      slots[k] = index(k), rows[k] = plan.row_of_gen[static_cast<std::size_t>(slots[k])];
      free += rows[k] < dofs_;
    }
    if (free != 0 && free != count)
      exclude(number, " has several coordinates, and not all of them are degrees of freedom");
    frame(ports.back().what, index(count + 1)) =
        b.add_varying_joint(frame(ports[count].what, index(count)), number, slots, rows, free == count);
  }
  void add_lock(int number, int coordinate) {
    locks.push_back(number);
    if (plan.row_of_gen[static_cast<std::size_t>(coordinate)] >= dofs_)
      exclude(number, " holds a coordinate that is not a degree of freedom");
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
  void exclude_loads(int number, const char* why) {
    if (!irregular) irregular = {number, why};
  }
  void exclude(int number, const char* why) {
    exclude_loads(number, why);
    if (!moves_unknown) moves_unknown = {number, why};
  }

  std::array<std::vector<place>, 2> frames_;  ///< until the tree is built
  dependencies<growing> depends_;             ///< until the tree is built
  int dofs_;
};

}  // namespace kte::detail
