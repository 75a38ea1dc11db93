#pragma once

#include <kte/integrators/rosenbrock.hpp>

namespace kte {

/// The modified Rosenbrock pair of Shampine and Reichelt, The MATLAB ODE Suite, SIAM J. Sci. Comput. 18 (1997), section
/// 3: order 2, L-stable, with an error of order 3 in h and a dense output of order 2. It stays of order 2 with any
/// matrix instead of the Jacobian. With k_i the slopes of the paper, and d, e_32 its numbers:
///
///   gamma = d = 1 / (2 + sqrt 2),   e_32 = 6 + sqrt 2
///   h k_1 = u_1 / d,   h k_2 = (u_1 + u_2) / d,   h k_3 = (2 u_1 + e_32 u_2 + u_3) / d
struct rosenbrock23_coefficients {
  static constexpr std::size_t stages = 3;
  static constexpr int order = 2, embedded_order = 3, dense_order = 2, order_of_error = 3;
  static constexpr bool first_same_as_last = true;

  /// The coefficients in the scalar S.
  template <class S>
  static rosenbrock_table<S, stages, 2> table() {
    using std::sqrt;
    const S root = sqrt(S(2)), r = 2 + root, d = 1 / r, e32 = 6 + root;
    rosenbrock_table<S, stages, 2> k{d};
    k.alpha = {S(0), S(0.5), S(1)};
    k.gammas = {d, S(0), S(-d)};
    k.a[1] = {S(r / 2)};
    k.a[2] = k.m = {r, r};
    k.c[1] = {S(-r)};
    k.c[2] = {S(-2 * r), S(-e32 * r)};
    k.e = {S(-r / 6), S((2 - e32) * r / 6), S(-r / 6)};  // -(k_1 - 2 k_2 + k_3) h / 6
    const S q = r / (1 - 2 * d);
    k.dense[0] = {r, S(-2 * d * q)};  // [theta (1 - theta) k_1 + theta (theta - 2 d) k_2] h / (1 - 2 d)
    k.dense[1] = {S(0), q};
    return k;
  }
};

/// Rosenbrock method of order 2 for stiff systems at loose tolerances, 1e-2 to 1e-4: two evaluations, one Jacobian and
/// one df/dt a step.
///
///   kte::rosenbrock23 solver(f, 0.0, x0, {.absolute = 1e-4, .relative = 1e-4});
///   solver.integrate(10.0);
template <class F, class X>
class rosenbrock23 : public rosenbrock<rosenbrock23_coefficients, F, X> {
 public:
  using rosenbrock<rosenbrock23_coefficients, F, X>::rosenbrock;
};

template <class F, class V>
rosenbrock23(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&,
             const tolerances<detail::time_scalar<typename V::Scalar>>& = {})
    -> rosenbrock23<F, typename V::PlainObject>;

}  // namespace kte
