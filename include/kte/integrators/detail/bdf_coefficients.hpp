#pragma once

#include <kte/integrators/tableau.hpp>

#include <array>
#include <limits>

namespace kte {

/// The family of formulas of `bdf`.
enum class bdf_formula {
  numerical_differentiation,  ///< NDF: steps longer by 26 % at orders 1 to 3, 12 % at order 4, none at 5
  backward_differentiation    ///< BDF: more stable at orders 3 and 4
};

namespace detail {

/// The formulas of order k in backward differences D^j x_n of step h, for x_{n+1} = p + d, p = sum_{j=0}^k D^j x_n:
///
///   sum_{j=1}^k 1/j D^j x_{n+1} - kappa g_k d = h f(t_{n+1}, x_{n+1}),   g_j = 1 + 1/2 + ... + 1/j      (1)
///   d = c f(t_{n+1}, p + d) - sum_{j=1}^k w_j D^j x_n,   c = h / ((1 - kappa) g_k),   w_j = c g_j / h    (2)
///   C_k = kappa g_k + 1 / (k + 1)                                                                        (3)
///
/// (2) is (1) solved for d = D^{k+1} x_{n+1}. The local error of a step is C_k d. kappa = 0 gives the BDF. The NDF have
/// a smaller C_k and less stability: A-stable at orders 1 and 2; at orders 3, 4, 5 stable within 80, 66, 51 degrees of
/// the negative real axis (BDF: 86, 73, 51).
///
/// Shampine and Reichelt, The MATLAB ODE Suite, SIAM J. Sci. Comput. 18 (1997), section 2.
template <class S>
class bdf_coefficients {
 public:
  static constexpr int most = 5;

  explicit bdf_coefficients(bdf_formula formula) {
    constexpr std::array<ratio, most + 1> kappa{{{}, {-185, 1000}, {-1, 9}, {-823, 10000}, {-415, 10000}, {}}};
    harmonic_[0] = S(0);
    for (int k = 1; k <= most; ++k) {
      const ratio r = formula == bdf_formula::backward_differentiation ? ratio{} : kappa[at(k)];
      const S part = S(r.num) / S(r.den);
      harmonic_[at(k)] = harmonic_[at(k - 1)] + 1 / S(k);
      leading_[at(k)] = (1 - part) * harmonic_[at(k)];
      error_[at(k)] = part * harmonic_[at(k)] + 1 / S(k + 1);
    }
  }

  /// c / h.
  S slope(int k) const { return 1 / leading_[at(k)]; }
  /// w_j.
  S history(int k, int j) const { return harmonic_[at(j)] / leading_[at(k)]; }
  /// The largest w h at which an undamped oscillation of w rad/s grows by less than 2e-4 per step: the largest root of
  /// (1) for f = i w x. Infinite at orders 1 and 2.
  static S stable_angle(int k) {
    return k < 3 ? std::numeric_limits<S>::infinity() : k == 3 ? S(0.2) : k == 4 ? S(0.3) : S(0.7);
  }
  /// C_k.
  const S& error(int k) const { return error_[at(k)]; }

 private:
  static std::size_t at(int k) { return static_cast<std::size_t>(k); }

  std::array<S, most + 1> harmonic_, leading_, error_;
};

}  // namespace detail
}  // namespace kte
