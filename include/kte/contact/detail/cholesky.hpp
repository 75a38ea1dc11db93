#pragma once

#include <Eigen/Core>

#include <cmath>
#include <vector>

namespace kte::detail {

/// W + eps I = L L^T of a symmetric positive semidefinite W, in columns of `stride` numbers.
template <class S>
class cholesky {
 public:
  using view = Eigen::Map<Eigen::Matrix<S, Eigen::Dynamic, 1>>;

  void factor(const S* W, Eigen::Index n, Eigen::Index stride, S eps) {
    using std::sqrt;
    n_ = n;
    L_.resize(static_cast<std::size_t>(n * n));
    for (Eigen::Index j = 0; j < n; ++j) {
      std::copy_n(W + j * stride, n, &at(0, j));
      at(j, j) += eps;
      for (Eigen::Index k = 0; k < j; ++k) below(j, j) -= at(j, k) * below(j, k);
      below(j, j) /= sqrt(at(j, j));
    }
  }
  /// c becomes (W + eps I)^-1 c.
  void solve(S* c) {
    for (Eigen::Index j = 0; j < n_; ++j) {
      c[j] /= at(j, j);
      if (j + 1 < n_) view(c + j + 1, n_ - j - 1) -= c[j] * below(j + 1, j);
    }
    for (Eigen::Index j = n_ - 1; j >= 0; --j) {
      if (j + 1 < n_) c[j] -= below(j + 1, j).dot(view(c + j + 1, n_ - j - 1));
      c[j] /= at(j, j);
    }
  }

 private:
  S& at(Eigen::Index i, Eigen::Index j) { return L_[static_cast<std::size_t>(j * n_ + i)]; }
  view below(Eigen::Index i, Eigen::Index j) { return view(&at(i, j), n_ - i); }

  std::vector<S> L_;
  Eigen::Index n_ = 0;
};

}  // namespace kte::detail
