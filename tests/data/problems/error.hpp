#pragma once

#include <cmath>
#include <cstddef>

/// Initial value problems with known solutions, for tests and benchmarks of integrators.
namespace kte::problems {

/// The known values of a solution at a time, to at most 30 digits.
template <int N>
struct known {
  long double time;
  long double values[N];
};

namespace detail {
/// max error(x_i, r_i); infinite if one is not a number.
template <class X, std::size_t N, class Error>
long double worst(const X& x, const long double (&r)[N], const Error& error) {
  long double most = 0;
  for (std::size_t i = 0; i < N; ++i) {
    const long double e = error(static_cast<long double>(x[static_cast<std::ptrdiff_t>(i)]), r[i]);
    if (!(e <= most)) most = e == e ? e : HUGE_VALL;
  }
  return most;
}
}  // namespace detail

/// max |x_i - r_i|; infinite if one is not a number.
template <class X, std::size_t N>
long double largest_error(const X& x, const long double (&r)[N]) {
  return detail::worst(x, r, [](long double a, long double b) { return std::fabs(a - b); });
}

/// How many digits of x are right, the significant correct digits of the test sets:
///
///   scd = -log10 max |x_i - r_i| / |r_i|          (1)
///
/// Infinite where all are equal. Not for references that are 0.
template <class X, std::size_t N>
double scd(const X& x, const long double (&r)[N]) {
  const auto relative = [](long double a, long double b) { return std::fabs(a - b) / std::fabs(b); };
  return static_cast<double>(-std::log10(detail::worst(x, r, relative)));
}

}  // namespace kte::problems
