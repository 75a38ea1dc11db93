#pragma once

#include <kte/io/print_chains.hpp>
#include <kte/io/print_states.hpp>

#include <sstream>
#include <version>

/// `std::cout << x` for chains, their states, frames, coordinates, vectors, records (docs/printing.md), and
/// `std::format("{}", x)` if the standard library has it.
namespace kte::detail {
/// Whether this header prints a type, by the name of its template.
template <class T>
inline constexpr bool is_printed = requires {
  typename T::geometry;
};
template <int N>
inline constexpr bool is_printed<constant<N>> = true;
template <class S>
inline constexpr bool is_printed<frame_2D<S>> = true;
template <class S>
inline constexpr bool is_printed<frame_3D<S>> = true;
template <class S>
inline constexpr bool is_printed<gen_coord<S>> = true;
template <class Gravity, class... E>
inline constexpr bool is_printed<static_chain<Gravity, E...>> = true;
template <class S, class Wiring>
inline constexpr bool is_printed<chain_state<S, Wiring>> = true;
template <class S>
inline constexpr bool is_printed<basic_runtime_state<S>> = true;
template <class Chain, class X>
inline constexpr bool is_printed<named_vector<Chain, X>> = true;
template <>
inline constexpr bool is_printed<runtime_chain> = true;
template <>
inline constexpr bool is_printed<model_record> = true;
template <>
inline constexpr bool is_printed<element_record> = true;
}  // namespace kte::detail

#ifdef __cpp_lib_format
#  include <format>

/// Formats any type that kte prints by `<<`; width and fill as for texts.
template <class T>
requires(kte::detail::is_printed<T>) struct std::formatter<T, char> : std::formatter<std::string, char> {
  template <class Context>
  auto format(const T& x, Context& context) const {
    std::ostringstream text;
    text << x;
    return std::formatter<std::string, char>::format(text.str(), context);
  }
};
#endif
