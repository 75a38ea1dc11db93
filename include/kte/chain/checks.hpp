#pragma once

#include <kte/chain/port.hpp>
#include <kte/detail/call.hpp>

#include <tuple>

/// What is wrong with a chain, as compile errors in the user's words: each names one element and says one sentence.
/// (This header comes first in kte.hpp, so that little stands above the sentence.)
namespace kte::detail {

/// A rule, about an element and a name; compilers print all three when it is broken.
template <class Element, class Name, bool Kept>
inline constexpr bool rule = Kept;

/// Port `Port` of an element, connected to `Key`.
template <class Core, std::size_t Port, class Key>
struct check_kind {
  static constexpr kind wanted = Core::ports[Port].what;
  static_assert(rule < Core, Key, wanted != kind::gen || Key::what == wanted >,
                "kte: this port of the element takes a coordinate (coord_key)");
  static_assert(rule < Core, Key, wanted != kind::frame_2D || Key::what == wanted >,
                "kte: this port of the element takes a 2D frame (frame_2D_key)");
  static_assert(rule < Core, Key, wanted != kind::frame_3D || Key::what == wanted >,
                "kte: this port of the element takes a 3D frame (frame_3D_key)");
  static_assert(rule < Core, Key, wanted != kind::input || Key::what == wanted >,
                "kte: this port of the element takes an input (input_key)");
  static_assert(rule < Core, Key, wanted != kind::rotation_3D || Key::what == wanted >,
                "kte: this port of the element takes a rotation in space (rotation_3D_key)");
  static_assert(rule < Core, Key, wanted != kind::pose_2D || Key::what == wanted >,
                "kte: this port of the element takes a pose in the plane (pose_2D_key)");
  static_assert(rule < Core, Key, wanted != kind::pose_3D || Key::what == wanted >,
                "kte: this port of the element takes a pose in space (pose_3D_key)");
  static_assert(rule < Core, Key, wanted != kind::internal || Key::what == wanted >,
                "kte: this port of the element takes an internal state (internal_key)");
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
  static_assert(rule<Element, Name, P != problem::same_text>,
                "kte: this element names something by a text that another key has already");
  static_assert(rule<Element, Name, P != problem::written_twice>,
                "kte: this element writes a name that an earlier element has written: give every end a key of its own");
  static_assert(rule<Element, Name, P != problem::read_before_written>,
                "kte: this element reads a name that only a later element writes: move it behind that element");
  static_assert(rule<Element, Name, P != problem::unknown>,
                "kte: this element reads a name that no element of the chain writes: misspelt, or another base? "
                "Declare a further base by kte::base_gen, base_2D or base_3D");
};

/// An element core whose forces depend on what an algorithm leaves out, unless it says that it needs it.
template <class Core, bool Declared>
struct check_need {
  static_assert(Declared,
                "kte: this element's force depends on a position, rotation or linear velocity, which this algorithm "
                "leaves out unless the element core says: static constexpr bool reads_positions = true;");
};

/// A joint or link, and how it turns.
template <class Core, class Turn, bool FitsSpace, bool FitsPlane, bool MovesByRelative>
struct check_transmission {
  static_assert(rule<Core, Turn, FitsSpace>,
                "kte: a joint or link in space turns by a matrix or a quaternion: kte::matrix(c.rotation), "
                "kte::rotation_about(axis, angle)");
  static_assert(rule<Core, Turn, FitsPlane>,
                "kte: a joint or link in the plane turns by a kte::rotation_2D: kte::rotation_by(angle)");
  static_assert(rule<Core, Turn, MovesByRelative>,
                "kte: the motion of a joint or link follows from its `relative`: it has no `doMotion` of its own");
};

/// A joint or link in an algorithm that asks it for its `relative` alone.
template <class Core, bool Plain>
struct check_loads {
  static_assert(Plain,
                "kte: this algorithm takes the loads of joints and links from `relative` alone, and this element has a "
                "`doForce` of its own: put that force into an element on the coordinate");
};

/// What stands for an element that was refused with a sentence, so that nothing more is said about it.
struct refused {};

}  // namespace kte::detail
