#pragma once

#include <kte/contact/detail/eliminate.hpp>

#include <algorithm>
#include <vector>

namespace kte::detail {

/// The limit of (A + eps I)^-1 c for eps -> 0, of a singular matrix A with c in its range: A x = c, L^T x = 0, L: the
/// left null space of A. For symmetric A: x of least norm.
template <class S>
class singular_limit {
 public:
  /// A and c as for `eliminate`, which are replaced; c becomes x. False if A has full rank, or c is not in its range.
  bool solve(S* A, Eigen::Index n, Eigen::Index stride) {
    using row = Eigen::Map<Eigen::Matrix<S, 1, Eigen::Dynamic>>;
    using std::abs;
    const Eigen::Index width = 2 * n + 1;  // rows (A, c, E), with E the row operations
    work_.assign(static_cast<std::size_t>(n * width), S(0));
    for (Eigen::Index i = 0; i < n; ++i) {
      std::copy_n(A + i * stride, n + 1, &at(i, 0, width));
      at(i, n + 1 + i, width) = S(1);
    }
    Eigen::Index rank = 0;
    S first(0);
    for (; rank < n; ++rank) {
      Eigen::Index pivot = rank, column = 0;
      S largest(0);
      for (Eigen::Index i = rank; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j)
          if (const S size = abs(at(i, j, width)); size > largest) largest = size, pivot = i, column = j;
      if (rank == 0) first = largest;
      if (!(largest > S(1e-11) * first)) break;
      if (pivot != rank) row(&at(pivot, 0, width), width).swap(row(&at(rank, 0, width), width));
      for (Eigen::Index i = rank + 1; i < n; ++i) {
        const S factor = at(i, column, width) / at(rank, column, width);
        row(&at(i, 0, width), width) -= factor * row(&at(rank, 0, width), width);
        at(i, column, width) = S(0);
      }
    }
    if (rank == n) return false;
    S size(0);
    for (Eigen::Index i = 0; i < n; ++i) size = (std::max<S>)(size, abs(A[i * stride + n]));
    for (Eigen::Index i = 0; i < rank; ++i) std::copy_n(&at(i, 0, width), n + 1, A + i * stride);
    for (Eigen::Index i = rank; i < n; ++i) {
      if (!(abs(at(i, n, width)) <= S(1e-9) * size)) return false;
      for (Eigen::Index j = 0; j < n; ++j) A[i * stride + j] = first * at(i, n + 1 + j, width);
      A[i * stride + n] = S(0);
    }
    return eliminate(A, n, stride) > S(0);
  }

 private:
  S& at(Eigen::Index i, Eigen::Index j, Eigen::Index width) { return work_[static_cast<std::size_t>(i * width + j)]; }

  std::vector<S> work_;
};

}  // namespace kte::detail
