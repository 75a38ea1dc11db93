#pragma once

#include <array>
#include <cstddef>
#include <utility>

namespace kte::detail {

/// The numbers n for which `Is[n]` holds, in order, as an index_sequence. Nothing is instantiated for the others. `Is`:
/// an array of bool.
template <auto Is>
struct numbers_where {
  static constexpr std::size_t count = [] {
    std::size_t n = 0;
    for (const bool is : Is) n += is;
    return n;
  }();
  static constexpr auto list = [] {
    std::array<std::size_t, count> all{};
    for (std::size_t i = 0, n = 0; n < count; ++i)
      if (Is[i]) all[n++] = i;
    return all;
  }();
  template <std::size_t... N>
  static auto listed(std::index_sequence<N...>) -> std::index_sequence<list[N]...>;
  using type = decltype(listed(std::make_index_sequence<count>{}));
};

}  // namespace kte::detail
