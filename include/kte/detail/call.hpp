#pragma once
#pragma GCC system_header  // compilers then say where the macro is used, and nothing about the macro

namespace kte::detail {
/// Whether arguments fit: never, where this is asked.
template <class... Arguments>
inline constexpr bool fit = false;
}  // namespace kte::detail

/// What the factory of an element says to arguments that do not fit: `KTE_CALL(inertia_gen, "(coordinate, mass)")`. Any
/// other overload is taken before this one.
#define KTE_CALL(factory, arguments)                                                        \
  template <class... Arguments>                                                             \
  constexpr auto factory(const Arguments&...) {                                             \
    static_assert(::kte::detail::fit<Arguments...>, "kte: call it as " #factory arguments); \
    return ::kte::detail::refused{};                                                        \
  }
