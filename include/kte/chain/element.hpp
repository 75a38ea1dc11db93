#pragma once

#include <kte/chain/parameter_check.hpp>

#include <array>
#include <string>
#include <type_traits>

namespace kte {

namespace detail {
template <class Core, std::size_t Port, class Key>
struct check_kind {
  static constexpr kind wanted = Core::ports[Port].what;
  static_assert(wanted != kind::gen || Key::what == wanted,
                "kte: this port of the element takes a coordinate (coord_key)");
  static_assert(wanted != kind::frame_2D || Key::what == wanted,
                "kte: this port of the element takes a 2D frame (frame_2D_key)");
  static_assert(wanted != kind::frame_3D || Key::what == wanted,
                "kte: this port of the element takes a 3D frame (frame_3D_key)");
  static_assert(wanted != kind::input || Key::what == wanted,
                "kte: this port of the element takes an input (input_key)");
};
template <class Core, class Ports, class... Keys>
struct check_kinds;
template <class Core, std::size_t... Ports, class... Keys>
struct check_kinds<Core, std::index_sequence<Ports...>, Keys...> : check_kind<Core, Ports, Keys>... {};
}  // namespace detail

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

/// Connects a core: keys make an element of a static chain, texts one of a runtime chain. Either way the parameters are
/// checked first, so that the message can name the element.
template <class Core, class... Names>
constexpr auto connect(const Core& core, const Names&... names) {
  static_assert(
      (key_type<Names> && ...) || (text_type<Names> && ...),
      "kte: an element is connected either by keys (static chain) or by texts (runtime chain), not by a mixture");
  const auto check = [&](const std::array<std::string_view, sizeof...(Names)>& texts) {
    core.check(parameter_check{Core::type, Core::ports, texts});
  };
  if constexpr ((key_type<Names> && ...)) {
    check({Names::name...});
    return element<Core, Names...>{core};
  } else {
    check({std::string_view(names)...});
    return named_element<Core>{core, {std::string(std::string_view(names))...}};
  }
}

}  // namespace kte
