#pragma once

#include <kte/integrators/embedded_runge_kutta.hpp>

namespace kte {

/// Bogacki and Shampine, A 3(2) pair of Runge-Kutta formulas, Appl. Math. Letters 2 (1989), 321-325.
struct bogacki_shampine23_tableau {
  static constexpr std::size_t stages = 4;
  static constexpr int order = 3, embedded_order = 2, dense_order = 3, order_of_error = 3;
  using row = tableau_row<stages>;

  static constexpr row c{{{0, 1}, {1, 2}, {3, 4}, {1, 1}}};
  static constexpr std::array<row, stages> a{{{}, {{{1, 2}}}, {{{}, {3, 4}}}, {{{2, 9}, {1, 3}, {4, 9}}}}};
  static constexpr row embedded{{{7, 24}, {1, 4}, {1, 3}, {1, 8}}};
};

/// The method of Bogacki and Shampine of order 3 with an embedded solution of order 2: three evaluations a step. For
/// loose tolerances.
template <class F, class X>
class bogacki_shampine23 : public embedded_runge_kutta<bogacki_shampine23_tableau, F, X> {
 public:
  using embedded_runge_kutta<bogacki_shampine23_tableau, F, X>::embedded_runge_kutta;
};

template <class F, class V>
bogacki_shampine23(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&,
                   const tolerances<detail::time_scalar<typename V::Scalar>>& = {})
    -> bogacki_shampine23<detail::system_of<F, typename V::PlainObject>, typename V::PlainObject>;

}  // namespace kte
