#pragma once

#include <kte/integrators/embedded_runge_kutta.hpp>

namespace kte {

/// Fehlberg, Klassische Runge-Kutta-Formeln vierter und niedrigerer Ordnung mit Schrittweiten-Kontrolle, Computing 6
/// (1970), 61-71: the formula 4(5) of table 2. The seventh stage is the slope at the end.
struct fehlberg45_tableau {
  static constexpr std::size_t stages = 7;
  static constexpr int order = 4, embedded_order = 5, dense_order = 3, order_of_error = 5;
  using row = tableau_row<stages>;

  static constexpr row c{{{0, 1}, {1, 4}, {3, 8}, {12, 13}, {1, 1}, {1, 2}, {1, 1}}};
  static constexpr std::array<row, stages> a{{
      {},
      {{{1, 4}}},
      {{{3, 32}, {9, 32}}},
      {{{1932, 2197}, {-7200, 2197}, {7296, 2197}}},
      {{{439, 216}, {-8, 1}, {3680, 513}, {-845, 4104}}},
      {{{-8, 27}, {2, 1}, {-3544, 2565}, {1859, 4104}, {-11, 40}}},
      {{{25, 216}, {}, {1408, 2565}, {2197, 4104}, {-1, 5}}},
  }};
  static constexpr row embedded{{{16, 135}, {}, {6656, 12825}, {28561, 56430}, {-9, 50}, {2, 55}}};
};

/// The method of Fehlberg of order 4, without local extrapolation. The difference to the solution of order 5 controls
/// the step. Six evaluations a step.
template <class F, class X>
class fehlberg45 : public embedded_runge_kutta<fehlberg45_tableau, F, X> {
 public:
  using embedded_runge_kutta<fehlberg45_tableau, F, X>::embedded_runge_kutta;
};

template <class F, class V>
fehlberg45(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&,
           const tolerances<detail::time_scalar<typename V::Scalar>>& = {})
    -> fehlberg45<detail::system_of<F, typename V::PlainObject>, typename V::PlainObject>;

}  // namespace kte
