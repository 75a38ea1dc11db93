#pragma once

#include <functional>

#include "allocation_count.hpp"
#include "catch.hpp"

/// Counts what code does whose time may grow faster than its input: allocations with their sizes, and comparisons of
/// texts. A program includes it in one file, with allocations.hpp.
namespace growth {

inline double comparisons = 0;

/// A count of operations: a comparison of texts, an allocation, or 64 bytes of it.
inline double operations_of(const std::function<void()>& f) {
  const double texts = comparisons, bytes = static_cast<double>(allocations::bytes);
  const double times = static_cast<double>(allocations::during(f));
  return comparisons - texts + times + (static_cast<double>(allocations::bytes) - bytes) / 64;
}
/// Checks that four times the size takes at most five times the operations: n log n takes 4.8 times, n^2 takes 16.
inline void grows_linearly(const std::string& what, const std::function<void(int)>& f, int n = 250) {
  f(n);  // what is made once
  const double small = operations_of([&] { f(n); }), large = operations_of([&] { f(4 * n); });
  INFO(what << ": " << small << " operations for " << n << ", " << large << " for " << 4 * n);
  CHECK(large < 5 * small);
}

}  // namespace growth

namespace growth::detail {
inline int order_of(const void* a, const void* b, std::size_t n) {
  ++comparisons;
  const auto* const x = static_cast<const volatile unsigned char*>(a);  // volatile: else this becomes a call of itself
  const auto* const y = static_cast<const volatile unsigned char*>(b);
  for (std::size_t i = 0; i < n; ++i)
    if (x[i] != y[i]) return x[i] < y[i] ? -1 : 1;
  return 0;
}
}  // namespace growth::detail

// Those of the C library, by which texts are compared.
extern "C" int memcmp(const void* a, const void* b, std::size_t n) noexcept {
  return growth::detail::order_of(a, b, n);
}
extern "C" int bcmp(const void* a, const void* b, std::size_t n) noexcept { return growth::detail::order_of(a, b, n); }
