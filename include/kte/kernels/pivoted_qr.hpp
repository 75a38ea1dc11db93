#pragma once

#include <Eigen/Core>

#include <cmath>
#include <utility>
#include <vector>

namespace kte::detail {

/// B P = Q R by Householder reflections (Golub and Van Loan, Matrix Computations, 2013, 5.4.2), of the columns of B
/// that are independent: Q has orthonormal columns, R is square and upper triangular. Nothing is allocated where B is
/// as large as before.
class pivoted_qr {
 public:
  std::vector<int> chosen;           ///< columns of B, in the order of R
  double largest = 0, smallest = 0;  ///< of the diagonal of R

  /// B, to be filled; its numbers are lost by `choose` and `take`.
  Eigen::MatrixXd& matrix(Eigen::Index rows, Eigen::Index columns) {
    if (b_.rows() != rows || b_.cols() != columns) {
      b_.resize(rows, columns), diagonal_.resize(columns);
      chosen.reserve(static_cast<std::size_t>(columns));
    }
    return b_;
  }
  /// Each time takes the column with most beside those taken. Columns with less than `least` times the first, or with
  /// less than `zero`, count as dependent.
  void choose(double least, double zero = 0) {
    chosen.resize(static_cast<std::size_t>(b_.cols()));
    for (std::size_t i = 0; i < chosen.size(); ++i) chosen[i] = static_cast<int>(i);
    largest = smallest = 0;
    Eigen::Index k = 0;
    for (; k < (std::min)(b_.rows(), b_.cols()); ++k) {
      Eigen::Index best = k;
      double most = -1;
      for (Eigen::Index j = k; j < b_.cols(); ++j)
        if (const double square = dot(k, j, j); square > most) most = square, best = j;
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
  /// The factorization of all columns, in their order; `columns` are their numbers. Returns false if they are
  /// dependent.
  bool take(const std::vector<int>& columns, double least) {
    chosen = columns;
    largest = smallest = 0;
    if (b_.rows() < b_.cols()) return false;
    for (Eigen::Index k = 0; k < b_.cols(); ++k) reflect(k, std::sqrt(dot(k, k, k)));
    return b_.cols() == 0 || smallest > least * largest;
  }
  Eigen::Index rank() const { return static_cast<Eigen::Index>(chosen.size()); }

  /// y = Q x, of as many numbers as B has rows.
  void times_q(const double* x, double* y) const {
    const Eigen::Index n = rank();
    for (Eigen::Index i = 0; i < b_.rows(); ++i) y[i] = i < n ? x[i] : 0;
    for (Eigen::Index k = n; k-- > 0;) reflect_numbers(k, y);
  }
  /// The first numbers of y become Q^T y.
  void times_q_transposed(double* y) const {
    for (Eigen::Index k = 0; k < rank(); ++k) reflect_numbers(k, y);
  }
  /// x becomes R^-1 x.
  void solve(double* x) const {
    for (Eigen::Index k = rank(); k-- > 0;) {
      x[k] /= diagonal_[k];
      for (Eigen::Index i = 0; i < k; ++i) x[i] -= b_(i, k) * x[k];
    }
  }
  /// x becomes R^-T x.
  void solve_transposed(double* x) const {
    for (Eigen::Index k = 0; k < rank(); ++k) {
      for (Eigen::Index i = 0; i < k; ++i) x[k] -= b_(i, k) * x[i];
      x[k] /= diagonal_[k];
    }
  }
  Eigen::MatrixXd q() const {
    Eigen::MatrixXd all(b_.rows(), rank());
    const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(rank(), rank());
    for (Eigen::Index k = 0; k < rank(); ++k) times_q(unit.col(k).data(), all.col(k).data());
    return all;
  }
  Eigen::MatrixXd r() const {
    Eigen::MatrixXd all = b_.topLeftCorner(rank(), rank()).triangularView<Eigen::StrictlyUpper>();
    all.diagonal() = diagonal_.head(rank());
    return all;
  }

 private:
  /// The product of columns i and j from row k on, in two sums.
  double dot(Eigen::Index k, Eigen::Index i, Eigen::Index j) const {
    return dot_numbers(b_.rows() - k, &b_.coeffRef(k, i), &b_.coeffRef(k, j));
  }
  static double dot_numbers(Eigen::Index n, const double* x, const double* y) {
    double even = 0, odd = 0;
    Eigen::Index i = 0;
    for (; i + 1 < n; i += 2) even += x[i] * y[i], odd += x[i + 1] * y[i + 1];
    if (i < n) even += x[i] * y[i];
    return even + odd;
  }
  /// Reflects column k onto axis k by 1 - v v^T / (-d v_0), v of the column less d on its axis; keeps v from the
  /// diagonal on.
  void reflect(Eigen::Index k, double norm) {
    const double d = b_(k, k) > 0 ? -norm : norm;
    diagonal_[k] = d;
    b_(k, k) -= d;
    largest = k == 0 ? norm : (std::max)(largest, norm), smallest = k == 0 ? norm : (std::min)(smallest, norm);
    for (Eigen::Index j = k + 1; j < b_.cols(); ++j) reflect_from(k, &b_.coeffRef(k, j));
  }
  void reflect_numbers(Eigen::Index k, double* y) const { reflect_from(k, y + k); }
  void reflect_from(Eigen::Index k, double* y) const {
    const Eigen::Index n = b_.rows() - k;
    const double* const v = &b_.coeffRef(k, k);
    const double square = -diagonal_[k] * v[0];
    if (!(square > 0)) return;
    const double along = dot_numbers(n, v, y) / square;
    for (Eigen::Index i = 0; i < n; ++i) y[i] -= along * v[i];
  }

  Eigen::MatrixXd b_;
  Eigen::VectorXd diagonal_;
};

}  // namespace kte::detail
