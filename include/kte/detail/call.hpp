#pragma once
#pragma GCC system_header  // compilers then report the use of the macro, not its contents

namespace kte::detail {
/// Always false; whether arguments fit an overload.
template <class... Arguments>
inline constexpr bool fit = false;
}  // namespace kte::detail

/// The error of an element factory for arguments that do not fit: `KTE_CALL(inertia_gen, "(coordinate, mass)")`. Every
/// other overload is preferred.
#define KTE_CALL(factory, arguments)                                                        \
  template <class... Arguments>                                                             \
  constexpr auto factory(const Arguments&...) {                                             \
    static_assert(::kte::detail::fit<Arguments...>, "kte: call it as " #factory arguments); \
    return ::kte::detail::refused{};                                                        \
  }
