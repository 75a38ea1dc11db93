#pragma once

#include <kte/integrators/fixed_step_runge_kutta.hpp>

namespace kte {

/// Runge, Math. Ann. 46 (1895), 167-178. The interpolant is the only one of order 2.
struct midpoint_tableau {
  static constexpr std::size_t stages = 2;
  static constexpr int order = 2, dense_order = 2;
  using row = tableau_row<stages>;
  static constexpr row c{{{0, 1}, {1, 2}}};
  static constexpr std::array<row, stages> a{{{}, {{{1, 2}}}}};
  static constexpr row weights{{{}, {1, 1}}};
  static constexpr std::array<row, 2> interpolant{{{{{1, 1}}}, {{{-1, 1}, {1, 1}}}}};
};

/// The explicit midpoint rule of order 2 with a fixed step, two evaluations a step.
template <class F, class X>
class midpoint : public fixed_step_runge_kutta<midpoint_tableau, F, X> {
 public:
  using fixed_step_runge_kutta<midpoint_tableau, F, X>::fixed_step_runge_kutta;
};

template <class F, class V>
midpoint(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&, const typename V::Scalar&)
    -> midpoint<F, typename V::PlainObject>;

}  // namespace kte
