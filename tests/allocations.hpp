#pragma once

#include <cstdlib>
#include <new>

/// Counts heap allocations. It replaces the global operators new and delete, so one file of a program may include it.
namespace allocations {

inline long long total = 0;

/// How many allocations f() makes.
template <class F>
long long during(const F& f) {
  const long long before = total;
  f();
  return total - before;
}

inline void* take(std::size_t n, std::size_t alignment) noexcept {
  ++total;
  const std::size_t size = n == 0 ? 1 : n;
  return alignment == 0 ? std::malloc(size)
                        : std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}
inline void* take_or_throw(std::size_t n, std::size_t alignment) {
  if (void* p = take(n, alignment)) return p;
  throw std::bad_alloc();
}

}  // namespace allocations

// Not inlined: else g++ sees malloc and delete side by side and warns of a mismatch.
[[gnu::noinline]] void* operator new(std::size_t n) { return allocations::take_or_throw(n, 0); }
[[gnu::noinline]] void* operator new(std::size_t n, const std::nothrow_t&) noexcept { return allocations::take(n, 0); }
[[gnu::noinline]] void* operator new(std::size_t n, std::align_val_t a) {
  return allocations::take_or_throw(n, static_cast<std::size_t>(a));
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, const std::nothrow_t&) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }
