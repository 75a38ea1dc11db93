#pragma once

#include <Eigen/Core>

#include <cmath>
#include <limits>

namespace kte::detail {

/// Solves A x = c in place: Gaussian elimination with partial pivoting, four columns at a time. A has rows of `stride`
/// numbers, a multiple of 4 above n, with c in column n, which becomes x. Returns the smallest pivot; 0 without a
/// solution.
template <class S>
S eliminate(S* A, Eigen::Index n, Eigen::Index stride) {
  using four = Eigen::Map<Eigen::Array<S, 4, 1>>;
  using std::abs;
  const Eigen::Index blocks = n / 4 + 1;
  S smallest = (std::numeric_limits<S>::max)();
  for (Eigen::Index k = 0; k < n; ++k) {
    Eigen::Index pivot = k;
    S largest = abs(A[k * stride + k]);
    for (Eigen::Index i = k + 1; i < n; ++i)
      if (const S size = abs(A[i * stride + k]); size > largest) largest = size, pivot = i;
    if (!(largest > S(0)) || !(largest - largest == S(0))) return S(0);
    if (largest < smallest) smallest = largest;
    S* const top = A + k * stride;
    if (pivot != k) {
      S* const other = A + pivot * stride;
      for (Eigen::Index j = k / 4; j < blocks; ++j) {
        const Eigen::Array<S, 4, 1> kept = four(top + 4 * j);
        four(top + 4 * j) = four(other + 4 * j);
        four(other + 4 * j) = kept;
      }
    }
    const S inverse = S(1) / top[k];
    for (Eigen::Index i = k + 1; i < n; ++i) {
      S* const row = A + i * stride;
      if (row[k] == S(0)) continue;
      const S factor = row[k] * inverse;
      for (Eigen::Index j = (k + 1) / 4; j < blocks; ++j) four(row + 4 * j) -= factor * four(top + 4 * j);
    }
  }
  for (Eigen::Index k = n - 1; k >= 0; --k) {
    S sum = A[k * stride + n];
    for (Eigen::Index j = k + 1; j < n; ++j) sum -= A[k * stride + j] * A[j * stride + n];
    A[k * stride + n] = sum / A[k * stride + k];
  }
  return smallest;
}

}  // namespace kte::detail
