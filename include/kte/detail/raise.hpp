#pragma once

#include <cstdio>
#include <cstdlib>

namespace kte::detail {

/// Throws `error`; without exceptions, prints it and aborts. Deliberately not constexpr: if it is reached during the
/// construction of a constexpr chain, compilation stops at the call with the invalid value.
template <class Error, class... Args>
[[noreturn, gnu::cold, gnu::noinline]] void raise(Args&&... args) {
#if defined(__cpp_exceptions)
  throw Error(static_cast<Args&&>(args)...);
#else
  std::fprintf(stderr, "%s\n", Error(static_cast<Args&&>(args)...).what());
  std::abort();
#endif
}

/// Throws Error(text()) unless `ok`. In constant expressions, compilers print the other arguments.
template <class Error, class Text, class... Shown>
constexpr void require(bool ok, const Text& text, const char*, Shown...) {
  if (!ok) {
#if defined(__cpp_exceptions)
    throw Error(text());  // compilers print less than for a call
#else
    raise<Error>(text());
#endif
  }
}

}  // namespace kte::detail
