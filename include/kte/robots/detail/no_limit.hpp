#pragma once

#include <cmath>
#include <limits>

namespace kte::detail {

/// The number for "no limit" in formats that have no keyword for it and whose readers reject "inf".
inline constexpr double most_in_file = 1e308;

inline double limit_in_file(double x) { return std::abs(x) > most_in_file ? std::copysign(most_in_file, x) : x; }
/// The limit for a number in a file: infinite from `most_in_file` on.
inline double limit_from_file(double x) {
  return std::abs(x) >= most_in_file ? std::copysign(std::numeric_limits<double>::infinity(), x) : x;
}

}  // namespace kte::detail
