#pragma once

#include <cstddef>

#include "problem.hpp"

namespace work_precision {

/// Seconds of CPU time that this thread has used.
double cpu_seconds();

/// An integration by a contender.
struct row {
  contender* by;
  double setting;      ///< step, s, or tolerance
  judgement how_good;  ///< of its end
  kte::step_statistics cost;
  std::string failure;            ///< what it stopped for, or empty
  std::vector<double> seconds{};  ///< of repetitions

  double median_seconds() const;
};

/// How far contenders go.
struct effort {
  bool quick;      ///< one integration each
  double longest;  ///< s of CPU time; integrations that would take longer are left out
};

/// Integrates with finer and finer settings, until that takes too long or helps no more. Each time is the median of up
/// to seven, between which all others are timed.
std::vector<row> measure(const problem& p, const effort& e);

}  // namespace work_precision
