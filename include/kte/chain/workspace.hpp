#pragma once

#include <kte/chain/kte_map.hpp>
#include <kte/chain/topology.hpp>
#include <kte/kernels/articulate.hpp>

#include <Eigen/Core>

#include <vector>

namespace kte {

using wrench_3D = wrench<vec3<>, vec3<>>;
using composite_3D = composite<double, vec3<>, sym3<>>;

namespace detail {

/// Whatever is wanted of every frame, in the plane and in space.
template <class T>
struct of_each_frame {
  std::vector<T> in_plane, in_space;
  template <kind K>
  T& get(int i) {
    static_assert(is_frame(K));
    return (K == kind::frame_2D ? in_plane : in_space)[static_cast<std::size_t>(i)];
  }
  void fill(const T& x) {
    std::fill(in_plane.begin(), in_plane.end(), x);
    std::fill(in_space.begin(), in_space.end(), x);
  }
};

/// Working memory of the algorithms on runtime chains, so that they allocate nothing.
struct workspace {
  /// A frame without position and velocity, which most algorithms do not need.
  struct frame {
    vec3<> ang_velocity{}, acceleration{}, ang_acceleration{};
    wrench_3D load{};
  };
  using articulated_3D = articulated<sym3<>, mat3<>, sym3<>>;
  /// Of an element: of a joint, the row of its coordinate among all coordinates, and its columns and those of all
  /// joints beyond it; of a link, only the latter.
  struct place {
    int row = 0;
    std::size_t first = 0, last = 0;
    bool free = false;  ///< its coordinate is a degree of freedom
  };

  explicit workspace(const topology& t) {
    const auto of = [&](auto& x) {
      x.in_plane.resize(t.names[static_cast<std::size_t>(kind::frame_2D)].size());
      x.in_space.resize(t.names[static_cast<std::size_t>(kind::frame_3D)].size());
    };
    of(frames), of(carried), of(burdens), of(accelerations);
    arrange(t);
    const auto n = static_cast<std::size_t>(t.nv), c = static_cast<std::size_t>(coordinates);
    own_mass.resize(c), gains.resize(n), rates.resize(n);
    row_of_column.resize(columns);
    for (auto& x : column) x.resize(columns);
    mass.resize(t.nv, t.nv), all.resize(coordinates > t.nv ? coordinates : 0, coordinates > t.nv ? coordinates : 0);
    forces.resize(t.nv);
    for (const auto& f : t.free)
      if (f.what == kind::gen && t.is_angle(f.slot)) angles.push_back(f.slot);
    for (auto* x : {&angle, &sine, &cosine}) x->resize((angles.size() + 3) / 4 * 4);
  }

  of_each_frame<frame> frames;
  std::vector<std::pair<kind, int>> bases;  ///< frames that no element writes
  std::vector<int> angles;                  ///< free generalized coordinates of which sine and cosine are wanted
  std::vector<double> angle, sine, cosine;  ///< of these, and zeros up to a multiple of four
  bool reads_positions = false;             ///< some element does
  // mass matrix
  of_each_frame<composite_3D> carried;
  std::vector<place> places;  ///< of all elements
  std::vector<int> movers;    ///< elements that write something
  std::vector<int>
      weights;  ///< elements on generalized coordinates, which may have a mass, or write a follower; last first
  std::size_t columns = 0;  ///< one for every axis of every joint, those beyond a joint right behind its own
  std::array<std::vector<double>, 6> column;  ///< the wrench that accelerates an axis, as felt further down
  std::vector<int> row_of_column;
  int coordinates = 0;          ///< all of them: degrees of freedom first, then followers
  std::vector<int> row_of_gen;  ///< of generalized coordinates
  // articulated bodies
  of_each_frame<burden<articulated_3D, wrench_3D>> burdens;
  of_each_frame<acceleration<vec3<>, vec3<>>> accelerations;
  std::vector<double> own_mass;  ///< of coordinates, by row
  std::vector<wrench_3D> gains;
  std::vector<double> rates;
  bool good = true;
  bool tree = true;            ///< no coordinate follows another or moves two joints
  std::vector<int> lone_rows;  ///< of degrees of freedom that move no joint
  // results
  Eigen::MatrixXd all;  ///< the mass matrix over all coordinates, if there are followers
  Eigen::MatrixXd mass;
  Eigen::VectorXd forces;

