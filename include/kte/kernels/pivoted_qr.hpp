#pragma once

#include <Eigen/Core>

#include <cmath>
#include <utility>
#include <vector>

namespace kte::detail {

/// B P = Q R by Householder reflections (Golub and Van Loan, Matrix Computations, 2013, 5.4.2), of the columns of B
/// that are independent: Q has orthonormal columns, R is square and upper triangular.
class pivoted_qr {
 public:
  std::vector<int> chosen;  ///< columns of B, in the order of R
  Eigen::MatrixXd q, r;
  double largest = 0, smallest = 0;  ///< of the diagonal of R

  /// Each time takes the column with most beside those taken. Columns with less than `least` times the first, or with
  /// less than `zero`, count as dependent.
  void choose(Eigen::MatrixXd& b, double least, double zero = 0) {
    chosen.resize(static_cast<std::size_t>(b.cols()));
    for (std::size_t i = 0; i < chosen.size(); ++i) chosen[i] = static_cast<int>(i);
    largest = 0;
    Eigen::Index k = 0;
    for (; k < (std::min)(b.rows(), b.cols()); ++k) {
      Eigen::Index best = k;
      double most = -1;
      for (Eigen::Index j = k; j < b.cols(); ++j)
        if (const double norm = b.col(j).tail(b.rows() - k).norm(); norm > most) most = norm, best = j;
      if (!(most > least * largest) || !(most > zero)) break;
      if (best != k) {
        b.col(k).swap(b.col(best));
        std::swap(chosen[static_cast<std::size_t>(k)], chosen[static_cast<std::size_t>(best)]);
      }
      reflect(b, k, most);
    }
    chosen.resize(static_cast<std::size_t>(k));
    finish(b, k);
  }
  /// The factorization of all columns, in their order; `columns` are their numbers. Returns false if they are
  /// dependent.
  bool take(Eigen::MatrixXd& b, const std::vector<int>& columns, double least) {
    chosen = columns;
    largest = smallest = 0;
    if (b.rows() < b.cols()) return false;
    for (Eigen::Index k = 0; k < b.cols(); ++k) reflect(b, k, b.col(k).tail(b.rows() - k).norm());
    finish(b, b.cols());
    return b.cols() == 0 || smallest > least * largest;
  }

 private:
  /// Reflects column k onto axis k; keeps the vector of the reflection from the diagonal on.
  void reflect(Eigen::MatrixXd& b, Eigen::Index k, double norm) {
    const Eigen::Index rest = b.rows() - k;
    if (k == 0) diagonal_.resize(b.cols()), largest = norm;
    diagonal_[k] = b(k, k) > 0 ? -norm : norm;
    auto v = b.col(k).tail(rest);
    v[0] -= diagonal_[k];
    if (const double length = v.norm(); length > 0) v /= length;
    for (Eigen::Index j = k + 1; j < b.cols(); ++j) {
      const double along = 2 * v.dot(b.col(j).tail(rest));
      b.col(j).tail(rest) -= along * v;
    }
  }
  void finish(const Eigen::MatrixXd& b, Eigen::Index rank) {
    r.setZero(rank, rank);
    q.setIdentity(b.rows(), rank);
    for (Eigen::Index k = 0; k < rank; ++k) {
      r.col(k).head(k) = b.col(k).head(k);
      r(k, k) = diagonal_[k];
    }
    for (Eigen::Index k = rank; k-- > 0;)
      for (Eigen::Index j = k; j < rank; ++j) {
        const Eigen::Index rest = b.rows() - k;
        const double along = 2 * b.col(k).tail(rest).dot(q.col(j).tail(rest));
        q.col(j).tail(rest) -= along * b.col(k).tail(rest);
      }
    smallest = largest = 0;
    for (Eigen::Index k = 0; k < rank; ++k) {
      const double pivot = std::abs(r(k, k));
      largest = (std::max)(largest, pivot), smallest = k == 0 ? pivot : (std::min)(smallest, pivot);
    }
  }

  Eigen::VectorXd diagonal_;
};

}  // namespace kte::detail
