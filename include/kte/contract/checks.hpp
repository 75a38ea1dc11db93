#pragma once

#include <kte/contract/element_core.hpp>
#include <kte/contract/wiring_rules.hpp>
#include <kte/detail/call.hpp>

#include <tuple>

/// Errors in a chain as compile errors; each names one element. (Headers with such messages are included first in
/// kte.hpp, so that the messages appear near the top.)
namespace kte::detail {

/// A rule about an element and a name; compilers print all three when it is violated.
template <class Element, class Name, bool Kept>
inline constexpr bool rule = Kept;

/// An element core connected to `Key`, where it needs an item of kind `Wanted`.
template <class Core, class Key, kind Wanted>
struct check_kind {
  static constexpr bool fits = Key::what == Wanted;
  static_assert(rule < Core, Key, fits || Wanted != kind::gen >,
                "kte: this port of the element takes a coordinate (coord_key)");
  static_assert(rule < Core, Key, fits || Wanted != kind::frame_2D >,
                "kte: this port of the element takes a 2D frame (frame_2D_key)");
  static_assert(rule < Core, Key, fits || Wanted != kind::frame_3D >,
                "kte: this port of the element takes a 3D frame (frame_3D_key)");
  static_assert(rule < Core, Key, fits || Wanted != kind::input >,
                "kte: this port of the element takes an input (input_key)");
  static_assert(rule < Core, Key, fits || Wanted != kind::rotation_3D >,
                "kte: this port of the element takes a rotation in space (rotation_3D_key)");
  static_assert(rule < Core, Key, fits || Wanted != kind::pose_2D >,
                "kte: this port of the element takes a pose in the plane (pose_2D_key)");
  static_assert(rule < Core, Key, fits || Wanted != kind::pose_3D >,
                "kte: this port of the element takes a pose in space (pose_3D_key)");
  static_assert(rule < Core, Key, fits || Wanted != kind::vector >,
                "kte: this port of the element takes a signal of three numbers (vector_key)");
  static_assert(rule < Core, Key, fits || Wanted != kind::internal >,
                "kte: this port of the element takes an internal state (internal_key)");
  static_assert(rule < Core, Key, fits || Wanted != kind::loop >,
                "kte: this port of the element takes the name of a closure (loop_key)");
  static_assert(rule < Core, Key, fits || Wanted != kind::contact >,
                "kte: this port of the element takes the name of a contact (contact_key)");
};
/// The first port that is connected to an item of another kind, or N.
template <std::size_t N>
constexpr std::size_t first_misfit(const std::array<port, N>& ports, const std::array<kind, N>& given) {
  std::size_t p = 0;
  while (p < N && ports[p].what == given[p]) ++p;
  return p;
}

/// An element of a chain, its fault, and the name concerned.
template <class Element, problem P, class Name>
struct check_wiring {
  static_assert(rule<Element, Name, P != problem::same_text>, "kte: another key has the text of this name");
  static_assert(rule<Element, Name, P != problem::written_twice>,
                "kte: this element writes a name that an earlier element has written: give every end its own key");
  static_assert(rule<Element, Name, P != problem::read_before_written>,
                "kte: this element reads a name that only a later element writes: move it behind that element");
  static_assert(rule<Element, Name, P != problem::unknown>,
                "kte: this element reads a name that no element of the chain writes: misspelt, or another base? "
                "Declare a further base by kte::base_2D or base_3D");
  static_assert(rule<Element, Name, P != problem::moves_nothing>,
                "kte: nothing moves by this coordinate of the element: misspelt? A joint or a mass must move by it, or "
                "kte::base_gen declare it");
};
/// In errors: the unknown key, and a similar key of the chain.
template <class Written, class Meant>
struct did_you_mean_key {};

/// An element core whose forces depend on quantities that an algorithm omits, unless it declares that it needs them.
template <class Core, bool Declared>
struct check_need {
  static_assert(Declared,
                "kte: this element's force depends on a position, rotation or linear velocity, which this algorithm "
                "leaves out unless the element core says: static constexpr bool reads_positions = true;");
};

/// An element core that writes a signal, with or without accelerations.
template <class Core, bool Accelerations>
struct check_signal {
  static_assert(rule<Core, void, !Accelerations>,
                "kte: the output of this element depends on accelerations: its core must declare static constexpr bool "
                "reads_accelerations = true;, and no force may depend on it");
};

/// An element in an algorithm that requires its loads to be the power dual of its motion.
template <class Core, bool Plain>
struct check_loads {
  static_assert(rule < Core, void, Plain || power_dual < Core >>,
                "kte: this element returns loads that are not the dual of its motion, for controllers: only passes and "
                "inverse dynamics support it");
  static_assert(rule < Core, void, Plain || !power_dual < Core >>,
                "kte: this algorithm takes the loads of joints and links from `relative` alone, and this element has "
                "its own `doForce`: put that force into an element on the coordinate");
};

/// An element with a distributed mass in an algorithm for bodies.
template <class Core, bool None>
struct check_bodies {
  static_assert(None,
                "kte: this algorithm counts the masses of single frames and coordinates, and this element has a mass "
                "between several");
};
/// A closure in an algorithm of trees.
template <class Core, bool None>
struct check_closures {
  static_assert(rule<Core, void, None>,
                "kte: this algorithm does not support closures of loops; forward_dynamics, constrained_dynamics, and "
                "inverse_dynamics with kte::actuated do, of kte/loops.hpp");
};
template <class Core, bool None>
struct check_contacts {
  static_assert(rule<Core, void, None>,
                "kte: this algorithm does not support contacts; contact_dynamics of kte/contacts.hpp does");
};
/// The result of a rejected element: its error has been reported, and no further errors follow.
struct refused {
  template <class... Place>
  constexpr refused at(const Place&...) const {
    return {};
  }
};

}  // namespace kte::detail
