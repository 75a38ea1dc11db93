#pragma once

#include <kte/static_chain/layout.hpp>

#include <string_view>
#include <unordered_map>

#include "eval/states.hpp"

namespace evaluate {

/// Where the numbers of the table's columns stand in the chain's vectors: q_i is number q[i] of q, v_i number v[i] of
/// v. Columns go by coordinates in the order of the file; of a rotation they have x, y, z before w.
struct column_order {
  std::vector<int> q, v;

  template <class Layout>
  column_order(const Layout& layout, const std::vector<std::string>& coordinates) {
    std::unordered_map<std::string_view, std::size_t> known;
    for (std::size_t i = 0; i < layout.size(); ++i) known.emplace(layout[i].name, i);
    for (const auto& name : coordinates)
      if (const auto at = known.find(name); at != known.end()) {
        const auto& e = layout[at->second];
        add(e.what, e.q, e.nq, e.v, e.nv);
      }
  }

 private:
  void add(kte::kind what, int first_q, int nq, int first_v, int nv) {
    const bool turns = what == kte::kind::rotation_3D || what == kte::kind::pose_3D;
    const int before = turns ? nq - 4 : nq;  // numbers in front of the quaternion
    for (int i = 0; i < before; ++i) q.push_back(first_q + i);
    if (turns)
      for (const int i : {1, 2, 3, 0}) q.push_back(first_q + before + i);
    for (int i = 0; i < nv; ++i) v.push_back(first_v + i);
  }
};

/// The states of a table in the order of a chain.
class state_columns {
 public:
  /// Columns of a and tau may be missing unless they are needed.
  state_columns(const state_table& t, const column_order& order, bool needs_a = false, bool needs_tau = false)
      : table_(t),
        order_(order),
        q_(t.columns("q_", order.q.size(), true)),
        v_(t.columns("v_", order.v.size(), true)),
        a_(t.columns("a_", order.v.size(), needs_a)),
        tau_(t.columns("tau_", order.v.size(), needs_tau)) {}

  bool has_a() const { return !a_.empty(); }
  bool has_tau() const { return !tau_.empty(); }
  template <class S>
  std::vector<S> q(std::size_t row) const {
    return read<S>(row, q_, order_.q);
  }
  template <class S>
  std::vector<S> v(std::size_t row) const {
    return read<S>(row, v_, order_.v);
  }
  template <class S>
  std::vector<S> a(std::size_t row) const {
    return read<S>(row, a_, order_.v);
  }
  template <class S>
  std::vector<S> tau(std::size_t row) const {
    return read<S>(row, tau_, order_.v);
  }

 private:
  template <class S>
  std::vector<S> read(std::size_t row, const std::vector<std::size_t>& columns, const std::vector<int>& to) const {
    std::vector<S> x(columns.size());
    for (std::size_t i = 0; i < columns.size(); ++i) x[static_cast<std::size_t>(to[i])] = S(table_.at(row, columns[i]));
    return x;
  }

  const state_table& table_;
  const column_order& order_;
  std::vector<std::size_t> q_, v_, a_, tau_;
};

}  // namespace evaluate
