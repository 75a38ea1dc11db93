#pragma once

#include <kte/tree/simd.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace kte::detail {

/// B P = Q R by Householder reflections (Golub and Van Loan, Matrix Computations, 2013, 5.4.2), of the columns of B
/// that are independent: Q has orthonormal columns, R is square and upper triangular. Nothing is allocated where B is
/// as large as before. Vectors of as many numbers as B has rows have `padding` zeros behind them.
class pivoted_qr {
 public:
  std::vector<int> chosen;           ///< columns of B, in the order of R
  double largest = 0, smallest = 0;  ///< of the diagonal of R
  bool is_finite = true;             ///< whether B was finite
  static constexpr Eigen::Index padding = static_cast<Eigen::Index>(tree::simd_of<double>::count) - 1;

  using block = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
  /// B, to be filled; its numbers are lost by `choose` and `take`.
  block matrix(Eigen::Index rows, Eigen::Index columns);
  /// Selects the column with the largest remaining norm in each step. Columns whose norm is below `least` times the
  /// first, or below `zero`, count as dependent.
  void choose(double least, double zero = 0);
  /// Factorizes all columns in the given order; `columns` are their numbers. Returns false if they are dependent.
  bool take(const std::vector<int>& columns, double least);
  Eigen::Index rank() const { return static_cast<Eigen::Index>(chosen.size()); }

  /// y = Q x.
  void times_q(const double* x, double* y) const;
  /// y = column k of Q.
  void column_of_q(Eigen::Index k, double* y) const;
  /// The first numbers of y become Q^T y.
  void times_q_transposed(double* y) const {
    for (Eigen::Index k = 0; k < rank(); ++k) reflect_by(k, y);
  }
  /// x becomes R^-1 x.
  void solve(double* x) const { solve_from(rank(), x); }
  /// The first k + 1 numbers of x become those of column k of R^-1; the others are zero.
  void column_of_inverse(Eigen::Index k, double* x) const {
    std::fill_n(x, k, 0.0), x[k] = 1;
    solve_from(k + 1, x);
  }
  /// x becomes R^-T x.
  void solve_transposed(double* x) const;
  Eigen::MatrixXd q() const;
  Eigen::MatrixXd r() const {
    Eigen::MatrixXd all = r_.topLeftCorner(rank(), rank()).triangularView<Eigen::StrictlyUpper>();
    all.diagonal() = diagonal_.head(rank());
    return all;
  }

 private:
  using simd = tree::simd<double>;
  static constexpr Eigen::Index lanes = padding + 1;

  // Registers begin at multiples of their size, so that each one that is loaded was stored as a whole.
  double* at(Eigen::Index row, Eigen::Index column) { return b_.data() + (column * b_.rows() + row); }
  const double* at(Eigen::Index row, Eigen::Index column) const { return b_.data() + (column * b_.rows() + row); }
  static Eigen::Index first_of(Eigen::Index row) { return row / lanes * lanes; }

  KTE_INLINE static double sum_of(const simd& x) {
    double each[lanes];
    tree::store<double>(x, each);
    for (Eigen::Index half = lanes / 2; half > 0; half /= 2)
      for (Eigen::Index i = 0; i < half; ++i) each[i] += each[i + half];
    return each[0];
  }
  /// x . y from number `first` on.
  KTE_INLINE double dot(Eigen::Index first, const double* x, const double* y) const {
    simd sum{}, a, b;
    for (Eigen::Index i = first; i < b_.rows(); i += lanes) {
      tree::load<double>(a, x + i), tree::load<double>(b, y + i);
      sum += a * b;
    }
    return sum_of(sum);
  }
  /// As `solve`, for x whose numbers from `end` on are zero.
  void solve_from(Eigen::Index end, double* x) const;
  void find_squares();
  /// Reflects column k, of this norm, onto axis k by 1 - v v^T / (-d v_0), v of the column less d on its axis. Keeps v
  /// in the column; row k of the others goes to R.
  void reflect(Eigen::Index k, double norm);
  KTE_INLINE void reflect_by(Eigen::Index k, double* y) const {
    const Eigen::Index first = first_of(k);
    const double along = factor_[k] * dot(first, at(0, k), y);
    simd a, b;
    for (Eigen::Index i = first; i < b_.rows(); i += lanes) {
      tree::load<double>(a, at(i, k)), tree::load<double>(b, y + i);
      b -= along * a;
      tree::store<double>(b, y + i);
    }
  }

  Eigen::Index rows_ = 0, columns_ = 0;
  Eigen::MatrixXd b_, r_;                                 ///< reflections; R above its diagonal
  Eigen::VectorXd diagonal_, inverse_, factor_, square_;  ///< R_kk, 1 / R_kk, 2 / |v|^2; squares of remaining columns
};

