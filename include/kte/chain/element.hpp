#pragma once

#include <kte/chain/checks.hpp>
#include <kte/chain/parameter_check.hpp>

#include <array>
#include <string>
#include <type_traits>

namespace kte {

/// An element of a static chain: a core, which holds the arithmetic and the parameters and knows no names, and the keys
/// of what its ports are connected to.
template <class Core, class... Keys>
struct element {
  static_assert(sizeof...(Keys) == port_count<Core>);
  static_assert(sizeof(detail::check_kinds<Core, std::make_index_sequence<sizeof...(Keys)>, Keys...>) > 0);
  using core_type = Core;
  Core core;
};

/// The same under names that are texts, for runtime chains.
template <class Core>
struct named_element {
  using core_type = Core;
  Core core;
  std::array<std::string, port_count<Core>> names;
};

namespace detail {
/// What must hold for a core before it is connected: chain/transmission.hpp says it of joints and links.
template <class Core>
struct check_core {
  static constexpr bool passed = true;
};
}  // namespace detail

/// Connects a core: keys make an element of a static chain, texts one of a runtime chain. Either way the parameters are
/// checked first, so that the message can name the element.
template <class Core, class... Names>
constexpr auto connect(const Core& core, const Names&... names) {
  static_assert(
      (key_type<Names> && ...) || (text_type<Names> && ...),
      "kte: an element is connected either by keys (static chain) or by texts (runtime chain), not by a mixture");
  static_assert(sizeof...(Names) == port_count<Core>, "kte: an element is connected by a name for each of its ports");
  const auto check = [&](const std::array<std::string_view, sizeof...(Names)>& texts) {
    core.check(parameter_check{Core::type, Core::ports, texts});
  };
  if constexpr (sizeof...(Names) != port_count<Core> || !detail::check_core<Core>::passed) {
    return detail::refused{};
  } else if constexpr ((key_type<Names> && ...)) {
    check({Names::name...});
    return element<Core, Names...>{core};
  } else if constexpr (!(text_type<Names> && ...)) {
    return detail::refused{};
  } else {
    check({std::string_view(names)...});
    return named_element<Core>{core, {std::string(std::string_view(names))...}};
  }
}

}  // namespace kte
