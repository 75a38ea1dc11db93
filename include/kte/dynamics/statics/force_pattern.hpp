#pragma once

#include <kte/dynamics/runtime/elements.hpp>

#include <algorithm>
#include <numeric>
#include <vector>

/// The sparsity of derivatives of forces of a runtime chain, from its wiring: which degrees of freedom affect the
/// forces on which.
namespace kte::detail {

/// The coordinates between a body and the base move the body, and its weight acts on all of them. A force between two
/// frames acts on the coordinates of both. The pattern is therefore symmetric, a union of cliques. Columns of one
/// colour have no row in common, so one direction gives the derivatives by all of them (Curtis, Powell, Reid, J. Inst.
/// Maths Applics 13, 1974). A row of beams needs three colours per degree of freedom of a node, for any length.
struct force_pattern {
  std::vector<std::vector<int>> rows;  ///< of each column, in order
  std::vector<int> colour;             ///< of each column
  int colours = 0;

  int size() const { return static_cast<int>(rows.size()); }
};

/// The cliques of a chain, each sorted. A single clique with all coordinates means that nothing more is known.
class force_cliques {
 public:
  force_cliques(const runtime_chain& c, const runtime_state& s) : chain_{c}, state_(s) {
    const auto& t = s.tree();
    if (!t.followers.empty() || !t.late.empty() || !t.readers.empty()) {
      std::vector<int> every(static_cast<std::size_t>(s.dofs()));
      std::iota(every.begin(), every.end(), 0);
      all.push_back(std::move(every));
      return;
    }
    for (std::size_t i = 0; i < t.body_tree.nodes.size(); ++i) {
      add_way(t.body_tree.bases + static_cast<int>(i));
      finish();
    }
    for (const auto* list : {&t.on_frames, &t.on_coordinates})
      for (const int e : *list) {
        for (std::size_t p = 0; p < chain_.ports(e).size(); ++p) add_port(chain_.ports(e)[p].what, chain_.index(e, p));
        finish();
      }
  }
  std::vector<std::vector<int>> all;

 private:
  void add_way(int slot) {
    const auto& f = state_.tree().body_tree;
    while (slot >= f.bases) {
      const auto& r = f.nodes[static_cast<std::size_t>(slot - f.bases)];
      for (int k = r.first; k < r.first + r.axes; ++k)
        if (const int row = f.row[static_cast<std::size_t>(k)]; row < state_.dofs()) rows_.push_back(row);
      slot = r.parent;
    }
  }
  void add_port(kind k, int index) {
    if (is_frame(k)) add_way(state_.tree().body_tree.frame(k, index).slot);
    if (!is_coordinate(k)) return;
    for (const freedom& f : state_.freedoms())
      if (f.what == k && f.slot == index)
        for (int i = 0; i < nv_of(k); ++i) rows_.push_back(f.v + i);
  }
  void finish() {
    std::sort(rows_.begin(), rows_.end());
    rows_.erase(std::unique(rows_.begin(), rows_.end()), rows_.end());
    if (!rows_.empty()) all.push_back(std::move(rows_));
    rows_.clear();
  }

  runtime_elements chain_;
  const runtime_state& state_;
  std::vector<int> rows_;
};

inline force_pattern pattern_of_forces(const runtime_chain& c, const runtime_state& s) {
  const auto n = static_cast<std::size_t>(s.dofs());
  const auto cliques = force_cliques(c, s).all;
  force_pattern x;
  x.rows.resize(n), x.colour.assign(n, -1);
  const auto full = std::find_if(cliques.begin(), cliques.end(), [n](const auto& one) { return one.size() == n; });
  if (full != cliques.end()) {
    for (auto& rows : x.rows) rows = *full;
    std::iota(x.colour.begin(), x.colour.end(), 0);
    x.colours = s.dofs();
    return x;
  }
  for (std::size_t j = 0; j < n; ++j) x.rows[j].push_back(static_cast<int>(j));
  for (const auto& one : cliques)
    for (const int j : one) {
      auto& rows = x.rows[static_cast<std::size_t>(j)];
      rows.insert(rows.end(), one.begin(), one.end());
    }
  for (auto& rows : x.rows) {
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  }
  std::vector<int> taken(n, -1);  // by colour: the last column that it is excluded for
  for (std::size_t j = 0; j < n; ++j) {
    for (const int i : x.rows[j])
      for (const int k : x.rows[static_cast<std::size_t>(i)])
        if (const int other = x.colour[static_cast<std::size_t>(k)]; other >= 0)
          taken[static_cast<std::size_t>(other)] = static_cast<int>(j);
    int& mine = x.colour[j];
    for (mine = 0; taken[static_cast<std::size_t>(mine)] == static_cast<int>(j);) ++mine;
    x.colours = (std::max)(x.colours, mine + 1);
  }
  return x;
}

}  // namespace kte::detail
