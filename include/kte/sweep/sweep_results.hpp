#pragma once

#include <kte/io/table.hpp>
#include <kte/sweep/detail/sweep_rows.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace kte {

/// Statistics of a kept column over the cases in which it is a number. Mean and variance are updated in the order of
/// the cases (Welford, Technometrics 4 (1962)), so that they do not depend on threads.
struct column_statistics {
  std::string name;                                         ///< of the column
  std::uint64_t count = 0;                                  ///< cases with a number
  double least = std::numeric_limits<double>::quiet_NaN();  ///< the smallest number; NaN if there is none
  double most = least;                                      ///< the largest number
  double mean = least;                                      ///< of the numbers
  double squares = 0;                                       ///< the sum of the squared deviations from the mean

  /// The standard deviation of a sample: sqrt(squares / (count - 1)).
  [[nodiscard]] double deviation() const { return count > 1 ? std::sqrt(squares / static_cast<double>(count - 1)) : 0; }
  /// Adds a number; NaN is left out.
  void add(double x) {
    if (x != x) return;
    ++count;
    if (!(least <= x)) least = x;
    if (!(most >= x)) most = x;
    const double d = count == 1 ? 0 : x - mean;
    mean = count == 1 ? x : mean + d / static_cast<double>(count);
    squares += d * (x - mean);
  }
};

/// What a sweep has done.
struct sweep_summary {
  std::uint64_t cases = 0;                    ///< all cases
  std::uint64_t failed = 0;                   ///< cases without a result
  std::vector<column_statistics> statistics;  ///< of the kept columns
};

/// The results of a sweep in memory: a row for each case, in order. Columns: `case`, the columns of the cases, the kept
/// ones, and `failed`, 0 or 1.
struct sweep_table {
  kte::table rows;                      ///< a row for each case
  std::vector<sweep_failure> failures;  ///< cases without a result, and why
  sweep_summary summary;                ///< counts and statistics

  /// A column. Throws `unknown_name`.
  [[nodiscard]] const std::vector<double>& operator[](std::string_view name) const { return rows[name]; }
};

}  // namespace kte
