#pragma once

#include <concepts>

namespace kte {

/// A dynamic system x' = f(t, x). Integrators accept any callable f(t, x); systems also have it as `computeStateRate`.
template <class F, class X, class T = double>
concept state_rate_function = requires(F& f, const T& t, const X& x) {
  f.computeStateRate(t, x);
};

/// A dynamic system with inputs u and outputs y:
///
///   x' = f(t, x, u),   y = h(t, x, u)
///
/// u is constant until it is set again.
template <class F, class X, class U, class T = double>
concept state_rate_function_with_io = state_rate_function<F, X, T> &&
    requires(F& f, const T& t, const X& x, const U& u) {
  f.setInput(u);
  f.computeOutput(t, x);
};

}  // namespace kte
