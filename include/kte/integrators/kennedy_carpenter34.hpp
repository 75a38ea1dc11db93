#pragma once

#include <kte/integrators/esdirk.hpp>

namespace kte {

/// ESDIRK4(3)6L[2]SA of Kennedy and Carpenter, Additive Runge-Kutta schemes for convection-diffusion-reaction
/// equations, Appl. Numer. Math. 44 (2003): order 4, L-stable, with an error of order 4 in h.
struct kennedy_carpenter34_tableau {
  static constexpr std::size_t stages = 6;
  static constexpr int order = 4, embedded_order = 3, dense_order = 3, order_of_error = 4;
  static constexpr ratio newton_tolerance{1, 200};
  static constexpr bool filter_error = false;
  using row = tableau_row<stages>;

  static constexpr row c{{{0, 1}, {1, 2}, {83, 250}, {31, 50}, {17, 20}, {1, 1}}};
  static constexpr std::array<row, stages> a{{
      {},
      {{{1, 4}, {1, 4}}},
      {{{8611, 62500}, {-1743, 31250}, {1, 4}}},
      {{{5012029, 34652500}, {-654441, 2922500}, {174375, 388108}, {1, 4}}},
      {{{15267082809, 155376265600}, {-71443401, 120774400}, {730878875, 902184768}, {2285395, 8070912}, {1, 4}}},
      {{{82889, 524892}, {}, {15625, 83664}, {69875, 102672}, {-2260, 8211}, {1, 4}}},
  }};
  static constexpr row embedded{{{4586570599, 29645900160},
                                 {},
                                 {178811875, 945068544},
                                 {814220225, 1159782912},
                                 {-3700637, 11593932},
                                 {61727, 225920}}};

  template <class S>
  static esdirk_table<S, stages> table() {
    const auto scalar = [](const ratio& r) { return S(S(r.num) / S(r.den)); };
    esdirk_table<S, stages> k{S(0.25)};
    for (std::size_t i = 0; i < stages; ++i) {
      k.c[i] = scalar(c[i]);
      for (std::size_t j = 0; j < stages; ++j) k.a[i][j] = scalar(a[i][j]);
      k.e[i] = scalar(a.back()[i]) - scalar(embedded[i]);
    }
    return k;
  }
};

/// ESDIRK method of order 4 for stiff systems at tolerances of 1e-4 to 1e-8 with an expensive Jacobian: the Jacobian
/// and its factors are kept from step to step. About twelve evaluations a step.
///
///   kte::kennedy_carpenter34 solver(f, 0.0, x0, {.absolute = 1e-6, .relative = 1e-6});
///   solver.integrate(10.0);
template <class F, class X>
class kennedy_carpenter34 : public esdirk<kennedy_carpenter34_tableau, F, X> {
 public:
  using esdirk<kennedy_carpenter34_tableau, F, X>::esdirk;
};

template <class F, class V>
kennedy_carpenter34(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&,
                    const tolerances<detail::time_scalar<typename V::Scalar>>& = {})
    -> kennedy_carpenter34<F, typename V::PlainObject>;

}  // namespace kte