#ifdef KTE_FUNCTION
KTE_FUNCTION pivoted_qr::block pivoted_qr::matrix(Eigen::Index rows, Eigen::Index columns) {
  if (rows_ != rows || columns_ != columns) {
    rows_ = rows, columns_ = columns;
    b_.setZero((rows + padding) / lanes * lanes, columns), r_.setZero(columns, columns);
    diagonal_.resize(columns), inverse_.resize(columns), factor_.resize(columns), square_.resize(columns);
    chosen.reserve(static_cast<std::size_t>(columns));
  }
  return {b_.data(), rows, columns, Eigen::OuterStride<>(b_.rows())};
}
KTE_FUNCTION void pivoted_qr::choose(double least, double zero) {
  chosen.resize(static_cast<std::size_t>(columns_));
  for (std::size_t i = 0; i < chosen.size(); ++i) chosen[i] = static_cast<int>(i);
  find_squares();
  Eigen::Index k = 0;
  for (; k < (std::min)(rows_, columns_); ++k) {
    Eigen::Index best = k;
    double most = -1;
    for (Eigen::Index j = k; j < columns_; ++j)
      if (square_[j] > most) most = square_[j], best = j;
    const double norm = std::sqrt(most);
    if (!(norm > least * largest) || !(norm > zero)) break;
    if (best != k) {
      for (Eigen::Index i = 0; i < b_.rows(); i += lanes) {
        simd x, y;
        tree::load<double>(x, at(i, k)), tree::load<double>(y, at(i, best));
        tree::store<double>(y, at(i, k)), tree::store<double>(x, at(i, best));
      }
      for (Eigen::Index i = 0; i < k; ++i) std::swap(r_(i, k), r_(i, best));
      square_[best] = square_[k];
      std::swap(chosen[static_cast<std::size_t>(k)], chosen[static_cast<std::size_t>(best)]);
    }
    reflect(k, norm);
  }
  chosen.resize(static_cast<std::size_t>(k));
}
KTE_FUNCTION bool pivoted_qr::take(const std::vector<int>& columns, double least) {
  chosen = columns;
  largest = smallest = 0;
  if (rows_ < columns_) return false;
  find_squares();
  for (Eigen::Index k = 0; k < columns_; ++k) reflect(k, std::sqrt(square_[k]));
  return columns_ == 0 || smallest > least * largest;
}
KTE_FUNCTION void pivoted_qr::times_q(const double* x, double* y) const {
  const Eigen::Index n = rank();
  for (Eigen::Index first = 0; first < b_.rows(); first += lanes) {
    simd part{};
    for (Eigen::Index i = first; i < (std::min)(n, first + lanes); ++i)
      tree::simd_lane<double>(static_cast<int>(i - first)).put(part, x[i]);
    tree::store<double>(part, y + first);
  }
  for (Eigen::Index k = n; k-- > 0;) reflect_by(k, y);
}
KTE_FUNCTION void pivoted_qr::column_of_q(Eigen::Index k, double* y) const {
  std::fill_n(y, b_.rows(), 0.0), y[k] = 1;
  for (Eigen::Index i = k + 1; i-- > 0;) reflect_by(i, y);  // the others do not change it
}
KTE_FUNCTION void pivoted_qr::solve_from(Eigen::Index end, double* x) const {
  for (Eigen::Index k = end; k-- > 0;) {
    x[k] *= inverse_[k];
    for (Eigen::Index i = 0; i < k; ++i) x[i] -= r_(i, k) * x[k];
  }
}
KTE_FUNCTION void pivoted_qr::solve_transposed(double* x) const {
  for (Eigen::Index k = 0; k < rank(); ++k) {
    for (Eigen::Index i = 0; i < k; ++i) x[k] -= r_(i, k) * x[i];
    x[k] *= inverse_[k];
  }
}
KTE_FUNCTION Eigen::MatrixXd pivoted_qr::q() const {
  Eigen::MatrixXd all(rows_ + padding, rank());
  for (Eigen::Index k = 0; k < rank(); ++k) column_of_q(k, all.col(k).data());
  return all.topRows(rows_);
}
KTE_FUNCTION void pivoted_qr::find_squares() {
  largest = smallest = 0;
  is_finite = true;
  for (Eigen::Index j = 0; j < columns_; ++j) {
    square_[j] = dot(0, at(0, j), at(0, j));
    is_finite &= square_[j] < std::numeric_limits<double>::infinity();
  }
}
KTE_FUNCTION void pivoted_qr::reflect(Eigen::Index k, double norm) {
  const Eigen::Index first = first_of(k);
  const tree::simd_lane<double> lane(static_cast<int>(k - first));
  const double own = b_(k, k), d = own > 0 ? -norm : norm, v0 = own - d, half = -d * v0;
  diagonal_[k] = d, inverse_[k] = 1 / d, factor_[k] = half > 0 ? 1 / half : 0;
  largest = k == 0 ? norm : (std::max)(largest, norm), smallest = k == 0 ? norm : (std::min)(smallest, norm);
  simd a, b;
  tree::load<double>(a, at(first, k));
  lane.put(a, v0);
  tree::store<double>(a, at(first, k));
  for (Eigen::Index j = k + 1; j < columns_; ++j) {
    const double along = factor_[k] * dot(first, at(0, k), at(0, j));
    r_(k, j) = b_(k, j) - along * v0;
    simd square{};
    for (Eigen::Index i = first; i < b_.rows(); i += lanes) {
      tree::load<double>(a, at(i, k)), tree::load<double>(b, at(i, j));
      b -= along * a;
      if (i == first) lane.put(b, 0.0);
      square += b * b;
      tree::store<double>(b, at(i, j));
    }
    square_[j] = sum_of(square);
  }
}
#endif

}  // namespace kte::detail
