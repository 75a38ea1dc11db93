#pragma once

#include <Eigen/Core>

#include "eval/columns.hpp"
#include "mechanism.hpp"
#include "recorded_state.hpp"

namespace kte_tool {

/// Where the q and v of a table of states stand: by numbers, as `kte eval` has them (q_0, q_1, ..., v_0, ...), or by
/// the names that recordings have. What the table has not is as given: 0, or the neutral configuration.
class state_input {
 public:
  /// Throws `bad_file` where there is neither, or not all of the numbers unless some may be missing.
  state_input(const evaluate::state_table& table, const mechanism& m, const kte::runtime_chain& chain,
              bool may_miss = false)
      : table_(table) {
    const evaluate::column_order order(kte::layout(chain), coordinates_of(m, chain));
    const auto by_numbers = [&](const std::string& prefix, const std::vector<int>& places, auto& to) {
      if (may_miss) {
        for (std::size_t i = 0; i < places.size(); ++i)
          if (const auto c = table.names().find(prefix + std::to_string(i)); c != table.names().end())
            to.push_back({places[i], c->second});
        return;
      }
      const auto columns = table.columns(prefix, places.size(), false);
      for (std::size_t i = 0; i < columns.size(); ++i) to.push_back({places[i], columns[i]});
    };
    by_numbers("q_", order.q, q_), by_numbers("v_", order.v, v_);
    const recorded_state recorded(chain);
    for (const auto& c : recorded.columns()) {
      const auto found = table.names().find(c.name);
      if (c.is == recorded_column::part::other || found == table.names().end()) continue;
      auto& to = c.is == recorded_column::part::q ? q_ : v_;
      to.push_back({c.index, found->second});
    }
    if (q_.empty() && v_.empty() && chain.nq() > 0)
      throw kte::bad_file("kte: " + table.path().string() +
                          ":1: there is no column q_0 or v_0, and none of the name of a coordinate");
  }

  std::size_t rows() const { return table_.rows(); }
  bool has_v() const { return !v_.empty(); }
  /// Whether there is a column for number i of q, or of v.
  bool has_q(int i) const { return has(q_, i); }
  bool has_v(int i) const { return has(v_, i); }
  void read_q(std::size_t row, Eigen::VectorXd& q) const {
    for (const auto& x : q_) q[x.place] = table_.at(row, x.column);
  }
  void read_v(std::size_t row, Eigen::VectorXd& v) const {
    for (const auto& x : v_) v[x.place] = table_.at(row, x.column);
  }

 private:
  struct entry {
    int place;
    std::size_t column;
  };
  static bool has(const std::vector<entry>& all, int i) {
    return std::any_of(all.begin(), all.end(), [i](const auto& x) { return x.place == i; });
  }
  const evaluate::state_table& table_;
  std::vector<entry> q_, v_;
};

}  // namespace kte_tool
