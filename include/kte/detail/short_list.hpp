#pragma once

#include <array>
#include <cstddef>

namespace kte::detail {

/// A list of at most N items, without heap allocation.
template <class T, std::size_t N>
struct short_list {
  std::array<T, N> item{};
  std::size_t count = 0;
  constexpr void push_back(const T& x) { item[count++] = x; }
  constexpr void resize(std::size_t n) { count = n; }
  constexpr std::size_t size() const { return count; }
  constexpr bool empty() const { return count == 0; }
  constexpr T& operator[](std::size_t i) { return item[i]; }
  constexpr const T& operator[](std::size_t i) const { return item[i]; }
  constexpr auto begin() const { return item.begin(); }
  constexpr auto end() const { return item.begin() + static_cast<std::ptrdiff_t>(count); }
};

}  // namespace kte::detail
