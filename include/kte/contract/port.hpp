#pragma once

#include <kte/contract/key.hpp>

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
/// Whether it closes a kinematic loop: its core derives from `closure` (contract/closure.hpp), and its last port is the
/// name of the loop.
template <class Core>
inline constexpr bool is_closure = Core::ports.back().what == kind::loop&& Core::ports.back().how == access::keep;
/// Whether it is a contact: its core derives from `contact` (contract/contact.hpp), and its last port is its name.
template <class Core>
inline constexpr bool is_contact = Core::ports.back().what == kind::contact&& Core::ports.back().how == access::keep;
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
