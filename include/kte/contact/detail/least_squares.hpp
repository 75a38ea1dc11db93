#pragma once

#include <array>
#include <cmath>
#include <limits>

namespace kte::detail {

/// Small matrices in columns.
template <class S, std::size_t Rows, std::size_t Columns>
using small_columns = std::array<std::array<S, Rows>, Columns>;

/// z that minimizes |P z - r| for `columns` columns of full rank, by modified Gram-Schmidt of (P, r).
template <class S>
std::array<S, 6> least_squares(small_columns<S, 12, 6> P, std::array<S, 12> r, std::size_t columns) {
  using std::sqrt;
  small_columns<S, 6, 6> R{};
  std::array<S, 6> z{};
  const auto dot = [](const auto& x, const auto& y) {
    S sum(0);
    for (std::size_t i = 0; i < 12; ++i) sum += x[i] * y[i];
    return sum;
  };
  for (std::size_t j = 0; j < columns; ++j) {
    R[j][j] = sqrt(dot(P[j], P[j]));
    for (auto& x : P[j]) x /= R[j][j];
    for (std::size_t k = j + 1; k < columns; ++k) {
      R[k][j] = dot(P[j], P[k]);
      for (std::size_t i = 0; i < 12; ++i) P[k][i] -= R[k][j] * P[j][i];
    }
    z[j] = dot(P[j], r);
    for (std::size_t i = 0; i < 12; ++i) r[i] -= z[j] * P[j][i];
  }
  for (std::size_t j = columns; j-- > 0;) {
    for (std::size_t k = j + 1; k < columns; ++k) z[j] -= R[k][j] * z[k];
    z[j] /= R[j][j];
  }
  return z;
}

/// The a >= 0 of m <= 6 numbers that minimizes |B a - r| (Lawson and Hanson, Solving least squares problems, 1974,
/// chapter 23).
template <class S>
std::array<S, 6> nonnegative_least_squares(const small_columns<S, 12, 6>& B, const std::array<S, 12>& r,
                                           std::size_t m) {
  using std::abs;
  std::array<S, 6> a{};
  std::array<bool, 6> active{};
  S size(0);
  for (const auto& column : B)
    for (const S& x : column) size += abs(x);
  S length(0);
  for (const S& x : r) length += abs(x);
  const S least = std::numeric_limits<S>::epsilon() * size * length;
  for (int round = 0; round < 40; ++round) {
    std::array<S, 12> rest = r;
    for (std::size_t j = 0; j < m; ++j)
      for (std::size_t i = 0; i < 12; ++i) rest[i] -= a[j] * B[j][i];
    std::size_t enter = m;
    S steepest = least;
    for (std::size_t j = 0; j < m; ++j) {
      S slope(0);
      for (std::size_t i = 0; i < 12; ++i) slope += B[j][i] * rest[i];
      if (!active[j] && slope > steepest) steepest = slope, enter = j;
    }
    if (enter == m) break;
    active[enter] = true;
    for (std::size_t blocking = enter; blocking < m;) {
      small_columns<S, 12, 6> P{};
      std::size_t columns = 0;
      for (std::size_t j = 0; j < m; ++j)
        if (active[j]) P[columns++] = B[j];
      const auto z = least_squares<S>(P, r, columns);
      S step(1);
      blocking = m;
      for (std::size_t j = 0, k = 0; j < m; ++j) {
        if (!active[j]) continue;
        if (z[k] <= S(0) && a[j] >= S(0) && a[j] <= step * (a[j] - z[k])) step = a[j] / (a[j] - z[k]), blocking = j;
        ++k;
      }
      for (std::size_t j = 0, k = 0; j < m; ++j)
        if (active[j]) a[j] += step * (z[k++] - a[j]);
      if (blocking < m) a[blocking] = S(0), active[blocking] = false;
    }
  }
  return a;
}

}  // namespace kte::detail
