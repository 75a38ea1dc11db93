#pragma once

#include <algorithm>
#include <cstdio>
#include <ctime>

#include "scenes.hpp"

namespace contact_bench {

/// The least CPU time of some calls of run(), s.
template <class F>
double fastest(int times, const F& run) {
  double least = 1e300;
  for (int i = 0; i < times; ++i) {
    const std::clock_t begin = std::clock();
    run();
    least = std::min(least, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  return least;
}
inline std::string text_of(double x, const char* format = "%.0e") {
  char text[32];
  std::snprintf(text, sizeof text, format, x);
  return text;
}

}  // namespace contact_bench
