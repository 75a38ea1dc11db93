#pragma once

#include <cmath>
#include <limits>

namespace kte::detail {

/// What stands for no limit in files of formats that have no word for it, and are read by programs that take no "inf".
inline constexpr double most_in_file = 1e308;

inline double limit_in_file(double x) { return std::abs(x) > most_in_file ? std::copysign(most_in_file, x) : x; }
/// The reverse.
inline double limit_from_file(double x) {
  return std::abs(x) >= most_in_file ? std::copysign(std::numeric_limits<double>::infinity(), x) : x;
}

}  // namespace kte::detail
