#pragma once

#include <kte/detail/inline.hpp>

#include <cstddef>
#include <utility>

namespace kte {

namespace detail {
template <std::size_t I, class T>
struct numbered {
  T value;
};
template <class Numbers, class... T>
struct numbered_values;
template <std::size_t... I, class... T>
struct numbered_values<std::index_sequence<I...>, T...> : numbered<I, T>... {};
}  // namespace detail

/// Several values by number, as bases of an aggregate. Compilers instantiate constructors of a tuple for each list of
/// types, but none for an aggregate.
template <class... T>
struct values : detail::numbered_values<std::make_index_sequence<sizeof...(T)>, T...> {};

/// Value number I.
template <std::size_t I, class T>
KTE_INLINE constexpr const T& nth(const detail::numbered<I, T>& x) {
  return x.value;
}

}  // namespace kte
