#pragma once

#include <kte/integrators/esdirk.hpp>

namespace kte {

/// The trapezoidal rule, x1 = x + h (f(t, x) + f(t + h, x1)) / 2: order 2, A-stable, without damping. Its error is -h^3
/// x''' / 12; the cubic between step ends is a quadratic.
struct trapezoidal_tableau {
  static constexpr std::size_t stages = 2;
  static constexpr int order = 2, dense_order = 2, order_of_error = 3;
  static constexpr ratio newton_tolerance{1, 20};
  static constexpr bool filter_error = true;
  static constexpr ratio error_constant{-1, 12};

  template <class S>
  static esdirk_table<S, stages> table() {
    esdirk_table<S, stages> k{S(0.5)};
    k.c = {S(0), S(1)};
    k.a[1] = {S(0.5), S(0.5)};
    return k;
  }
};

/// The trapezoidal rule, for oscillations that must not be damped, in moderately stiff systems at loose tolerances.
/// Modes that are too fast for the step alternate in sign from step to step.
///
///   kte::trapezoidal solver(f, 0.0, x0, {.absolute = 1e-4, .relative = 1e-4});
///   solver.integrate(10.0);
template <class F, class X>
class trapezoidal : public esdirk<trapezoidal_tableau, F, X> {
 public:
  using esdirk<trapezoidal_tableau, F, X>::esdirk;
};

template <class F, class V>
trapezoidal(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&,
            const tolerances<detail::time_scalar<typename V::Scalar>>& = {}) -> trapezoidal<F, typename V::PlainObject>;

}  // namespace kte
