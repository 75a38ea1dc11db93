#pragma once

#include "catch.hpp"
#include "digits50.hpp"

namespace kte::test {

/// A vector at 50 digits.
template <int N>
joint_vector<digits50, N> at_50_digits(const joint_vector<double, N>& x) {
  return x.template cast<digits50>();
}
/// max |x - exact| / max |exact| of a vector or matrix.
template <class X, class Exact>
double error_of_double(const X& x, const Exact& exact) {
  digits50 difference = 0, size = 0;
  for (Eigen::Index i = 0; i < exact.size(); ++i) {
    difference = worse(difference, digits50(abs(digits50(x.data()[i]) - exact.data()[i])));
    size = std::max(size, digits50(abs(exact.data()[i])));
  }
  return static_cast<double>(difference / size);
}

}  // namespace kte::test
