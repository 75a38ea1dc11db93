#pragma once

#include <kte/manipulators/detail/descent.hpp>

namespace kte::detail {

/// Attains goals of the second level within the freedom that the first leave, starting where the first are met: steps
///
///   minimize  k |J_1 d - e_1|^2 + |J_2 d - e_2|^2 + mu |d|^2  within limits,   k = 1e8 tr H_2/tr H_1            (1)
///
/// stay in the null space of J_1 to 1e-8. Each is followed by a descent of the first goals alone, and accepted if the
/// second goals have improved and the first are not worse. `met` must be stricter than the tolerance of the first
/// goals, because otherwise their errors would be traded for gains of the second. Returns the number of iterations.
template <class At, class First, class Second, class Met>
int use_freedom(At& at, const First& first, const Second& second, int most, const Met& met) {
  using S = typename At::scalar;
  int iterations = 0;
  if constexpr (std::tuple_size_v < Second >> 0) {
    iterations += descend(at, first, 5, 5, 1e-12, met).iterations;
    const bool hard = met();
    S half = half_squares<S>(second, at), lambda(0.01), nu(2);
    const S had = half_squares<S>(first, at);
    const auto n = static_cast<Eigen::Index>(dofs_of(at.arm));
    while (iterations < most) {
      at.differentiate();
      normal_equations<S, At::n> a(n), b(n);
      add_goals(first, at, a), add_goals(second, at, b);
      const S tr_a = a.h.trace(), tr_b = b.h.trace();
      const S k = tr_a > S(0) ? S(S(1e8) * tr_b / tr_a) : S(0);
      b.h += k * a.h, b.g += k * a.g;
      for (bool taken = false; !taken;) {
        const auto step = best_step(at, b, S(lambda * tr_b / S(n)));  // (1)
        const auto from = at.q;
        if (++iterations; !(step.less > S(1e-14) * half) || iterations >= most || !(lambda < S(1e12)))
          return iterations;
        at.move(stepped(at, step.d));
        const auto back = descend(at, first, 5, 5, 1e-12, met);
        iterations += back.iterations;
        const S now = half_squares<S>(second, at), gain = (half - now) / step.less;
        taken = gain > S(0) && (hard ? back.done : half_squares<S>(first, at) <= had * (S(1) + S(1e-9)));
        if (taken) {
          const S c = S(2) * gain - S(1);
          lambda *= (std::max)(S(S(1) / S(3)), S(S(1) - c * c * c)), nu = S(2), half = now;
        } else {
          at.move(from), lambda *= nu, nu *= S(2);
        }
      }
    }
  }
  return iterations;
}

}  // namespace kte::detail
