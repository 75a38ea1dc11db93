#pragma once

#include <kte/integrators/embedded_runge_kutta.hpp>

namespace kte {

/// Dormand and Prince, A family of embedded Runge-Kutta formulae, J. Comp. Appl. Math. 6 (1980), 19-26: RK5(4)7M.
/// Dense output of order 4: Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, 1993, II.6.
struct dormand_prince45_tableau {
  static constexpr std::size_t stages = 7;
  static constexpr int order = 5, embedded_order = 4, dense_order = 4, order_of_error = 5;
  using row = tableau_row<stages>;

  static constexpr row c{{{0, 1}, {1, 5}, {3, 10}, {4, 5}, {8, 9}, {1, 1}, {1, 1}}};
  static constexpr std::array<row, stages> a{{
      {},
      {{{1, 5}}},
      {{{3, 40}, {9, 40}}},
      {{{44, 45}, {-56, 15}, {32, 9}}},
      {{{19372, 6561}, {-25360, 2187}, {64448, 6561}, {-212, 729}}},
      {{{9017, 3168}, {-355, 33}, {46732, 5247}, {49, 176}, {-5103, 18656}}},
      {{{35, 384}, {}, {500, 1113}, {125, 192}, {-2187, 6784}, {11, 84}}},
  }};
  static constexpr row embedded{{{5179, 57600}, {}, {7571, 16695}, {393, 640}, {-92097, 339200}, {187, 2100}, {1, 40}}};
  static constexpr row dense{{{-12715105075, 11282082432},
                              {},
                              {87487479700, 32700410799},
                              {-10690763975, 1880347072},
                              {701980252875, 199316789632},
                              {-1453857185, 822651844},
                              {69997945, 29380423}}};
};

/// The method of Dormand and Prince of order 5 with an embedded solution of order 4: six evaluations a step.
///
///   kte::dormand_prince45 solver(f, 0.0, x0, {.absolute = 1e-9, .relative = 1e-9});
///   solver.integrate(10.0);
///   solver.integrate(20.0, kte::every(0.001), [](double t, const auto& x) { ... });
template <class F, class X>
class dormand_prince45 : public embedded_runge_kutta<dormand_prince45_tableau, F, X> {
 public:
  using embedded_runge_kutta<dormand_prince45_tableau, F, X>::embedded_runge_kutta;
};

template <class F, class V>
dormand_prince45(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&,
                 const tolerances<detail::time_scalar<typename V::Scalar>>& = {})
    -> dormand_prince45<detail::system_of<F, typename V::PlainObject>, typename V::PlainObject>;

}  // namespace kte

#ifdef KTE_EXTERN
namespace kte {
KTE_EXTERN template class embedded_runge_kutta<dormand_prince45_tableau, detail::erased_system<true>, Eigen::VectorXd>;
KTE_EXTERN template class embedded_runge_kutta<dormand_prince45_tableau, detail::erased_system<false>, Eigen::VectorXd>;
KTE_EXTERN template class integrator<
    embedded_runge_kutta<dormand_prince45_tableau, detail::erased_system<true>, Eigen::VectorXd>,
    detail::erased_system<true>, Eigen::VectorXd>;
KTE_EXTERN template class integrator<
    embedded_runge_kutta<dormand_prince45_tableau, detail::erased_system<false>, Eigen::VectorXd>,
    detail::erased_system<false>, Eigen::VectorXd>;
}  // namespace kte
#endif
