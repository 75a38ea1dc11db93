#pragma once

#include <kte/detail/inline.hpp>

#include <Eigen/Core>

#include <limits>

namespace kte::detail {

/// The inverse of a matrix that need not be symmetric, by Gauss-Jordan elimination with row pivoting (Golub and Van
/// Loan, Matrix Computations, 3.4); m is used up. Returns whether no pivot vanishes against the largest number of m.
template <class Matrix>
bool invert_general(Matrix& m, Matrix& inverse) {
  using S = typename Matrix::Scalar;
  using std::abs;
  const Eigen::Index n = m.rows();
  inverse.setIdentity(n, n);
  S size(0);
  for (Eigen::Index i = 0; i < m.size(); ++i)
    if (const S x = abs(m.data()[i]); !(x <= size)) size = x;
  const S least = S(n) * S(std::numeric_limits<S>::epsilon()) * size;
  for (Eigen::Index k = 0; k < n; ++k) {
    Eigen::Index pivot = k;
    for (Eigen::Index i = k + 1; i < n; ++i)
      if (abs(m(i, k)) > abs(m(pivot, k))) pivot = i;
    if (!(abs(m(pivot, k)) > least)) return false;
    if (pivot != k) m.row(k).swap(m.row(pivot)), inverse.row(k).swap(inverse.row(pivot));
    const S by = S(1) / m(k, k);
    m.row(k) *= by, inverse.row(k) *= by;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (i == k) continue;
      const S share = m(i, k);
      m.row(i) -= share * m.row(k), inverse.row(i) -= share * inverse.row(k);
    }
  }
  return true;
}

}  // namespace kte::detail