 private:
  /// Rows and columns. The columns beyond a frame are a range: sizes are summed up from the last element to the first,
  /// then ranges are dealt out from the first to the last.
  void arrange(const topology& t);
};

inline void workspace::arrange(const topology& t) {
  for (const kind k : {kind::frame_2D, kind::frame_3D}) {
    const auto& writers = t.writers[static_cast<std::size_t>(k)];
    for (std::size_t i = 0; i < writers.size(); ++i)
      if (writers[i] < 0) bases.emplace_back(k, static_cast<int>(i));
  }
  const auto& gens = t.names[static_cast<std::size_t>(kind::gen)];
  row_of_gen.assign(gens.size(), -1);
  for (const auto& f : t.free)
    if (f.what == kind::gen) row_of_gen[static_cast<std::size_t>(f.slot)] = f.v;
  coordinates = t.nv;
  for (auto& row : row_of_gen)
    if (row < 0) row = coordinates++;

  of_each_frame<std::size_t> beyond, next;
  for (auto* x : {&beyond, &next}) {
    x->in_plane.assign(frames.in_plane.size(), 0);
    x->in_space.assign(frames.in_space.size(), 0);
  }
  const auto on = [](auto& x, kind k, int i) -> auto& {
    return k == kind::frame_2D ? x.template get<kind::frame_2D>(i) : x.template get<kind::frame_3D>(i);
  };
  std::vector<int> joints(static_cast<std::size_t>(coordinates), 0);  // by row
  places.resize(t.elements.size());
  for (std::size_t e = t.elements.size(); e-- > 0;) {
    const auto& [element, index, ports, stiff] = t.elements[e];
    reads_positions |= element->reads_positions();
    if (ports.back().how == access::out) movers.push_back(static_cast<int>(e));
    if (!stiff && ports[0].what == kind::gen) weights.push_back(static_cast<int>(e));
    if (!stiff) {
      tree &= ports.back().how != access::out;
      continue;
    }
    const std::size_t base = index.size() - 2;
    const auto own = base == 1 ? static_cast<std::size_t>(nv_of(ports[0].what)) : 0;
    auto& p = places[e];
    p.last = own + on(beyond, ports[base + 1].what, index[base + 1]);
    on(beyond, ports[base].what, index[base]) += p.last;
    if (base == 0) continue;
    for (const auto& f : t.free)
      if (f.what == ports[0].what && f.slot == index[0]) p.row = f.v, p.free = true;
    if (!p.free) p.row = row_of_gen[static_cast<std::size_t>(index[0])];
    ++joints[static_cast<std::size_t>(p.row)];
  }
  std::reverse(movers.begin(), movers.end());
  for (const auto& f : t.free) {
    tree &= joints[static_cast<std::size_t>(f.v)] <= 1;
    if (joints[static_cast<std::size_t>(f.v)] == 0) lone_rows.push_back(f.v);
  }
  for (const auto& [k, i] : bases) {
    on(next, k, i) = columns;
    columns += on(beyond, k, i);
  }
  for (std::size_t e = 0; e < t.elements.size(); ++e) {
    const auto& [element, index, ports, stiff] = t.elements[e];
    if (!stiff) continue;
    const std::size_t base = index.size() - 2;
    auto& p = places[e];
    auto& from = on(next, ports[base].what, index[base]);
    p.first = from;
    from = p.last += p.first;
    on(next, ports[base + 1].what, index[base + 1]) =
        p.first + (base == 1 ? static_cast<std::size_t>(nv_of(ports[0].what)) : 0);
  }
}

}  // namespace detail

}  // namespace kte
