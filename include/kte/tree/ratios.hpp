#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace kte::tree {

/// The rates of all coordinates as functions of the degrees of freedom, by the non-zero rows of J:
///
///   q_i' = sum_d J_id v_d + (prescribed motions)          (1)
///
/// The row of a degree of freedom has one entry, that of a prescribed coordinate none.
template <class S>
class ratios {
 public:
  struct entry {
    int dof;
    S ratio;
  };

  void clear() { steps_.clear(); }
  /// The rate of coordinate `from` includes `ratio` times that of `to`. Add followers from the last on, with all steps
  /// of a follower together.
  void add(int to, int from, const S& ratio) { steps_.push_back({to, from, ratio}); }
  /// Whether no coordinate follows another.
  bool empty() const { return steps_.empty(); }
  /// Computes the rows from the steps.
  void finish(int dofs, int coordinates) {
    rows_.assign(static_cast<std::size_t>(coordinates), {});
    place_.resize(static_cast<std::size_t>(dofs));
    entries_.clear();
    for (int d = 0; d < dofs; ++d) {
      rows_[static_cast<std::size_t>(d)] = {entries_.size(), entries_.size() + 1};
      entries_.push_back({d, S(1)});
    }
    for (auto step = steps_.rbegin(); step != steps_.rend(); ++step) {
      const row followed = rows_[static_cast<std::size_t>(step->to)];
      row& own = rows_[static_cast<std::size_t>(step->from)];
      if (own.first == own.last) own.first = entries_.size();
      for (std::size_t k = followed.first; k < followed.last; ++k) {
        const entry x{entries_[k].dof, step->ratio * entries_[k].ratio};
        std::size_t& at = place_[static_cast<std::size_t>(x.dof)];
        if (at >= own.first && at < entries_.size() && entries_[at].dof == x.dof) {
          entries_[at].ratio += x.ratio;
        } else {
          at = entries_.size();
          entries_.push_back(x);
        }
      }
      own.last = entries_.size();
    }
  }
  /// (A span would instantiate 200 more templates.)
  struct range {
    const entry *first, *last;
    const entry* begin() const { return first; }
    const entry* end() const { return last; }
    std::size_t size() const { return static_cast<std::size_t>(last - first); }
  };
  range of(int coordinate) const {
    const row& x = rows_[static_cast<std::size_t>(coordinate)];
    return {entries_.data() + x.first, entries_.data() + x.last};
  }

 private:
  struct following {
    int to, from;
    S ratio;
  };
  struct row {
    std::size_t first = 0, last = 0;
  };
  std::vector<following> steps_;
  std::vector<entry> entries_;
  std::vector<row> rows_;           ///< of coordinates
  std::vector<std::size_t> place_;  ///< position of the entry of a degree of freedom in the current row, if it has one
};

}  // namespace kte::tree
