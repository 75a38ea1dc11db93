#pragma once

#include <kte/integrators/fixed_step_runge_kutta.hpp>

namespace kte {

/// Butcher, On Runge-Kutta processes of high order, J. Austral. Math. Soc. 4 (1964), 179-194. The interpolant is the
/// only one of order 4 and degree 4 with the slope k_1 at the start.
struct runge_kutta5_tableau {
  static constexpr std::size_t stages = 6;
  static constexpr int order = 5, dense_order = 4;
  using row = tableau_row<stages>;
  static constexpr row c{{{0, 1}, {1, 4}, {1, 4}, {1, 2}, {3, 4}, {1, 1}}};
  static constexpr std::array<row, stages> a{{
      {},
      {{{1, 4}}},
      {{{1, 8}, {1, 8}}},
      {{{}, {-1, 2}, {1, 1}}},
      {{{3, 16}, {}, {}, {9, 16}}},
      {{{-3, 7}, {2, 7}, {12, 7}, {-12, 7}, {8, 7}}},
  }};
  static constexpr row weights{{{7, 90}, {}, {16, 45}, {2, 15}, {16, 45}, {7, 90}}};
  static constexpr std::array<row, 4> interpolant{{
      {{{1, 1}}},
      {{{-89, 30}, {}, {16, 5}, {6, 5}, {-32, 15}, {7, 10}}},
      {{{142, 45}, {}, {-208, 45}, {-12, 5}, {272, 45}, {-98, 45}}},
      {{{-10, 9}, {}, {16, 9}, {4, 3}, {-32, 9}, {14, 9}}},
  }};
};

/// The method of Butcher of order 5 with a fixed step, six evaluations a step.
template <class F, class X>
class runge_kutta5 : public fixed_step_runge_kutta<runge_kutta5_tableau, F, X> {
 public:
  using fixed_step_runge_kutta<runge_kutta5_tableau, F, X>::fixed_step_runge_kutta;
};

template <class F, class V>
runge_kutta5(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&, const typename V::Scalar&)
    -> runge_kutta5<detail::system_of<F, typename V::PlainObject>, typename V::PlainObject>;

}  // namespace kte
