#pragma once

#include <kte/contract/freedom.hpp>
#include <kte/tree/dependencies.hpp>

#include <array>
#include <utility>
#include <vector>

/// The order of coordinates and joints of a chain for the loops over body nodes: for runtime chains, and for static
/// chains that are not unrolled.
namespace kte::detail {

/// The result of `arrange`. List: std::vector, or `short_list` for chains known at compile time.
template <template <class> class List>
struct plan {
  List<std::pair<kind, int>> bases;  ///< frames that no element writes, or only from input
  List<int> joint_row;               ///< by element: for a joint the row of its first coordinate
  List<int> row_of_gen;  ///< rows of generalized coordinates among all coordinates: free ones first, then the others
  List<int> jointless_dofs;  ///< degrees of freedom that move no joint
  int coordinates = 0;       ///< number of all coordinates
  bool tree = true;          ///< no coordinate follows another or moves two joints, no mass is between two items
};

/// Computes the plan of a chain. `Chain` gives
///   elements(), ports(e), index(e, p), rigid(e)   its elements, the items at their ports, joints and links
///   distributed_mass(e)                           whether an element has a mass between several ports
///   count(k), writer(k, i)                        the number of items of kind k; the element that writes item i, or -1
///   freedoms(), freedom_at(f), dofs()             its degrees of freedom
template <template <class> class List, class Chain>
constexpr plan<List> arrange(const Chain& c) {
  plan<List> p;
  const auto depends = dependencies_of<List>(c);
  for (const kind k : {kind::frame_2D, kind::frame_3D})
    for (int i = 0; i < c.count(k); ++i)
      if (depends.at(k, i) == level::given) p.bases.push_back({k, i});

  std::array<List<int>, kinds> row_of;  // rows of coordinates by kind; -1: not a degree of freedom
  for (std::size_t k = 0; k < kinds; ++k) {
    if (!is_coordinate(static_cast<kind>(k))) continue;
    row_of[k].resize(static_cast<std::size_t>(c.count(static_cast<kind>(k))));
    for (std::size_t i = 0; i < row_of[k].size(); ++i) row_of[k][i] = -1;
  }
  for (std::size_t f = 0; f < c.freedoms(); ++f) {
    const freedom at = c.freedom_at(f);
    row_of[static_cast<std::size_t>(at.what)][static_cast<std::size_t>(at.slot)] = at.v;
  }
  auto& gens = row_of[static_cast<std::size_t>(kind::gen)];
  p.coordinates = c.dofs();
  for (std::size_t i = 0; i < gens.size(); ++i)
    if (gens[i] < 0) gens[i] = p.coordinates++;
  p.row_of_gen = gens;

  List<int> joints;  // by row
  joints.resize(static_cast<std::size_t>(p.coordinates));
  for (std::size_t i = 0; i < joints.size(); ++i) joints[i] = 0;
  p.joint_row.resize(c.elements());
  for (std::size_t e = 0; e < c.elements(); ++e) {
    const auto ports = c.ports(e);
    p.joint_row[e] = -1;
    p.tree &= !c.distributed_mass(e);
    if (!c.rigid(e)) {
      const port& last = ports.back();
      p.tree &= last.how != access::out || last.what != kind::gen ||
                depends.at(kind::gen, c.index(e, ports.size() - 1)) == level::given;
    } else if (ports.size() > 2) {
      for (std::size_t k = 0; is_coordinate(ports[k].what); ++k) {
        const int row = row_of[static_cast<std::size_t>(ports[k].what)][static_cast<std::size_t>(c.index(e, k))];
        if (k == 0) p.joint_row[e] = row;
        ++joints[static_cast<std::size_t>(row)];
      }
    }
  }
  for (std::size_t f = 0; f < c.freedoms(); ++f) {
    const int row = c.freedom_at(f).v;
    p.tree &= joints[static_cast<std::size_t>(row)] <= 1;
    if (joints[static_cast<std::size_t>(row)] == 0) p.jointless_dofs.push_back(row);
  }
  return p;
}

template <class T>
using growing_list = std::vector<T>;
using runtime_plan = plan<growing_list>;

}  // namespace kte::detail
