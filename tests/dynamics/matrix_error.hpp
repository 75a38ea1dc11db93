#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace kte::test {

/// max |x - reference| / max |reference| over a matrix by rows; infinite if an x is NaN.
template <class X>
long double error_of(const X& x, const long double* reference) {
  long double difference = 0, size = 0;
  for (Eigen::Index i = 0; i < x.rows(); ++i)
    for (Eigen::Index j = 0; j < x.cols(); ++j) {
      const long double y = reference[i * x.cols() + j];
      const auto d = std::fabs(static_cast<long double>(x(i, j)) - y);
      difference = d == d ? std::max(difference, d) : HUGE_VALL;
      size = std::max(size, std::fabs(y));
    }
  return difference / size;
}

}  // namespace kte::test
