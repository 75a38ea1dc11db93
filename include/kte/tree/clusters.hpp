#pragma once

#include <kte/contract/freedom.hpp>
#include <kte/tree/body_node.hpp>

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

/// Clusters: coordinates that follow each other, and the bodies that they move.
namespace kte::tree {

/// Linked coordinates, and all joints between their bodies and the body that these have in common: a joint that moves
/// several bodies.
struct cluster {
  int base = 0;            ///< the slot that all its bodies stand on
  int first_node = -1;     ///< the first of its body nodes; -1: its coordinates move no joint
  std::vector<int> dofs;   ///< its degrees of freedom, rows
  std::vector<int> rows;   ///< all its coordinates
  std::size_t column = 0;  ///< place of its degrees of freedom among those of all clusters
  std::size_t square = 0;  ///< place of a matrix of them
};
/// A body node in a cluster. Wrenches are one for each degree of freedom of the cluster.
struct cluster_node {
  int cluster = -1;         ///< -1: in none
  bool first = false;       ///< the first body node of the cluster
  std::size_t columns = 0;  ///< the place of its wrenches; those of a cluster, U, are at `cluster::column`
  std::size_t to = 0;       ///< the place of the wrenches of what it stands on
};
/// An element that writes a coordinate of a cluster.
struct cluster_follower {
  int element = 0;
  int written = -1;    ///< the coordinate; -1: it writes none
  int row = -1;        ///< the row of this coordinate
  bool alone = false;  ///< whether its motion depends on one coordinate only
  struct followed {
    std::size_t port;
    int coordinate, row;
  };
  std::vector<followed> followed;
};
struct cluster_layout {
  std::vector<cluster> clusters;
  std::vector<cluster_node> nodes;          ///< by body node
  std::vector<cluster_follower> followers;  ///< in order
  std::vector<int> of_row;                  ///< coordinates: the cluster, or -1
  std::vector<std::size_t> rates;  ///< coordinates: the place of their rates by the degrees of freedom of the cluster
  std::vector<int> place;          ///< degrees of freedom: the number in the cluster
  std::size_t all_columns = 0, all_rates = 0, all_dofs = 0, all_squares = 0;
  /// Whether all coordinates that follow others are in clusters.
  bool complete = false;

  bool has(int node) const { return complete && nodes[static_cast<std::size_t>(node)].cluster >= 0; }
  const cluster& of(const cluster_node& x) const { return clusters[static_cast<std::size_t>(x.cluster)]; }
};

/// Sets of numbers.
class disjoint_sets {
 public:
  explicit disjoint_sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  int of(int i) {
    int& p = parent_[static_cast<std::size_t>(i)];
    return p == i ? i : p = of(p);
  }
  /// Makes one of both sets; says whether they were two.
  bool unite(int i, int k) {
    i = of(i), k = of(k);
    parent_[static_cast<std::size_t>((std::max)(i, k))] = (std::min)(i, k);
    return i != k;
  }

 private:
  std::vector<int> parent_;
};

/// The clusters of a chain of `coordinates`, degrees of freedom first. `links`: pairs of rows, one follows the other.
template <class P>
cluster_layout clusters_of(const body_tree<P>& f, int coordinates, int dofs,
                           std::span<const std::pair<int, int>> links) {
  const auto at = [](auto& list, auto i) -> auto& { return list[static_cast<std::size_t>(i)]; };
  const auto count = static_cast<std::size_t>(coordinates);
  const int nodes = static_cast<int>(f.nodes.size());
  disjoint_sets sets(count);
  std::vector<char> linked(count, 0), moves(count, 0);
  for (const auto& [a, b] : links) sets.unite(a, b), at(linked, a) = at(linked, b) = 1;
  const auto row_of = [&](int node) { return at(f.row, at(f.nodes, node).first); };
  for (int i = 0; i < nodes; ++i)
    for (int k = at(f.nodes, i).first; k < at(f.nodes, i).first + at(f.nodes, i).axes; ++k) {
      sets.unite(row_of(i), at(f.row, k));
      if (std::exchange(at(moves, at(f.row, k)), 1)) at(linked, at(f.row, k)) = 1;  // a coordinate of two joints
    }
  const auto mark = [&] {  // whole sets
    std::vector<char> in(count, 0);
    for (int r = 0; r < coordinates; ++r) at(in, sets.of(r)) |= at(linked, r);
    for (int r = 0; r < coordinates; ++r) at(linked, r) = at(in, sets.of(r));
  };
  mark();
  cluster_layout x;
  std::vector<int> base(count, -1);  // of sets
  for (bool grown = true; grown; mark()) {
    grown = false;
    std::fill(base.begin(), base.end(), -1);
    for (int i = 0; i < nodes; ++i) {
      if (!at(linked, row_of(i))) continue;
      int& of_set = at(base, sets.of(row_of(i)));
      const int parent = at(f.nodes, i).parent;
      of_set = of_set < 0 ? parent : common_slot(f, parent, of_set);
      if (of_set < 0) return x;  // on two bases
    }
    for (int i = 0; i < nodes && !grown; ++i) {
      if (!at(linked, row_of(i))) continue;
      const int end = at(base, sets.of(row_of(i)));
      for (int p = at(f.nodes, i).parent; p != end; p = at(f.nodes, p - f.bases).parent)
        grown |= sets.unite(row_of(i), row_of(p - f.bases));
      if (grown) at(linked, row_of(i)) = 1;
    }
  }
  x.of_row.assign(count, -1), x.rates.assign(count, 0), x.nodes.assign(f.nodes.size(), {});
  x.place.assign(static_cast<std::size_t>(dofs), -1);
  std::vector<int> number(count, -1);  // of sets
  for (int r = 0; r < coordinates; ++r) {
    if (!at(linked, r)) continue;
    int& n = at(number, sets.of(r));
    if (n < 0) {
      n = static_cast<int>(x.clusters.size());
      x.clusters.emplace_back().base = at(base, sets.of(r));
    }
    at(x.of_row, r) = n;
    cluster& c = at(x.clusters, n);
    c.rows.push_back(r);
    if (r >= dofs) continue;
    at(x.place, r) = static_cast<int>(c.dofs.size());
    c.dofs.push_back(r);
  }
  for (cluster& c : x.clusters) {
    c.column = x.all_dofs, c.square = x.all_squares;
    x.all_dofs += c.dofs.size(), x.all_squares += c.dofs.size() * c.dofs.size();
    for (const int r : c.rows) at(x.rates, r) = std::exchange(x.all_rates, x.all_rates + c.dofs.size());
  }
  x.all_columns = x.all_dofs;
  for (int i = 0; i < nodes; ++i) {
    const int n = at(x.of_row, row_of(i));
    if (n < 0) continue;
    cluster& c = at(x.clusters, n);
    const int parent = at(f.nodes, i).parent;
    at(x.nodes, i) = {n, c.first_node < 0, x.all_columns,
                      parent == c.base ? c.column : at(x.nodes, parent - f.bases).columns};
    x.all_columns += c.dofs.size();
    if (c.first_node < 0) c.first_node = i;
  }
  x.complete = true;
  return x;
}

}  // namespace kte::tree
