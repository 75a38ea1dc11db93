#pragma once

#include <kte/contract/core_checks.hpp>
#include <kte/contract/core_in_scalar.hpp>
#include <kte/contract/parameter_check.hpp>

#include <array>
#include <string>
#include <tuple>
#include <type_traits>

namespace kte {

namespace detail {
/// `.at(...)` of an element core: joints have a placement (contract/placement.hpp).
template <class Core>
struct placement {
  template <class... Place>
  static constexpr auto of(const Core&, const Place&...) {
    static_assert(rule<Core, void, fit<Core>>,
                  "kte: .at(position[, rotation]) places a joint in its base; this element is not a joint");
    return refused{};
  }
};
}  // namespace detail

namespace detail {
/// `.only_if(...)` of an element core: rigid contacts have a gate (elements/gated_contact.hpp).
template <class Core>
struct gate {
  template <class F>
  static constexpr auto on(const Core&, const F&) {
    static_assert(rule<Core, void, fit<Core>>, "kte: .only_if(f) is for rigid contacts, once for each");
    return refused{};
  }
};
}  // namespace detail

template <class Core, class... Names>
constexpr auto connect(const Core& core, const Names&... names);
/// Passes an invalid element on, whose error has been reported.
template <class... Names>
constexpr detail::refused connect(detail::refused, const Names&...) {
  return {};
}

/// An element of a static chain: a core with its passes and parameters, and the keys connected to its ports.
template <class Core, class... Keys>
struct element {
  static_assert(sizeof...(Keys) == port_count<Core>);
  using core_type = Core;
  Core core;

  /// The joint with a placement in the base: position, m, and optionally rotation.
  template <class... Place>
  constexpr auto at(const Place&... place) const {
    return connect(detail::placement<Core>::of(core, place...), Keys{}...);
  }
  /// The rigid contact, which lands only if f(state) is true (elements/gated_contact.hpp).
  template <class F>
  constexpr auto only_if(const F& f) const {
    return connect(detail::gate<Core>::on(core, f), Keys{}...);
  }
};

/// An element of a runtime chain: a `core`, and the names connected to its ports.
template <class Core>
struct named_element {
  using core_type = Core;
  Core core;
  std::array<std::string, port_count<Core>> names;

  /// The joint with a placement in the base: position, m, and optionally rotation.
  template <class... Place>
  auto at(const Place&... place) const {
    const auto placed = detail::placement<Core>::of(core, place...);
    return connect_again(placed);
  }
  /// The rigid contact, which lands only if f(state) is true (elements/gated_contact.hpp).
  template <class F>
  auto only_if(const F& f) const {
    return connect_again(detail::gate<Core>::on(core, f));
  }

 private:
  template <class Changed>
  auto connect_again(const Changed& changed) const {
    return [&]<std::size_t... P>(std::index_sequence<P...>) { return connect(changed, names[P]...); }
    (std::make_index_sequence<port_count<Core>>{});
  }
};

template <class... Core>
struct named_elements;

namespace detail {
template <class... Core>
named_elements<Core...> together(const named_element<Core>&... all) {
  return {{all...}};
}
template <class... Others>
constexpr refused together(refused, const Others&...) {
  return {};
}
}  // namespace detail

/// Several elements that a runtime chain appends in order, all or none.
template <class... Core>
struct named_elements {
  std::tuple<named_element<Core>...> all;

  /// Joints in series, the first of them placed at a position, m, and a rotation in the base.
  template <class... Place>
  auto at(const Place&... place) const {
    return [&]<std::size_t... Later>(std::index_sequence<Later...>) {
      return detail::together(std::get<0>(all).at(place...), std::get<1 + Later>(all)...);
    }
    (std::make_index_sequence<sizeof...(Core) - 1>{});
  }
};

namespace detail {
/// Conditions on a core before it is connected; contract/transmission.hpp has those of joints and links.
template <class Core>
struct check_core {
  static constexpr bool passed = true;
};
}  // namespace detail

namespace detail {
/// The message of an element, with its lane if there are several.
inline std::string in_lane(std::size_t lane, std::size_t lanes, const std::string& message) {
  return lanes == 1 ? message : "kte: lane " + std::to_string(lane) + ": " + message.substr(5);
}
/// Checks the parameters of a core lane by lane; of dual numbers the values. Throws `bad_parameter`.
template <class Core>
constexpr void check_lanes(const Core& core, const parameter_check& where) {
  for (std::size_t lane = 0; lane < lanes_in<Core>; ++lane) {
    converted<double>(core, to_lane<double>{lane}).check(where);
    if (where.broken.rule) raise<bad_parameter>(in_lane(lane, lanes_in<Core>, where()));
  }
}
}  // namespace detail

/// Connects a core: keys make an element of a static chain, texts an element of a runtime chain. The parameters are
/// checked first, so that the message can name the element.
template <class Core, class... Names>
constexpr auto connect(const Core& core, const Names&... names) {
  static_assert(
      (key_type<Names> && ...) || (text_type<Names> && ...),
      "kte: an element is connected either by keys (static chain) or by texts (runtime chain), not by a mixture");
  if constexpr (!detail::check_functions<Core>::passed) {
    return detail::refused{};
  } else if constexpr (sizeof...(Names) != port_count<Core>) {
    static_assert(sizeof...(Names) == port_count<Core>, "kte: an element is connected by a name for each of its ports");
    return detail::refused{};
  } else if constexpr (!detail::check_core<Core>::passed) {
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
      if constexpr (detail::has_packs_or_duals<Core>) {
        detail::check_lanes(core, where);
      } else {  // here, so that the error of a constant expression is short
        core.check(where);
        detail::require<bad_parameter>(!broken.rule, where, broken.rule, broken.value);
      }
      return element<Core, Names...>{core};
    }
  } else if constexpr (!(text_type<Names> && ...)) {
    return detail::refused{};
  } else {
    const std::array<std::string_view, sizeof...(Names)> texts{std::string_view(names)...};
    parameter_check::breach broken;
    const parameter_check where{Core::type, Core::ports, texts, broken};
    if constexpr (detail::has_packs_or_duals<Core>) {
      detail::check_lanes(core, where);
    } else {  // here, so that the error of a constant expression is short
      core.check(where);
      detail::require<bad_parameter>(!broken.rule, where, broken.rule, broken.value);
    }
    return named_element<Core>{core, {std::string(std::string_view(names))...}};
  }
}

}  // namespace kte
