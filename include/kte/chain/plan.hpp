#pragma once

#include <kte/chain/port.hpp>
#include <kte/chain/wiring.hpp>

#include <array>
#include <utility>
#include <vector>

/// The order of work on a chain, for the algorithms that are loops over its elements: on runtime chains, and on static
/// chains that are too large to unroll.
namespace kte::detail {

/// The place of an element. The columns beyond a frame are a range: one for every axis of every joint, those beyond a
/// joint right behind its own.
struct place {
  int row = 0, axes = 0;            ///< of a joint: its first coordinate among all coordinates, and how many
  std::size_t first = 0, last = 0;  ///< columns: of a joint its own and those of all joints beyond it, of a link these
  int below = -1;                   ///< the element whose end is the base of this joint or link
  bool free = false;                ///< its coordinate is a degree of freedom
};

/// What `arrange` works out. List: std::vector, or `short_list` where a chain is known to the compiler.
template <template <class> class List>
struct plan {
  List<std::pair<kind, int>> bases;  ///< frames that no element writes
  List<int> angles;                  ///< free generalized coordinates of which sine and cosine are wanted
  List<place> places;                ///< of all elements
  List<int> movers;                  ///< elements that write something
  List<int> weights;     ///< elements on generalized coordinates, which may have a mass or write a follower; last first
  List<int> row_of_gen;  ///< of generalized coordinates, among all coordinates: free ones first, then the others
  List<int> lone_rows;   ///< of degrees of freedom that move no joint
  std::size_t columns = 0;  ///< of all joints
  int coordinates = 0;      ///< all of them
  bool tree = true;         ///< no coordinate follows another or moves two joints
};

/// A vector of at most N.
template <class T, std::size_t N>
struct short_list {
  std::array<T, N> item{};
  std::size_t count = 0;
  constexpr void push_back(const T& x) { item[count++] = x; }
  constexpr void resize(std::size_t n) { count = n; }
  constexpr std::size_t size() const { return count; }
  constexpr T& operator[](std::size_t i) { return item[i]; }
  constexpr const T& operator[](std::size_t i) const { return item[i]; }
  constexpr auto begin() const { return item.begin(); }
  constexpr auto end() const { return item.begin() + static_cast<std::ptrdiff_t>(count); }
};

/// Works out the plan of a chain: `Chain` says
///   elements(), ports(e), index(e, p), stiff(e)   its elements, what their ports are connected to, joints and links
///   count(k), writer(k, i)                        the things of kind k, and the element that writes one, or -1
///   freedoms(), freedom_at(f), dofs()             its degrees of freedom
///   is_angle(i)                                   whether the sine of generalized coordinate i is wanted
/// Sizes are summed up from the last element to the first, then ranges are dealt out from the first to the last.
template <template <class> class List, class Chain>
constexpr plan<List> arrange(const Chain& c) {
  plan<List> p;
  for (const kind k : {kind::frame_2D, kind::frame_3D})
    for (int i = 0; i < c.count(k); ++i)
      if (c.writer(k, i) < 0) p.bases.push_back({k, i});

  std::array<List<int>, kinds> row_of;  // of coordinates by kind; -1: no degree of freedom
  for (std::size_t k = 0; k < kinds; ++k) {
    if (!is_coordinate(static_cast<kind>(k))) continue;
    row_of[k].resize(static_cast<std::size_t>(c.count(static_cast<kind>(k))));
    for (std::size_t i = 0; i < row_of[k].size(); ++i) row_of[k][i] = -1;
  }
  for (std::size_t f = 0; f < c.freedoms(); ++f) {
    const freedom at = c.freedom_at(f);
    row_of[static_cast<std::size_t>(at.what)][static_cast<std::size_t>(at.slot)] = at.v;
    if (at.what == kind::gen && c.is_angle(at.slot)) p.angles.push_back(at.slot);
  }
  p.row_of_gen = row_of[static_cast<std::size_t>(kind::gen)];
  p.coordinates = c.dofs();
  for (std::size_t i = 0; i < p.row_of_gen.size(); ++i)
    if (p.row_of_gen[i] < 0) p.row_of_gen[i] = p.coordinates++;

  std::array<List<std::size_t>, 2> beyond, next;  // columns, of frames in the plane and in space
  for (std::size_t k = 0; k < 2; ++k)
    for (auto* x : {&beyond[k], &next[k]}) {
      x->resize(static_cast<std::size_t>(c.count(k == 0 ? kind::frame_2D : kind::frame_3D)));
      for (std::size_t i = 0; i < x->size(); ++i) (*x)[i] = 0;
    }
  const auto on = [](auto& x, kind k, int i) -> auto& {
    return x[k == kind::frame_2D ? 0 : 1][static_cast<std::size_t>(i)];
  };
  List<int> joints;  // by row
  joints.resize(static_cast<std::size_t>(p.coordinates));
  for (std::size_t i = 0; i < joints.size(); ++i) joints[i] = 0;

  p.places.resize(c.elements());
  for (std::size_t e = c.elements(); e-- > 0;) {
    const auto ports = c.ports(e);
    const bool writes = ports.back().how == access::out;
    if (!c.stiff(e)) {
      if (ports[0].what == kind::gen) p.weights.push_back(static_cast<int>(e));
      p.tree &= !writes;
      continue;
    }
    const std::size_t base = ports.size() - 2;
    const kind coordinate = ports[0].what;
    const auto own = base == 1 ? static_cast<std::size_t>(nv_of(coordinate)) : 0;
    auto& x = p.places[e];
    x = place{};
    x.below = c.writer(ports[base].what, c.index(e, base));
    x.last = own + on(beyond, ports[base + 1].what, c.index(e, base + 1));
    on(beyond, ports[base].what, c.index(e, base)) += x.last;
    if (base == 0) continue;
    x.axes = static_cast<int>(own);
    x.row = row_of[static_cast<std::size_t>(coordinate)][static_cast<std::size_t>(c.index(e, 0))];
    x.free = x.row >= 0;
    if (!x.free) x.row = p.row_of_gen[static_cast<std::size_t>(c.index(e, 0))];
    ++joints[static_cast<std::size_t>(x.row)];
  }
  for (std::size_t f = 0; f < c.freedoms(); ++f) {
    const int row = c.freedom_at(f).v;
    p.tree &= joints[static_cast<std::size_t>(row)] <= 1;
    if (joints[static_cast<std::size_t>(row)] == 0) p.lone_rows.push_back(row);
  }
  for (const auto& [k, i] : p.bases) {
    on(next, k, i) = p.columns;
    p.columns += on(beyond, k, i);
  }
  for (std::size_t e = 0; e < c.elements(); ++e) {
    const auto ports = c.ports(e);
    if (ports.back().how == access::out) p.movers.push_back(static_cast<int>(e));
    if (!c.stiff(e)) continue;
    const std::size_t base = ports.size() - 2;
    auto& x = p.places[e];
    auto& from = on(next, ports[base].what, c.index(e, base));
    x.first = from;
    from = x.last += x.first;
    on(next, ports[base + 1].what, c.index(e, base + 1)) =
        x.first + (base == 1 ? static_cast<std::size_t>(nv_of(ports[0].what)) : 0);
  }
  return p;
}

template <class T>
using growing_list = std::vector<T>;
using runtime_plan = plan<growing_list>;

}  // namespace kte::detail
