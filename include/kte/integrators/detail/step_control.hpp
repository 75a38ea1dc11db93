#pragma once

#include <kte/integrators/tolerances.hpp>

#include <cmath>

namespace kte {

namespace detail {

/// `error_norm` if it is not finite: computed again, without components with w_i = 0.
template <class S, class E, class X>
[[gnu::cold, gnu::noinline]] S error_norm_without_zeros(const tolerances<S>& tol, const E& e, const X& x0,
                                                        const X& x1) {
  using std::abs;
  using std::sqrt;
  using scalar = typename E::Scalar;
  scalar sum(0);
  for (Eigen::Index i = 0; i < e.size(); ++i) {
    const scalar a = abs(x0[i]), b = abs(x1[i]), w = tol.absolute[i] + tol.relative[i] * select(a < b, b, a);
    const scalar r = select(w == scalar(0), scalar(0), scalar(e.coeff(i) / w));
    sum += r * r;
  }
  return sqrt(S(largest_lane(sum) / S(static_cast<double>(e.size()))));
}

/// n times the square of (1).
template <class S, class E, class X>
typename E::Scalar squared_error(const tolerances<S>& tol, const E& e, const X& x0, const X& x1) {
  using std::abs;
  using scalar = typename E::Scalar;
  scalar sum(0);
  for (Eigen::Index i = 0; i < e.size(); ++i) {
    const scalar a = abs(x0[i]), b = abs(x1[i]);
    const scalar r = e.coeff(i) / (tol.absolute[i] + tol.relative[i] * select(a < b, b, a));
    sum += r * r;
  }
  return sum;
}

/// The norm of the error e of a step from x0 to x1, which is at most 1 within the tolerances:
///
///   |e| = sqrt(1/n sum_i (e_i / w_i)^2),   w_i = absolute_i + relative_i max(|x0_i|, |x1_i|)      (1)
///
/// Components that are and stay 0, with an absolute tolerance of 0, are excluded. In packs it is the largest norm of
/// all lanes.
///
/// Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, 1993, II.4, (4.10), (4.11).
template <class S, class E, class X>
S error_norm(const tolerances<S>& tol, const E& e, const X& x0, const X& x1) {
  using std::sqrt;
  const auto sum = squared_error(tol, e, x0, x1);
  if (!is_finite(sum)) [[unlikely]]
    return error_norm_without_zeros(tol, e, x0, x1);
  return sqrt(S(largest_lane(sum) / S(static_cast<double>(e.size()))));
}
/// (1) of each lane; not finite also for components that are and stay 0.
template <class S, class E, class X>
auto lane_norms(const tolerances<S>& tol, const E& e, const X& x0, const X& x1) {
  using scalar = typename E::Scalar;
  return sqrt(squared_error(tol, e, x0, x1) / scalar(static_cast<double>(e.size())));
}

/// The factor from one step to the next, for a step error of order h^k. err_n is the norm (1) of the error, err_{n-1}
/// that of the previous accepted step:
///
///   accepted:  0.9 err_n^-(1/k - 3/4 beta) err_{n-1}^beta,  0.2 to 10, at most 1 after a rejection      (2)
///   rejected:  0.9 err_n^-(1/k),  0.2 to 1                                                              (3)
///
/// with beta = 1/(5 k): a proportional-integral controller (Hairer, Norsett and Wanner, II.4 (4.13); Gustafsson 1991).
template <class S>
class step_controller {
 public:
  explicit step_controller(int k) : k_(S(k)) {}

  S accepted(const S& error, bool after_rejection) {
    using std::pow;
    const S e = error < S(1e-10) ? S(1e-10) : error;
    const S beta = 1 / (5 * k_);
    const S factor = S(0.9) * pow(e, S(beta * S(0.75) - 1 / k_)) * pow(previous_, beta);  // (2)
    previous_ = e < S(1e-4) ? S(1e-4) : e;
    return clamp(factor, after_rejection ? S(1) : S(10));
  }
  /// Accepts NaN.
  S rejected(const S& error) const {
    using std::pow;
    return is_finite(error) ? clamp(S(S(0.9) * pow(error, S(-1 / k_))), S(1)) : S(0.2);  // (3)
  }

 private:
  static S clamp(const S& factor, const S& most) { return factor < S(0.2) ? S(0.2) : factor < most ? factor : most; }

  S k_;
  S previous_ = S(1e-4);
};

/// A first step of about the right size, from the derivatives f0 at the start and f1 after a small Euler step h0. d0,
/// d1, d2: norms (1), with x1 = x0, of x0, of f0, and of (f1 - f0) / h0.
///
///   h0 = 0.01 d0 / d1,   1e-6 if d0 or d1 is below 1e-5                                          (4)
///   h1 = (0.01 / max(d1, d2))^(1/k),   max(1e-6, h0 / 1000) if d1 and d2 are below 1e-15         (5)
///   h = min(100 h0, h1)                                                                          (6)
///
/// Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, 1993, II.4, "starting step size".
template <class S>
S trial_step(const S& d0, const S& d1) {
  return d0 < S(1e-5) || d1 < S(1e-5) ? S(1e-6) : S(S(0.01) * d0 / d1);  // (4)
}
template <class S>
S first_step(const S& h0, const S& d1, const S& d2, int k) {
  using std::pow;
  const S d = d1 < d2 ? d2 : d1;
  const S least = h0 < S(1e-3) ? S(1e-6) : S(h0 / 1000);
  const S h1 = d > S(1e-15) ? S(pow(S(S(0.01) / d), S(1 / S(k)))) : least;  // (5)
  return h1 < 100 * h0 ? h1 : S(100 * h0);                                  // (6)
}

}  // namespace detail
}  // namespace kte
