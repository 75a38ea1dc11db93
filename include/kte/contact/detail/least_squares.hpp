#pragma once

#include <Eigen/LU>
#include <Eigen/QR>

#include <limits>

namespace kte::detail {

/// Matrices of at most R x C, and vectors, on the stack.
template <class S, int R, int C>
using small_matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic, 0, R, C>;
template <class S, int R>
using small_vector = Eigen::Matrix<S, Eigen::Dynamic, 1, 0, R, 1>;

/// The a >= 0 that minimizes |A G a - c|^2 + d^2 |G a|^2 with a small d (Lawson and Hanson, Solving least squares problems,
/// 1974, chapter 23): of all G a >= 0 with A G a = c the one of least norm. At most 6 unknowns.
template <class S>
small_vector<S, 6> nonnegative_least_squares(const small_matrix<S, 6, 6>& A, const small_matrix<S, 6, 6>& G,
                                             const small_vector<S, 6>& c) {
  using std::sqrt;
  const Eigen::Index n = A.rows(), m = G.cols();
  const S d = S(10) * sqrt(std::numeric_limits<S>::epsilon()) * A.norm();
  small_matrix<S, 12, 6> B(2 * n, m);
  B << A * G, d * G;
  small_vector<S, 12> right = small_vector<S, 12>::Zero(2 * n);
  right.head(n) = c;
  small_vector<S, 6> a = small_vector<S, 6>::Zero(m);
  bool active[6]{};
  for (int round = 0; round < 40; ++round) {
    const small_vector<S, 6> w = B.transpose() * (right - B * a);
    int enter = -1;
    const S least = std::numeric_limits<S>::epsilon() * S(100) * B.norm() * right.norm();
    for (int j = 0; j < m; ++j)
      if (!active[j] && w[j] > least && (enter < 0 || w[j] > w[enter])) enter = j;
    if (enter < 0) break;
    active[enter] = true;
    for (int inner = 0; inner < 12; ++inner) {
      small_matrix<S, 12, 6> P(2 * n, m);
      int columns = 0;
      for (int j = 0; j < m; ++j)
        if (active[j]) P.col(columns++) = B.col(j);
      const small_matrix<S, 12, 6> used = P.leftCols(columns);
      const small_vector<S, 6> z = used.colPivHouseholderQr().solve(right);
      S step(1);
      int blocking = -1;
      for (int j = 0, k = 0; j < m; ++j) {
        if (!active[j]) continue;
        if (z[k] <= S(0) && a[j] - z[k] > S(0) && a[j] / (a[j] - z[k]) < step) step = a[j] / (a[j] - z[k]), blocking = j;
        ++k;
      }
      for (int j = 0, k = 0; j < m; ++j)
        if (active[j]) a[j] += step * (z[k++] - a[j]);
      if (blocking < 0) break;
      a[blocking] = S(0), active[blocking] = false;
    }
  }
  return a;
}

}  // namespace kte::detail
