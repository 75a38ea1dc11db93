#pragma once

#include <kte/detail/inline.hpp>

#include <Eigen/Core>

namespace kte::detail {

/// The sum of the numbers of a column by packets of four, which clang++ does not generate for `sum_by_four`. Eigen's
/// own sum causes warnings of g++ 12 in Eigen's headers for AVX-512.
template <class E>
KTE_INLINE typename E::Scalar sum_by_packets(const Eigen::DenseBase<E>& column) {
  using S = typename E::Scalar;
  const E& x = column.derived();
  const Eigen::Index n = x.size(), whole = n - n % 4;
  Eigen::Array<S, 4, 1> sums = Eigen::Array<S, 4, 1>::Zero();
  for (Eigen::Index i = 0; i < whole; i += 4) sums += x.template segment<4>(i).array();
  for (Eigen::Index i = whole; i < n; ++i) sums[0] += x.coeff(i);
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

}  // namespace kte::detail
