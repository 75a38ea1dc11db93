#pragma once

#include <cstdio>
#include <cstdlib>

namespace kte::detail {

/// Throws `error`; where exceptions are switched off, prints it and aborts. Not constexpr on purpose: reached while a
/// constexpr chain is built, it stops the compilation at the call that holds the bad value.
template <class Error, class... Args>
[[noreturn, gnu::cold, gnu::noinline]] void raise(Args&&... args) {
#if defined(__cpp_exceptions)
  throw Error(static_cast<Args&&>(args)...);
#else
  std::fprintf(stderr, "%s\n", Error(static_cast<Args&&>(args)...).what());
  std::abort();
#endif
}

/// Throws Error(text()) unless `ok`. Where that stops a constant expression, compilers print the other arguments.
template <class Error, class Text, class... Shown>
constexpr void require(bool ok, const Text& text, const char*, Shown...) {
  if (!ok) {
#if defined(__cpp_exceptions)
    throw Error(text());  // compilers print less about it than about a call
#else
    raise<Error>(text());
#endif
  }
}

}  // namespace kte::detail
