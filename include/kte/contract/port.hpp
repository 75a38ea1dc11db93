#pragma once

#include <kte/contract/key.hpp>
#include <kte/deprecated.hpp>

#include <array>
#include <span>
#include <string>

namespace kte {

/// The use of the item that is connected to a port.
enum class access : unsigned char {
  in,     ///< reads it; a coordinate that no element writes is a degree of freedom of the chain
  angle,  ///< reads it, with cosine and sine of the angle, or the matrix of the rotation
  on,     ///< acts on it by a force; another element must move it: a spring alone makes no degree of freedom
  out,    ///< writes it
  base,   ///< declares it: its motion is prescribed
  keep    ///< an internal state: reads it and computes its rate, as the only element
};

/// A port of an element: `what`: the kind of its item; `how`: its use; `role`: its name in messages and files.
struct port {
  kind what;
  access how;
  std::string_view role;
  /// Whether the element writes it.
  constexpr bool writes() const { return how == access::out || how == access::base; }
  /// Whether the element writes or declares the item, which must then be new.
  constexpr bool declares() const { return declares(how); }
  static constexpr bool declares(access a) { return a == access::out || a == access::base || a == access::keep; }
};

/// The number of ports of an element core, in the order of its arguments.
template <class Core>
inline constexpr std::size_t port_count = Core::ports.size();

/// The number of ports that it reads; the port that it writes is the last.
template <class Core>
inline constexpr std::size_t input_count = port_count<Core> - (Core::ports.back().writes() ? 1 : 0);

namespace detail {
/// Whether it writes a signal, as a measure or a control. It then has no loads.
template <class Core>
inline constexpr bool writes_signal = Core::ports.back().how == access::out&& is_signal(Core::ports.back().what);
/// Whether such an element measures accelerations: its core then says so by `static constexpr bool
/// reads_accelerations = true`, and no force may depend on what it writes.
template <class Core>
inline constexpr bool reads_accelerations = false;
template <class Core>
requires requires { Core::reads_accelerations; }
inline constexpr bool reads_accelerations<Core> = Core::reads_accelerations;

/// Whether it has a distributed mass: `mass_loads(things...)`, its loads for accelerations alone.
template <class Core>
inline constexpr bool distributed_mass = false;
template <class Core>
requires requires { Core::distributed_mass; }
inline constexpr bool distributed_mass<Core> = Core::distributed_mass;
template <class Core>
requires requires { Core::spreads_mass; }
inline constexpr bool distributed_mass<Core> = former::spreads_mass<Core>;

/// Whether it is a load from outside, constant or given by signals, that `static_equilibrium` puts on in parts: what it
/// acts on comes first among its ports.
template <class Core>
inline constexpr bool is_load = false;
template <class Core>
requires requires { Core::is_load; }
inline constexpr bool is_load<Core> = Core::is_load;

/// Whether it is a joint whose friction depends on what the joint carries: `friction(coordinate, wrench of the end)`,
/// a load on the coordinate.
template <class Core>
inline constexpr bool load_dependent_friction = false;
template <class Core>
requires requires { Core::load_dependent_friction; }
inline constexpr bool load_dependent_friction<Core> = Core::load_dependent_friction;
template <class Core>
requires requires { Core::reads_reaction; }
inline constexpr bool load_dependent_friction<Core> = former::reads_reaction<Core>;

/// Whether it is a joint whose axes depend on its coordinates, in axes of the end: its core then says so by `static
/// constexpr bool varying_axes = true`. Joints of several coordinates are taken for such.
template <class Core>
inline constexpr bool varying_axes = Core::ports.size() > 3 && Core::ports[0].what == kind::gen &&
                                     Core::ports[1].what == kind::gen && is_frame(Core::ports.back().what);
template <class Core>
requires requires { Core::varying_axes; }
inline constexpr bool varying_axes<Core> = Core::varying_axes;

/// Whether it closes a kinematic loop: its core derives from `closure` (contract/closure.hpp), and its last port is the
/// name of the loop.
template <class Core>
inline constexpr bool is_closure = Core::ports.back().what == kind::loop&& Core::ports.back().how == access::keep;

/// Whether its loads are the power dual of its motion, as in a mechanism. An element for controllers without this
/// property declares `static constexpr bool power_dual = false`: only passes and inverse dynamics support it.
template <class Core>
inline constexpr bool power_dual = true;
template <class Core>
requires requires { Core::power_dual; }
inline constexpr bool power_dual<Core> = Core::power_dual;

/// Whether it may hold a coordinate: contract/coordinate_lock.hpp.
template <class Core>
inline constexpr bool locks_coordinate = false;
template <class Core>
requires requires { Core::locks_coordinate; }
inline constexpr bool locks_coordinate<Core> = Core::locks_coordinate;
/// Whether it is a joint that may hold its own coordinate, by what it carries.
template <class Core>
inline constexpr bool locks_by_load = load_dependent_friction<Core>&& locks_coordinate<Core>;

/// Whether the forces of an element depend on positions, rotations or linear velocities of frames: its core then says
/// so by `static constexpr bool reads_positions = true`.
template <class Core>
inline constexpr bool reads_positions = false;
template <class Core>
requires requires { Core::reads_positions; }
inline constexpr bool reads_positions<Core> = Core::reads_positions;

/// Whether the forces of an element with a mass are those of a rigid body on its frame, `core.body`, or of the mass of
/// its coordinate, and no others.
template <class Core>
inline constexpr bool is_rigid_body = false;
}  // namespace detail

/// An element in a message: "revolute_joint_3D (coordinate 'q', base 'a', end 'b')".
[[nodiscard]] inline std::string describe_element(std::string_view type, std::span<const port> ports,
                                                  std::span<const std::string_view> names) {
  std::string s(type);
  for (std::size_t i = 0; i < ports.size(); ++i)
    s.append(i == 0 ? " (" : ", ").append(ports[i].role).append(" '").append(names[i]).append("'");
  return s + ")";
}

/// The name of a type of elements, `text`: "rigid_link" in space gives "rigid_link_3D".
template <std::size_t N>
struct type_name {
  char text[N + 4]{};
  constexpr type_name(const char (&stem)[N], kind k) {
    std::copy_n(stem, N - 1, text);
    const std::string_view suffix = k == kind::gen ? "_gen" : k == kind::frame_2D ? "_2D" : "_3D";
    std::copy_n(suffix.data(), suffix.size(), text + N - 1);
  }
  constexpr operator std::string_view() const { return {text}; }  // NOLINT(google-explicit-constructor)
};

}  // namespace kte
