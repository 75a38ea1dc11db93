#pragma once

#include <kte/math/matrix.hpp>

#include <algorithm>
#include <array>

namespace kte {

namespace detail {
/// The square root of a number >= 1 by Newton's iteration, which comes down to it from above; std::sqrt is not
/// constexpr.
constexpr double constexpr_sqrt(double x) {
  double root = x;
  for (double next = (root + 1) / 2; next < root; next = (root + x / root) / 2) root = next;
  return root;
}
}  // namespace detail

/// The eigenvalues of a symmetric matrix, in descending order, to a few rounding errors of the matrix, which must be
/// finite. By Jacobi rotations (Golub and Van Loan, Matrix Computations, 8.5). A rotation by phi in the plane of axes p
/// and q makes a_pq zero if
///
///   t = tan phi = sign(k)/(|k| + sqrt(k^2 + 1)),   k = (a_qq - a_pp)/(2 a_pq)          (1)
///   a_pp -= t a_pq,   a_qq += t a_pq                                                   (2)
[[nodiscard]] constexpr std::array<double, 3> principal_moments(const sym3<>& m) {
  std::array<std::array<double, 3>, 3> a{{{m.xx, m.xy, m.xz}, {m.xy, m.yy, m.yz}, {m.xz, m.yz, m.zz}}};
  for (int sweep = 0; sweep < 10; ++sweep)  // five are enough: convergence is quadratic
    for (std::size_t r = 0; r < 3; ++r) {
      const std::size_t p = (r + 1) % 3, q = (r + 2) % 3;
      const auto abs = [](double x) { return x < 0 ? -x : x; };
      if (abs(a[p][q]) <= 1e-20 * (abs(a[p][p]) + abs(a[q][q]))) {  // far below rounding; (1) may overflow
        a[p][q] = a[q][p] = 0;
        continue;
      }
      const double k = (a[q][q] / 2 - a[p][p] / 2) / a[p][q], size = abs(k);
      const double root = size < 1e8 ? detail::constexpr_sqrt(size * size + 1) : size;
      const double t = (k < 0 ? -1 : 1) / (size + root), c = 1 / detail::constexpr_sqrt(t * t + 1), s = t * c;  // (1)
      a[p][p] -= t * a[p][q], a[q][q] += t * a[p][q], a[p][q] = 0;                                              // (2)
      a[q][p] = 0;
      const double rp = a[r][p], rq = a[r][q];
      a[r][p] = a[p][r] = c * rp - s * rq, a[r][q] = a[q][r] = s * rp + c * rq;
    }
  std::array<double, 3> moments{a[0][0], a[1][1], a[2][2]};
  std::sort(moments.begin(), moments.end(), [](double x, double y) { return x > y; });
  return moments;
}

}  // namespace kte
