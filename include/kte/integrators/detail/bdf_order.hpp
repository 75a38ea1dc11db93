#pragma once

#include <cmath>

namespace kte::detail {

/// An order, and the factor of the step for it.
template <class S>
struct order_choice {
  int order;
  S factor;
};

/// The next order and step after equal steps of order k: the order q among k - 1, k, k + 1 with the longest step, up to
/// `most`. error(q) is e_q, the norm of the error at order q (at most 1 within the tolerances). stable(q) is the
/// longest stable step at order q, relative to the present one (`bdf_coefficients::stable_angle`).
///
///   r_q = (b e_q)^(-1/(q + 1)),   b = 6,   10 for q = k + 1;   0.2 to min(10, stable(q))                  (1)
///
/// If this limits an order k > 3, order 2 is also considered.
///
/// The margins b make rejected steps rare, and increases of the order reluctant. A step that could grow by less than
/// 1.3 stays, because a change costs a factorization and k + 1 equal steps. Steps shrink before they fail.
///
/// The margins are those of Brown, Byrne and Hindmarsh, VODE: a variable-coefficient ODE solver, SIAM J. Sci. Stat.
/// Comput. 10 (1989).
template <class S, class Size, class Stable>
order_choice<S> choose_order(int k, int most, const Size& error, const Stable& stable) {
  const auto ratio_of = [&](int q, const S& margin) {
    using std::pow;
    const S e = error(q), r = pow(S(margin * (e < S(1e-10) ? S(1e-10) : e)), S(S(-1) / S(q + 1)));  // (1)
    const S longest = stable(q) < S(10) ? stable(q) : S(10), bounded = r < longest ? r : longest;
    return bounded < S(0.2) ? S(0.2) : bounded;
  };
  order_choice<S> best{k, ratio_of(k, S(6))};
  const auto consider = [&](int q, const S& margin) {
    const S r = ratio_of(q, margin);
    if (best.factor < r) best = {q, r};
  };
  if (k > 1) consider(k - 1, S(6));
  if (k < most) consider(k + 1, S(10));
  if (k > 3 && !(best.factor < stable(k))) consider(2, S(6));
  if (best.factor < S(1.3) && S(0.95) < best.factor) return {best.order < k ? best.order : k, S(1)};
  return best;
}

/// The factor of the step at order k after its error was too large: (1), 0.1 to 0.7.
template <class S>
S shrink_step(int k, const S& error) {
  using std::pow;
  const S r = pow(S(6 * error), S(S(-1) / S(k + 1)));
  return r < S(0.1) ? S(0.1) : r < S(0.7) ? r : S(0.7);
}

}  // namespace kte::detail
