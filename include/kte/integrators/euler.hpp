#pragma once

#include <kte/integrators/fixed_step_runge_kutta.hpp>

namespace kte {

/// The coefficients of Euler's method; the interpolant is linear.
struct euler_tableau {
  static constexpr std::size_t stages = 1;
  static constexpr int order = 1, dense_order = 1;
  using row = tableau_row<stages>;
  static constexpr row c{};
  static constexpr std::array<row, stages> a{};
  static constexpr row weights{{{1, 1}}};
  static constexpr std::array<row, 1> interpolant{{{{{1, 1}}}}};
};

/// Euler's method of order 1 with a fixed step.
///
///   kte::euler solver(f, 0.0, x0, 0.001);
///   solver.integrate(10.0);
template <class F, class X>
class euler : public fixed_step_runge_kutta<euler_tableau, F, X> {
 public:
  using fixed_step_runge_kutta<euler_tableau, F, X>::fixed_step_runge_kutta;
};

template <class F, class V>
euler(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&, const typename V::Scalar&)
    -> euler<F, typename V::PlainObject>;

}  // namespace kte
