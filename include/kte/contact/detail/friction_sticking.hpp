#pragma once

#include <kte/contact/detail/friction_system.hpp>
#include <kte/detail/unroll.hpp>
#include <kte/tree/simd.hpp>

namespace kte::detail {

/// The solution of a friction problem where all contacts stick, W lambda = -b, by W = L D L^T.
template <class S>
class friction_sticking {
 public:
  /// Writes lambda. Returns false if W is nearly singular.
  bool solve(const friction_system<S>& p, S* lambda) {
    switch (p.size / lanes) {
      case 0:
        return solve_by<1>(p, lambda);
      case 1:
        return solve_by<2>(p, lambda);
      case 2:
        return solve_by<3>(p, lambda);
      case 3:
        return solve_by<4>(p, lambda);
      default:
        return solve_by<0>(p, lambda);
    }
  }

 private:
  using simd = tree::simd<S>;
  static constexpr auto lanes = static_cast<Eigen::Index>(tree::simd_of<S>::count);

  /// With columns of `Registers` registers; 0: of any number.
  template <int Registers>
  bool solve_by(const friction_system<S>& p, S* lambda) {
    const Eigen::Index n = p.size, stride = Registers > 0 ? Registers * lanes : (n / lanes + 1) * lanes;
    const S least = p.unit * S(1e-7);
    for (auto* to : {&A_, &U_}) to->resize(static_cast<std::size_t>(n * stride));
    x_.resize(static_cast<std::size_t>(stride)), inverse_.resize(static_cast<std::size_t>(n));
    S *const a = A_.data(), *const u = U_.data(), *const x = x_.data(), *const inverse = inverse_.data();
    for (Eigen::Index j = 0; j < n; ++j) {
      const S* const w = p.column(j);
      S* const to = a + j * stride;
      Eigen::Index i = 0;
      for (; i + lanes <= n; i += lanes) {
        simd y;
        tree::load<S>(y, w + i), tree::store<S>(y, to + i);
      }
      for (; i < n; ++i) to[i] = w[i];
      to[n] = -p.b[j];
      for (++i; i < stride; ++i) to[i] = S(0);
    }
    for (Eigen::Index k = 0; k < n; ++k) {
      const S* const own = a + k * stride;
      if (!(own[k] > least)) return false;
      inverse[k] = S(1) / own[k];
      for (Eigen::Index j = k + 1; j < n; ++j) {
        S* const to = a + j * stride;
        // Whole columns are eliminated in registers, only their lower parts otherwise
        const S below = Registers > 0 ? to[k] : own[j], factor = below * inverse[k];
        u[j * stride + k] = below;
        subtract<Registers>(factor, own, to, Registers > 0 ? 0 : j / lanes * lanes, stride);
      }
    }
    for (Eigen::Index k = 0; k < n; ++k) x[k] = a[k * stride + n];
    for (Eigen::Index k = n; k-- > 0;) {
      lambda[k] = x[k] * inverse[k];
      subtract<Registers>(lambda[k], u + k * stride, x, 0, Registers > 0 ? stride : k);
    }
    return true;
  }
  /// y <- y - factor x, from number `first` on.
  template <int Registers>
  KTE_INLINE static void subtract(const S& factor, const S* x, S* y, Eigen::Index first, Eigen::Index end) {
    const auto one = [&](Eigen::Index i) KTE_INLINE_LAMBDA {
      simd a, b;
      tree::load<S>(a, x + i), tree::load<S>(b, y + i);
      b = b - factor * a;
      tree::store<S>(b, y + i);
    };
    if constexpr (Registers > 0)
      unroll<Registers>([&]<int R>() KTE_INLINE_LAMBDA { one(R * lanes); });
    else
      for (Eigen::Index i = first; i < end; i += lanes) one(i);
  }

  std::vector<S> A_, U_;        ///< columns of W and a row of -b, which become L D; (L D)^T
  std::vector<S> x_, inverse_;  ///< L^-1 (-b); 1/D
};

}  // namespace kte::detail
