#pragma once

#include <kte/sweep/sweep_cases.hpp>
#include <kte/sweep/sweep_results.hpp>

#include <string>
#include <vector>

namespace kte::detail {

/// Writes rows of results to a table in the order of the cases, and gathers statistics.
template <class Table>
class row_merger {
 public:
  row_merger(const sweep_cases& cases, const std::vector<std::string>& kept, Table& out) : cases_(cases), out_(out) {
    for (const auto& name : kept) summary_.statistics.emplace_back().name = name;
  }
  void add(const sweep_rows& rows) {
    const std::size_t varied = cases_.names().size();
    row_.resize(varied + rows.columns + 2);
    auto failure = rows.failures.begin();
    for (std::uint64_t k = 0; k < rows.count(); ++k) {
      const std::uint64_t i = rows.begin + k;
      const bool failed = failure != rows.failures.end() && failure->index == i;
      if (failed) ++failure;
      row_.front() = static_cast<double>(i), row_.back() = failed ? 1 : 0;
      for (std::size_t j = 0; j < varied; ++j) row_[1 + j] = cases_(i, j);
      for (std::size_t j = 0; j < rows.columns; ++j) {
        const double x = rows.numbers[static_cast<std::size_t>(k) * rows.columns + j];
        row_[1 + varied + j] = x;
        summary_.statistics[j].add(x);
      }
      out_.row(row_);
    }
    summary_.cases += rows.count(), summary_.failed += rows.failures.size();
  }
  [[nodiscard]] const sweep_summary& summary() const { return summary_; }

 private:
  const sweep_cases& cases_;
  Table& out_;
  std::vector<double> row_;
  sweep_summary summary_;
};
template <class Table>
row_merger(const sweep_cases&, const std::vector<std::string>&, Table&) -> row_merger<Table>;

}  // namespace kte::detail
