#pragma once

#include <Eigen/Core>

#include <algorithm>

#include "eval/states.hpp"

namespace kte_tool {

/// Rows of numbers over time, linear in between; before the first and after the last they stay. A table of one row
/// needs no time.
class time_table {
 public:
  time_table() = default;
  /// read(row, values) puts in the numbers of a row. Throws `bad_file` without a column t, or where that does not grow.
  template <class Read>
  time_table(const evaluate::state_table& table, Eigen::Index count, const Read& read) {
    if (table.rows() == 0) throw kte::bad_file("kte: " + table.path().string() + ": has no row of numbers");
    const auto t = table.names().find("t");
    if (t == table.names().end() && table.rows() > 1)
      throw kte::bad_file("kte: " + table.path().string() + ":1: several rows need a column t");
    for (std::size_t i = 0; i < table.rows(); ++i) {
      const double time = t == table.names().end() ? 0 : table.at(i, t->second);
      if (i > 0 && !(time > times_.back()))
        throw kte::bad_file("kte: " + table.place(i) + "t must grow from row to row");
      times_.push_back(time);
      Eigen::VectorXd x = Eigen::VectorXd::Zero(count);
      read(i, x);
      rows_.push_back(std::move(x));
    }
  }

  bool empty() const { return times_.empty(); }
  /// Values at t, and their rates.
  void at(double t, Eigen::VectorXd& x, Eigen::VectorXd& rate) const {
    const auto next = static_cast<std::size_t>(std::upper_bound(times_.begin(), times_.end(), t) - times_.begin());
    if (next == 0 || next == times_.size()) {
      x = rows_[next == 0 ? 0 : next - 1];
      rate.setZero(x.size());
      return;
    }
    const double h = times_[next] - times_[next - 1];
    rate = (rows_[next] - rows_[next - 1]) / h;
    x = rows_[next - 1] + (t - times_[next - 1]) * rate;
  }

 private:
  std::vector<double> times_;
  std::vector<Eigen::VectorXd> rows_;
};

}  // namespace kte_tool
