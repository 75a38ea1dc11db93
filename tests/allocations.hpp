#pragma once

#include "allocation_count.hpp"

/// Counts heap allocations. It replaces the global operators new and delete, so one file of a program may include it.
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
