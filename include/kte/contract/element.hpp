#pragma once

#include <kte/contract/checks.hpp>
#include <kte/contract/parameter_check.hpp>

#include <array>
#include <string>
#include <type_traits>

namespace kte {

/// An element of a static chain: a core, which holds the arithmetic and the parameters and knows no names, and the keys
/// of what its ports are connected to.
template <class Core, class... Keys>
struct element {
  static_assert(sizeof...(Keys) == port_count<Core>);
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
/// What must hold for a core before it is connected: contract/transmission.hpp says it of joints and links.
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
  if constexpr (sizeof...(Names) != port_count<Core> || !detail::check_core<Core>::passed) {
    return detail::refused{};
  } else if constexpr ((key_type<Names> && ...)) {
    constexpr std::size_t bad = detail::first_misfit(Core::ports, {Names::what...});
    if constexpr (bad < sizeof...(Names)) {
      using key = std::tuple_element_t<bad, std::tuple<Names...>>;
      static_assert(sizeof(detail::check_kind<Core, key, Core::ports[bad].what>) > 0);
      return detail::refused{};
    } else {
      const std::array<std::string_view, sizeof...(Names)> texts{Names::name...};
      parameter_check::breach broken;
      const parameter_check where{Core::type, Core::ports, texts, broken};
      core.check(where);
      detail::require<bad_parameter>(!broken.rule, where, broken.rule, broken.value);
      return element<Core, Names...>{core};
    }
  } else if constexpr (!(text_type<Names> && ...)) {
    return detail::refused{};
  } else {
    const std::array<std::string_view, sizeof...(Names)> texts{std::string_view(names)...};
    parameter_check::breach broken;
    const parameter_check where{Core::type, Core::ports, texts, broken};
    core.check(where);
    detail::require<bad_parameter>(!broken.rule, where, broken.rule, broken.value);
    return named_element<Core>{core, {std::string(std::string_view(names))...}};
  }
}

}  // namespace kte
