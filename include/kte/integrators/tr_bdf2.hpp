#pragma once

#include <kte/integrators/esdirk.hpp>

namespace kte {

/// The trapezoidal rule to t + (2 - sqrt 2) h, then the second backward differentiation formula to t + h: order 2,
/// L-stable. Bank et al., Transient simulation of silicon devices and circuits, IEEE Trans. CAD 4 (1985). Written as
/// one Runge-Kutta method, with an error of order 3 in h: Hosea and Shampine, Analysis and implementation of TR-BDF2,
/// Appl. Numer. Math. 20 (1996).
struct tr_bdf2_tableau {
  static constexpr std::size_t stages = 3;
  static constexpr int order = 2, embedded_order = 3, dense_order = 2, order_of_error = 3;
  static constexpr ratio newton_tolerance{1, 20};
  static constexpr bool filter_error = true;

  template <class S>
  static esdirk_table<S, stages> table() {
    using std::sqrt;
    const S root = sqrt(S(2)), d = 1 - root / 2, w = root / 4;
    esdirk_table<S, stages> k{d};
    k.c = {S(0), S(2 * d), S(1)};
    k.a[1] = {d, d};
    k.a[2] = {w, w, d};
    k.e = {S((4 * w - 1) / 3), S(-S(1) / 3), S(2 * d / 3)};  // minus (1 - w, 3 w + 1, d) / 3
    return k;
  }
};

/// TR-BDF2, order 2, for stiff systems at loose tolerances, 1e-2 to 1e-5, with an expensive Jacobian: the Jacobian and
/// its factors are kept from step to step.
///
///   kte::tr_bdf2 solver(f, 0.0, x0, {.absolute = 1e-4, .relative = 1e-4});
///   solver.integrate(10.0);
template <class F, class X>
class tr_bdf2 : public esdirk<tr_bdf2_tableau, F, X> {
 public:
  using esdirk<tr_bdf2_tableau, F, X>::esdirk;
};

template <class F, class V>
tr_bdf2(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&,
        const tolerances<detail::time_scalar<typename V::Scalar>>& = {}) -> tr_bdf2<F, typename V::PlainObject>;

}  // namespace kte
