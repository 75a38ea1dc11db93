#pragma once

#include <kte/chain/port.hpp>

#include <tuple>

/// What is wrong with a chain, as compile errors in the user's words: each names one element and says one sentence.
/// (This header comes first in kte.hpp, so that little stands above the sentence.)
namespace kte::detail {

template <bool Ok>
struct rule {
  static constexpr bool kept = Ok;
};

/// Port `Port` of an element, connected to `Key`.
template <class Core, std::size_t Port, class Key>
struct check_kind {
  static constexpr kind wanted = Core::ports[Port].what;
  template <kind K>
  using takes = rule<wanted != K || Key::what == K>;
  static_assert(takes<kind::gen>::kept, "kte: this port of the element takes a coordinate (coord_key)");
  static_assert(takes<kind::frame_2D>::kept, "kte: this port of the element takes a 2D frame (frame_2D_key)");
  static_assert(takes<kind::frame_3D>::kept, "kte: this port of the element takes a 3D frame (frame_3D_key)");
  static_assert(takes<kind::input>::kept, "kte: this port of the element takes an input (input_key)");
};
template <class Core, class Ports, class... Keys>
struct check_kinds;
template <class Core, std::size_t... Ports, class... Keys>
struct check_kinds<Core, std::index_sequence<Ports...>, Keys...> : check_kind<Core, Ports, Keys>... {};

/// Rules of a chain, and what breaks them.
enum class problem : unsigned char {
  none,
  same_text,            ///< another key has the same text
  written_twice,        ///< another element has written this name before
  read_before_written,  ///< only a later element writes it
  unknown               ///< nothing writes it, and it is no base or coordinate of the chain
};

/// An element of a chain, what is wrong with it, and the name in question.
template <class Element, problem P, class Name>
struct check_wiring {
  template <problem Q>
  using without = rule<P != Q>;
  static_assert(without<problem::same_text>::kept,
                "kte: this element names something by a text that another key has already");
  static_assert(without<problem::written_twice>::kept,
                "kte: this element writes a name that an earlier element has written: give every end a key of its own");
  static_assert(without<problem::read_before_written>::kept,
                "kte: this element reads a name that only a later element writes: move it behind that element");
  static_assert(without<problem::unknown>::kept,
                "kte: this element reads a name that no element of the chain writes: misspelt, or another base? "
                "Declare a further base by kte::base_gen, base_2D or base_3D");
  static constexpr bool done = true;
};

}  // namespace kte::detail
