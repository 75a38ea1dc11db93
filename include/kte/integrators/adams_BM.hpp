#pragma once

#include <kte/integrators/adams_bashforth_moulton.hpp>
#include <kte/integrators/runge_kutta4.hpp>
#include <kte/integrators/runge_kutta5.hpp>

namespace kte {

/// Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, 1993, III.1: explicit of k = 3
/// and implicit of k = 2. Started by the method of Kutta of order 4.
struct adams_BM3_formula {
  static constexpr std::size_t order = 3;
  static constexpr tableau_row<4> predictor{{{}, {23, 12}, {-4, 3}, {5, 12}}};
  static constexpr tableau_row<4> corrector{{{5, 12}, {2, 3}, {-1, 12}}};
  static constexpr std::array<tableau_row<4>, 3> interpolant{{
      {{{}, {1, 1}}},
      {{{1, 4}, {}, {-1, 4}}},
      {{{1, 6}, {-1, 3}, {1, 6}}},
  }};
  using start = runge_kutta4_tableau;
};

/// The formulas with k = 5 and k = 4; started by the method of Butcher of order 5.
struct adams_BM5_formula {
  static constexpr std::size_t order = 5;
  static constexpr tableau_row<6> predictor{{{}, {1901, 720}, {-1387, 360}, {109, 30}, {-637, 360}, {251, 720}}};
  static constexpr tableau_row<6> corrector{{{251, 720}, {323, 360}, {-11, 30}, {53, 360}, {-19, 720}}};
  static constexpr std::array<tableau_row<6>, 5> interpolant{{
      {{{}, {1, 1}}},
      {{{1, 8}, {5, 12}, {-3, 4}, {1, 4}, {-1, 24}}},
      {{{11, 72}, {-5, 18}, {1, 12}, {1, 18}, {-1, 72}}},
      {{{1, 16}, {-5, 24}, {1, 4}, {-1, 8}, {1, 48}}},
      {{{1, 120}, {-1, 30}, {1, 20}, {-1, 30}, {1, 120}}},
  }};
  using start = runge_kutta5_tableau;
};

/// Adams-Bashforth-Moulton method of order 3 with a fixed step: two evaluations a step. Dense output of order 3.
///
///   kte::adams_BM3 solver(f, 0.0, x0, 0.001);
///   solver.integrate(10.0);
template <class F, class X>
class adams_BM3 : public adams_bashforth_moulton<adams_BM3_formula, F, X> {
 public:
  using adams_bashforth_moulton<adams_BM3_formula, F, X>::adams_bashforth_moulton;
};

template <class F, class V>
adams_BM3(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&, const typename V::Scalar&)
    -> adams_BM3<F, typename V::PlainObject>;

/// Adams-Bashforth-Moulton method of order 5 with a fixed step: two evaluations a step. Dense output of order 5; in the
/// starting steps (Runge-Kutta 5), of the order of the error at the step ends.
template <class F, class X>
class adams_BM5 : public adams_bashforth_moulton<adams_BM5_formula, F, X> {
 public:
  using adams_bashforth_moulton<adams_BM5_formula, F, X>::adams_bashforth_moulton;
};

template <class F, class V>
adams_BM5(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&, const typename V::Scalar&)
    -> adams_BM5<F, typename V::PlainObject>;

}  // namespace kte
