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
    for (auto* to : {&A_, &U_}) to->resize(static_cast<std::size_t>(n * stride_));
    x_.resize(static_cast<std::size_t>(stride_)), inverse_.resize(static_cast<std::size_t>(n));
    for (Eigen::Index j = 0; j < n; ++j) {
      std::copy_n(p.column(j), n, &at(0, j));
      at(n, j) = -p.b[j];
      std::fill(&at(0, j) + n + 1, &at(0, j) + stride_, S(0));
    }
    for (Eigen::Index k = 0; k < n; ++k) {
      if (!(at(k, k) > least)) return false;
      const S inverse = S(1) / at(k, k);
      inverse_[static_cast<std::size_t>(k)] = inverse;
      for (Eigen::Index j = k + 1; j < n; ++j) {
        const S own = at(j, k), factor = own * inverse;
        U_[static_cast<std::size_t>(j * stride_ + k)] = own;
        for (Eigen::Index i = j / lanes * lanes; i < stride_; i += lanes) {
          simd x, y;
          tree::load<S>(x, &at(i, k)), tree::load<S>(y, &at(i, j));
          y = y - factor * x;
          tree::store<S>(y, &at(i, j));
        }
      }
    }
    for (Eigen::Index k = 0; k < n; ++k) x_[static_cast<std::size_t>(k)] = at(n, k);
    for (Eigen::Index k = n; k-- > 0;) {
      const S own = x_[static_cast<std::size_t>(k)] * inverse_[static_cast<std::size_t>(k)];
      lambda[k] = own;
      for (Eigen::Index i = 0; i < k; i += lanes) {
        simd x, u;
        tree::load<S>(x, &x_[static_cast<std::size_t>(i)]);
        tree::load<S>(u, &U_[static_cast<std::size_t>(k * stride_ + i)]);
        x = x - own * u;
        tree::store<S>(x, &x_[static_cast<std::size_t>(i)]);
      }
    }
    return true;
  }

 private:
  using simd = tree::simd<S>;
  static constexpr auto lanes = static_cast<Eigen::Index>(tree::simd_of<S>::count);
  S& at(Eigen::Index i, Eigen::Index j) { return A_[static_cast<std::size_t>(j * stride_ + i)]; }

  std::vector<S> A_, U_;        ///< columns of W and a row of -b, which become L D; (L D)^T
  std::vector<S> x_, inverse_;  ///< L^-1 (-b); 1/D
  Eigen::Index stride_ = 0;
};

}  // namespace kte::detail
