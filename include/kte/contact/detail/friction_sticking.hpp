#pragma once

#include <kte/contact/detail/friction_system.hpp>
#include <kte/tree/simd.hpp>

namespace kte::detail {

/// The solution of a friction problem where all contacts stick, W lambda = -b, by W = L D L^T.
template <class S>
class friction_sticking {
 public:
  /// Writes lambda. Returns false if W is nearly singular.
  bool solve(const friction_system<S>& p, S* lambda) {
    const Eigen::Index n = p.size;
    const S least = p.unit * S(1e-7);
    stride_ = (n / lanes + 1) * lanes;
    A_.assign(static_cast<std::size_t>(n * stride_), S(0)), x_.assign(static_cast<std::size_t>(stride_), S(0));
    inverse_.resize(static_cast<std::size_t>(n));
    for (Eigen::Index j = 0; j < n; ++j) {
      std::copy_n(p.column(j), n, &at(0, j));
      at(n, j) = -p.b[j];
    }
    for (Eigen::Index k = 0; k < n; ++k) {
      if (!(at(k, k) > least)) return false;
      const S inverse = S(1) / at(k, k);
      inverse_[static_cast<std::size_t>(k)] = inverse;
      for (Eigen::Index j = k + 1; j < n; ++j) {
        const S factor = at(j, k) * inverse;
        for (Eigen::Index i = j / lanes * lanes; i < stride_; i += lanes) {
          simd x, y;
          tree::load<S>(x, &at(i, k)), tree::load<S>(y, &at(i, j));
          y = y - factor * x;
          tree::store<S>(y, &at(i, j));
        }
      }
    }
    for (Eigen::Index k = n; k-- > 0;) {
      simd sum = zeros(), x, y;
      for (Eigen::Index i = k / lanes * lanes; i < stride_; i += lanes) {
        tree::load<S>(x, &at(i, k)), tree::load<S>(y, &x_[static_cast<std::size_t>(i)]);
        sum = sum + x * y;
      }
      S each[lanes], rest = at(n, k);
      tree::store<S>(sum, each);
      for (const S& part : each) rest = rest - part;
      x_[static_cast<std::size_t>(k)] = rest * inverse_[static_cast<std::size_t>(k)];
    }
    std::copy_n(x_.data(), n, lambda);
    return true;
  }

 private:
  using simd = tree::simd<S>;
  static constexpr auto lanes = static_cast<Eigen::Index>(tree::simd_of<S>::count);
  static simd zeros() {
    const S none[lanes]{};
    simd x;
    tree::load<S>(x, none);
    return x;
  }
  S& at(Eigen::Index i, Eigen::Index j) { return A_[static_cast<std::size_t>(j * stride_ + i)]; }

  std::vector<S> A_, x_, inverse_;  ///< columns of W and a row of -b, which become L D; lambda; 1/D
  Eigen::Index stride_ = 0;
};

}  // namespace kte::detail
