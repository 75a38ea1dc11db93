#pragma once

#include <cmath>
#include <limits>

namespace kte::detail {

/// Two neighbouring arguments with a sign change between them: f(before) > 0, f(after) <= 0.
template <class S>
struct sign_change {
  S before, f_before, after, f_after;
};

/// A root of f between a and b, where f(a) > 0 and f(b) <= 0; a may be on either side of b. Ends when `before` and
/// `after` are within 2 eps |x|, or at f = 0.
///
/// Inverse quadratic interpolation through the last three points if they are sufficiently monotonic, otherwise
/// bisection (Chandrupatla, Adv. Eng. Softw. 28 (1997), 145-149). An addition bounds the number of steps to four per
/// bit: bisection also after three steps that have not halved the interval.
template <class S, class F>
sign_change<S> find_sign_change(F&& f, const S& a, const S& fa, const S& b, const S& fb) {
  using std::abs;
  const S eps = std::numeric_limits<S>::epsilon(), smallest = eps * eps * abs(S(b - a));
  S x = b, fx = fb, y = a, fy = fa, z = y,
    fz = fy;  // x: the newest; y: on the other side of the root; z: the previous one
  S t = S(0.5), goal = abs(S(b - a)) / 2;
  for (int steps = 0; fx != S(0); ++steps) {
    const S width = abs(S(y - x)), ax = abs(x), ay = abs(y), tolerance = eps * (ax < ay ? ay : ax) + smallest;
    if (width <= 2 * tolerance) break;
    if (width <= goal) {
      goal = width / 2;
      steps = 0;
    }
    if (steps == 3) {
      t = S(0.5);
      steps = 0;
    }
    const S least = tolerance / width;
    t = t < least ? least : t > 1 - least ? S(1 - least) : t;
    const S next = x + t * (y - x);
    if (next == x || next == y) break;
    const S f_next = f(next);
    if ((f_next > S(0)) == (fx > S(0))) {
      z = x, fz = fx;
    } else {
      z = y, fz = fy;
      y = x, fy = fx;
    }
    x = next, fx = f_next;
    const S xi = (x - y) / (z - y), phi = (fx - fy) / (fz - fy);
    t = phi * phi < xi && (1 - phi) * (1 - phi) < 1 - xi
            ? S(fx / (fy - fx) * fz / (fy - fz) + (z - x) / (y - x) * fx / (fz - fx) * fy / (fz - fy))
            : S(0.5);
  }
  return fx > S(0) ? sign_change<S>{x, fx, y, fy} : sign_change<S>{y, fy, x, fx};
}

}  // namespace kte::detail
