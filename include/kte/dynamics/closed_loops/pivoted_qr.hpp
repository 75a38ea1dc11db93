#pragma once

#include <kte/tree/simd.hpp>

#include <Eigen/Core>

#include <cmath>
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
  static constexpr Eigen::Index padding = static_cast<Eigen::Index>(tree::simd_of<double>::count) - 1;

  using block = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
  /// B, to be filled; its numbers are lost by `choose` and `take`.
  block matrix(Eigen::Index rows, Eigen::Index columns) {
    if (rows_ != rows || columns_ != columns) {
      rows_ = rows, columns_ = columns;
      b_.setZero(rows + padding, columns);
      diagonal_.resize(columns), inverse_.resize(columns), square_.resize(columns);
      chosen.reserve(static_cast<std::size_t>(columns));
    }
    return {b_.data(), rows, columns, Eigen::OuterStride<>(rows + padding)};
  }
  /// Selects the column with the largest remaining norm in each step. Columns whose norm is below `least` times the
  /// first, or below `zero`, count as dependent.
  void choose(double least, double zero = 0) {
    chosen.resize(static_cast<std::size_t>(columns_));
    for (std::size_t i = 0; i < chosen.size(); ++i) chosen[i] = static_cast<int>(i);
    largest = smallest = 0;
    Eigen::Index k = 0;
    for (; k < (std::min)(rows_, columns_); ++k) {
      Eigen::Index best = k;
      double most = -1;
      for (Eigen::Index j = k; j < columns_; ++j)
        if (const double square = square_of(k, j); square > most) most = square, best = j;
      const double norm = std::sqrt(most);
      if (!(norm > least * largest) || !(norm > zero)) break;
      if (best != k) {
        b_.col(k).swap(b_.col(best));
        std::swap(chosen[static_cast<std::size_t>(k)], chosen[static_cast<std::size_t>(best)]);
      }
      reflect(k, norm);
    }
    chosen.resize(static_cast<std::size_t>(k));
  }
  /// Factorizes all columns in the given order; `columns` are their numbers. Returns false if they are dependent.
  bool take(const std::vector<int>& columns, double least) {
    chosen = columns;
    largest = smallest = 0;
    if (rows_ < columns_) return false;
    for (Eigen::Index k = 0; k < columns_; ++k) reflect(k, std::sqrt(square_of(k, k)));
    return columns_ == 0 || smallest > least * largest;
  }
  Eigen::Index rank() const { return static_cast<Eigen::Index>(chosen.size()); }

  /// y = Q x.
  void times_q(const double* x, double* y) const {
    const Eigen::Index n = rank();
    for (Eigen::Index i = 0; i < rows_; ++i) y[i] = i < n ? x[i] : 0;
    for (Eigen::Index i = 0; i < padding; ++i) y[rows_ + i] = 0;
    for (Eigen::Index k = n; k-- > 0;) reflect_from(k, y + k);
  }
  /// The first numbers of y become Q^T y.
  void times_q_transposed(double* y) const {
    for (Eigen::Index k = 0; k < rank(); ++k) reflect_from(k, y + k);
  }
  /// x becomes R^-1 x.
  void solve(double* x) const {
    for (Eigen::Index k = rank(); k-- > 0;) {
      x[k] *= inverse_[k];
      for (Eigen::Index i = 0; i < k; ++i) x[i] -= b_(i, k) * x[k];
    }
  }
  /// x becomes R^-T x.
  void solve_transposed(double* x) const {
    for (Eigen::Index k = 0; k < rank(); ++k) {
      for (Eigen::Index i = 0; i < k; ++i) x[k] -= b_(i, k) * x[i];
      x[k] *= inverse_[k];
    }
  }
  Eigen::MatrixXd q() const {
    Eigen::MatrixXd all(rows_ + padding, rank());
    const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(rank(), rank());
    for (Eigen::Index k = 0; k < rank(); ++k) times_q(unit.col(k).data(), all.col(k).data());
    return all.topRows(rows_);
  }
  Eigen::MatrixXd r() const {
    Eigen::MatrixXd all = b_.topLeftCorner(rank(), rank()).triangularView<Eigen::StrictlyUpper>();
    all.diagonal() = diagonal_.head(rank());
    return all;
  }

 private:
  using simd = tree::simd<double>;
  static constexpr Eigen::Index lanes = padding + 1;

  /// x . y of n numbers and the zeros behind them.
  KTE_INLINE static double dot(Eigen::Index n, const double* x, const double* y) {
    simd sum{}, a, b;
    for (Eigen::Index i = 0; i < n; i += lanes) {
      tree::load<double>(a, x + i), tree::load<double>(b, y + i);
      sum += a * b;
    }
    double each[lanes];
    tree::store<double>(sum, each);
    double all = each[0];
    for (Eigen::Index i = 1; i < lanes; ++i) all += each[i];
    return all;
  }
  /// Of column j from row k on.
  double square_of(Eigen::Index k, Eigen::Index j) const {
    const double* const x = &b_.coeffRef(k, j);
    return dot(rows_ - k, x, x);
  }
  /// Reflects column k onto axis k by 1 - v v^T / (-d v_0), v of the column less d on its axis; keeps v from the
  /// diagonal on.
  void reflect(Eigen::Index k, double norm) {
    const double d = b_(k, k) > 0 ? -norm : norm;
    diagonal_[k] = d, inverse_[k] = 1 / d;
    b_(k, k) -= d;
    const double square = -d * b_(k, k);
    square_[k] = square > 0 ? 1 / square : 0;
    largest = k == 0 ? norm : (std::max)(largest, norm), smallest = k == 0 ? norm : (std::min)(smallest, norm);
    for (Eigen::Index j = k + 1; j < columns_; ++j) reflect_from(k, &b_.coeffRef(k, j));
  }
  KTE_INLINE void reflect_from(Eigen::Index k, double* y) const {
    const Eigen::Index n = rows_ - k;
    const double* const v = &b_.coeffRef(k, k);
    const double along = square_[k] * dot(n, v, y);
    simd a, b;
    for (Eigen::Index i = 0; i < n; i += lanes) {
      tree::load<double>(a, v + i), tree::load<double>(b, y + i);
      b -= along * a;
      tree::store<double>(b, y + i);
    }
  }

  Eigen::Index rows_ = 0, columns_ = 0;
  Eigen::MatrixXd b_;
  Eigen::VectorXd diagonal_, inverse_, square_;  ///< R_kk, 1 / R_kk, and 2 / |v|^2 of reflections
};

}  // namespace kte::detail
