#pragma once

#include <kte/math/pack.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace kte::detail {

/// B = Q R in packs S of matrices, of the first columns of B, by Householder reflections
/// (dynamics/closed_loops/pivoted_qr.hpp); the other columns become what Q leaves of them.
template <class S>
class qr_in_lanes {
 public:
  void resize(std::size_t rows, std::size_t columns) {
    rows_ = rows;
    b_.assign(rows * columns, S(0)), diagonal_.resize(columns), square_.resize(columns);
  }
  S* column(std::size_t j) { return b_.data() + j * rows_; }
  const S* column(std::size_t j) const { return b_.data() + j * rows_; }
  std::size_t columns() const { return diagonal_.size(); }

  void factorize(std::size_t rank) {
    rank_ = rank;
    for (std::size_t k = 0; k < rank; ++k) {
      S* const v = column(k);
      const S norm = length(k, k);
      diagonal_[k] = select(v[k] > S(0), -norm, norm);
      v[k] -= diagonal_[k];
      const S square = -diagonal_[k] * v[k];
      square_[k] = select(square > S(0), S(1) / square, S(0));
      for (std::size_t j = k + 1; j < columns(); ++j) reflect(k, column(j));
    }
  }
  /// The sizes of the diagonal of R, and of what Q leaves of a column beyond.
  S pivot(std::size_t k) const { return abs(diagonal_[k]); }
  S left(std::size_t column) const { return length(rank_, column); }
  /// y = Q R^-T c; y has as many numbers as B has rows.
  void least(const S* c, S* y) const {
    std::fill_n(y, rows_, S(0));
    for (std::size_t k = 0; k < rank_; ++k) {
      S x = c[k];
      for (std::size_t i = 0; i < k; ++i) x -= column(k)[i] * y[i];
      y[k] = x / diagonal_[k];
    }
    for (std::size_t k = rank_; k-- > 0;) reflect(k, y);
  }

 private:
  S length(std::size_t from, std::size_t j) const {
    S sum(0);
    for (std::size_t i = from; i < rows_; ++i) sum += column(j)[i] * column(j)[i];
    return sqrt(sum);
  }
  void reflect(std::size_t k, S* y) const {
    const S* const v = column(k);
    S along(0);
    for (std::size_t i = k; i < rows_; ++i) along += v[i] * y[i];
    along *= square_[k];
    for (std::size_t i = k; i < rows_; ++i) y[i] -= along * v[i];
  }

  std::size_t rows_ = 0, rank_ = 0;
  std::vector<S> b_, diagonal_, square_;
};

}  // namespace kte::detail
