#pragma once

#include <kte/integrators/rosenbrock.hpp>

namespace kte {

/// RODAS of Hairer and Wanner, Solving Ordinary Differential Equations II, 1996, VI.4: order 4, stiffly accurate and
/// L-stable, with an error of order 4 in h and a dense output of order 3.
///
/// The published numbers have 16 digits. These are the nearest ones (within 1e-14) that satisfy the conditions of the
/// method to 21 digits: those of order 4, of order 3 for the error and the dense output, and of index 1.
struct rodas_coefficients {
  static constexpr std::size_t stages = 6;
  static constexpr int order = 4, embedded_order = 3, dense_order = 3, order_of_error = 4;
  static constexpr bool first_same_as_last = false;

  /// The coefficients in the scalar S.
  template <class S>
  static rosenbrock_table<S, stages, 3> table() {
    rosenbrock_table<S, stages, 3> k{S(0.25)};
    k.alpha = row<S>({0, 0.386L, 0.21L, 0.63L, 1, 1});
    k.gammas = row<S>({0.25L, -0.1043L, 0.1035L, -0.0362L, 0, 0});
    k.a[1] = row<S>({1.544L});
    k.a[2] = row<S>({0.9466785280815826098371L, 0.2557011698983284032528L});
    k.a[3] = row<S>({3.314825187068519141578L, 2.896124015972201670117L, 0.998641913997785978732L});
    k.a[4] = row<S>(
        {1.221224509226639427725L, 6.019134481288630867031L, 12.53708332932087866025L, -0.6878860361058950597828L});
    k.c[1] = row<S>({-5.6688L});
    k.c[2] = row<S>({-2.430093356833874689383L, -0.2063599157091914894139L});
    k.c[3] = row<S>({-0.1073529058151320000257L, -9.594562251023357223625L, -20.47028614809616578181L});
    k.c[4] = row<S>(
        {7.496443313967649864362L, -10.24680431464352358125L, -33.99990352819905402729L, 11.70890893206159899975L});
    k.c[5] = row<S>({8.083246795921527964594L, -7.981132988064893067516L, -31.52159432874371745433L,
                     16.31930543123136965656L, -6.058818238834054534536L});
    k.a[5] = k.a[4], k.a[5][4] = S(1);  // the embedded solution
    k.m = k.a[5], k.m[5] = S(1);
    k.e[5] = S(1);
    // x(t + theta h) - x = theta (x1 - x) + theta (1 - theta) sum_i (p_i + theta q_i) u_i
    const auto p = row<S>({10.12623508344586728422L, -7.487995877610169367666L, -34.80091861555747616584L,
                           -7.992771707568820360812L, 1.025137723295659958484L});
    const auto q = row<S>({-0.6762803392801288270355L, 6.087714651680016728997L, 16.43084320892477142907L,
                           24.76722511418386440099L, -6.59438912571687156452L});
    for (std::size_t i = 0; i < stages; ++i)
      k.dense[0][i] = k.m[i] + p[i], k.dense[1][i] = q[i] - p[i], k.dense[2][i] = -q[i];
    return k;
  }

 private:
  template <class S>
  static std::array<S, stages> row(std::array<long double, stages> entries) {
    std::array<S, stages> r;
    for (std::size_t i = 0; i < stages; ++i) r[i] = static_cast<S>(entries[i]);
    return r;
  }
};

/// Rosenbrock method of order 4 for stiff systems at tolerances of 1e-3 to 1e-8 with a cheap Jacobian: six evaluations,
/// one Jacobian and one df/dt a step.
///
///   kte::rodas solver(f, 0.0, x0, {.absolute = 1e-6, .relative = 1e-6});
///   solver.integrate(10.0);
template <class F, class X>
class rodas : public rosenbrock<rodas_coefficients, F, X> {
 public:
  using rosenbrock<rodas_coefficients, F, X>::rosenbrock;
};

template <class F, class V>
rodas(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&,
      const tolerances<detail::time_scalar<typename V::Scalar>>& = {}) -> rodas<F, typename V::PlainObject>;

}  // namespace kte
