#pragma once

#include <cstdlib>
#include <limits>
#include <new>

/// Counts heap allocations, and makes chosen ones fail, in a program with a file that includes allocations.hpp.
namespace allocations {

inline long long total = 0, bytes = 0;

/// How many allocations f() makes.
template <class F>
long long during(const F& f) {
  const long long before = total;
  f();
  return total - before;
}

/// How many bytes they take, whether they are given back or not.
template <class F>
long long bytes_during(const F& f) {
  const long long before = bytes;
  f();
  return bytes - before;
}

/// Fails the n-th allocation from here on, or all from that one on, as long as it lives.
class failing {
 public:
  explicit failing(long long n, bool all_behind = false) {
    first = total + n, last = all_behind ? std::numeric_limits<long long>::max() : first;
  }
  failing(const failing&) = delete;
  failing& operator=(const failing&) = delete;
  ~failing() { first = last = none; }
  /// Whether the n-th has come.
  static bool has_begun() { return total >= first; }

  static constexpr long long none = std::numeric_limits<long long>::min();
  static inline long long first = none, last = none;
};

/// act(x) on an x = make() with each of its allocations failing, alone and with all behind it, up to where it makes no
/// more of them; check(x, threw) after each.
template <class Make, class Act, class Check>
void fail_each(const Make& make, const Act& act, const Check& check) {
  for (const bool all_behind : {false, true}) {
    bool more = true;
    for (long long n = 1; more; ++n) {
      auto x = make();
      bool threw = false;
      {
        const failing here(n, all_behind);
        try {
          act(x);
        } catch (const std::bad_alloc&) {
          threw = true;
        }
        more = failing::has_begun();
      }
      check(x, threw);
    }
  }
}

inline void* take(std::size_t n, std::size_t alignment) noexcept {
  ++total, bytes += static_cast<long long>(n);
  if (total >= failing::first && total <= failing::last) return nullptr;
  const std::size_t size = n == 0 ? 1 : n;
  return alignment == 0 ? std::malloc(size)
                        : std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}
inline void* take_or_throw(std::size_t n, std::size_t alignment) {
  if (void* p = take(n, alignment)) return p;
  throw std::bad_alloc();
}

}  // namespace allocations
