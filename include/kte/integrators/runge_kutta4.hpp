#pragma once

#include <kte/integrators/fixed_step_runge_kutta.hpp>

namespace kte {

/// Kutta, Z. Math. Phys. 46 (1901), 435-453. Interpolant of order 3: Hairer, Norsett and Wanner, Solving Ordinary
/// Differential Equations I, 1993, II.6, (6.6).
struct runge_kutta4_tableau {
  static constexpr std::size_t stages = 4;
  static constexpr int order = 4, dense_order = 3;
  using row = tableau_row<stages>;
  static constexpr row c{{{0, 1}, {1, 2}, {1, 2}, {1, 1}}};
  static constexpr std::array<row, stages> a{{{}, {{{1, 2}}}, {{{}, {1, 2}}}, {{{}, {}, {1, 1}}}}};
  static constexpr row weights{{{1, 6}, {1, 3}, {1, 3}, {1, 6}}};
  static constexpr std::array<row, 3> interpolant{{
      {{{1, 1}}},
      {{{-3, 2}, {1, 1}, {1, 1}, {-1, 2}}},
      {{{2, 3}, {-2, 3}, {-2, 3}, {2, 3}}},
  }};
};

/// The method of Kutta of order 4 with a fixed step, four evaluations a step.
template <class F, class X>
class runge_kutta4 : public fixed_step_runge_kutta<runge_kutta4_tableau, F, X> {
 public:
  using fixed_step_runge_kutta<runge_kutta4_tableau, F, X>::fixed_step_runge_kutta;
};

template <class F, class V>
runge_kutta4(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&, const typename V::Scalar&)
    -> runge_kutta4<detail::system_of<F, typename V::PlainObject>, typename V::PlainObject>;

}  // namespace kte

#ifdef KTE_EXTERN
namespace kte {
KTE_EXTERN template class fixed_step_runge_kutta<runge_kutta4_tableau, detail::erased_system<true>, Eigen::VectorXd>;
KTE_EXTERN template class integrator<
    fixed_step_runge_kutta<runge_kutta4_tableau, detail::erased_system<true>, Eigen::VectorXd>,
    detail::erased_system<true>, Eigen::VectorXd>;
}  // namespace kte
#endif
