#pragma once

#include <kte/contract/checks.hpp>
#include <kte/contract/element_core.hpp>

/// Reports missing functions of an element core as compile errors, before it is connected. Functions are found by name,
/// which instantiates none of them; the concepts of contract/element_core.hpp also check their results.
namespace kte::detail {

/// Names of functions: in a class derived from this and from a core, the names that the core has are ambiguous.
struct names_of_functions {
  int doForce, doMotion, relative, z_dot, mass_loads, capacity, friction;
};
template <class Core>
struct with_names : Core, names_of_functions {};

/// The functions of a core; all of them for a final class, which cannot be tested.
template <class Core, bool Final = std::is_final_v<Core>>
struct functions_of {
  static constexpr bool force = true, motion = true, relative = true, rate = true, mass_loads = true, capacity = true,
                        friction = true;
};
template <class Core>
struct functions_of<Core, false> {
  using both = with_names<Core>;
  static constexpr bool force = !requires { &both::doForce; };
  static constexpr bool motion = !requires { &both::doMotion; };
  static constexpr bool relative = !requires { &both::relative; };
  static constexpr bool rate = !requires { &both::z_dot; };
  static constexpr bool mass_loads = !requires { &both::mass_loads; };
  static constexpr bool capacity = !requires { &both::capacity; };
  static constexpr bool friction = !requires { &both::friction; };
};

/// Whether only the last port is written.
template <class Core>
inline constexpr bool writes_last = [] {
  for (std::size_t p = 0; p + 1 < port_count<Core>; ++p)
    if (Core::ports[p].writes()) return false;
  return true;
}();

/// Whether the ports of a closure are frames, or coordinates, and its loop.
template <class Core>
inline constexpr bool closes_positions = [] {
  for (std::size_t p = 0; p + 1 < port_count<Core>; ++p)
    if (const kind k = Core::ports[p].what; is_closure<Core> && k != Core::ports[0].what) return false;
  return !is_closure<Core> || is_frame(Core::ports[0].what) || Core::ports[0].what == kind::gen;
}();

/// A core to be connected.
template <class Core>
struct check_functions {
  static constexpr bool passed = false;
  static_assert(
      rule<Core, void, element_core<Core>>,
      "kte: an element core has static members `type`, its name, and `ports`, a std::array of kte::port, and a "
      "function check(const kte::parameter_check&) (kte/contract/element_core.hpp)");
};
template <element_core Core>
struct check_functions<Core> {
  using has = functions_of<Core>;
  static constexpr bool transmits = std::is_base_of_v<transmission<Core>, Core>,
                        moves = Core::ports.back().how == access::out, last = writes_last<Core>,
                        relative = !transmits || has::relative, motion = transmits || !moves || has::motion,
                        force = writes_signal<Core> || has::force, rate = kept_count<Core> == 0 || has::rate,
                        mass = !distributed_mass<Core> || has::mass_loads,
                        capacity = !locks_coordinate<Core> || has::capacity,
                        friction = !load_dependent_friction<Core> || has::friction, closes = closes_positions<Core>;
  static constexpr bool passed = last && relative && motion && force && rate && mass && capacity && friction && closes;

  static_assert(rule<Core, void, last>, "kte: the port that an element writes is the last of its ports");
  static_assert(
      rule<Core, void, relative>,
      "kte: a joint or link has a function relative(coordinate), or relative(), that returns the motion of its "
      "end in its base");
  static_assert(rule<Core, void, motion>,
                "kte: an element that writes a coordinate, a frame or a signal has a function doMotion(things...) that "
                "returns it");
  static_assert(rule<Core, void, force>,
                "kte: an element that writes no signal has a function doForce(things...) that returns "
                "kte::make_loads(...), a load for each port that is not a signal");
  static_assert(rule<Core, void, rate>,
                "kte: an element with an internal state has a function z_dot(things...) that returns its rate");
  static_assert(
      rule<Core, void, mass>,
      "kte: an element with a distributed mass has a function mass_loads(things...) that returns the loads of "
      "accelerations alone");
  static_assert(
      rule<Core, void, capacity>,
      "kte: an element that may lock a coordinate has a function capacity(things...) that returns the largest "
      "holding force");
  static_assert(rule<Core, void, closes>,
                "kte: a closure has ports of two frames, or of one to four coordinates, and of its loop, because its "
                "residual depends on positions alone; signals can move a joint in the loop (docs/loops.md)");
  static_assert(rule<Core, void, friction>,
                "kte: a joint with load-dependent friction has a function friction(coordinate, wrench) that returns a "
                "load on the coordinate");
};

/// The number of loads that `doForce` returned.
template <class Core, std::size_t Count>
struct check_load_count {
  static_assert(rule<Core, void, Count == loaded_ports<Core>>,
                "kte: doForce of an element returns kte::make_loads(...), a load for each port that is not "
                "a signal, in order");
};

}  // namespace kte::detail
