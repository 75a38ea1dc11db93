#pragma once

#include <kte/contract/port.hpp>
#include <kte/detail/numbered.hpp>
#include <kte/frames/contact_state.hpp>
#include <kte/frames/loop_state.hpp>
#include <kte/frames/motion.hpp>

#include <utility>

/// The items at the ports of a core as its functions receive them, in plain numbers; for contract/element_core.hpp.
namespace kte::detail {

struct any_visitor {
  template <class T>
  constexpr void operator()(const char*, const T&) const {}
};

template <class... T>
struct things_list {};

/// An item of kind K, and its load.
template <kind K>
struct sample {
  using type = motion<vec3<>, mat3<vec3<>>, vec3<>, vec3<>, vec3<>, vec3<>>;
  using load = wrench<vec3<>, vec3<>>;
};
template <>
struct sample<kind::gen> {
  using type = coordinate<double, double, double, double, double>;
  using load = double;
};
template <kind K>
requires(K == kind::frame_2D || K == kind::pose_2D) struct sample<K> {
  using in_plane = vec3<double, double, zero_t>;
  using about_z = vec3<zero_t, zero_t, double>;
  using type = motion<in_plane, rotation_2D<>, in_plane, about_z, in_plane, about_z>;
  using load = wrench<in_plane, about_z>;
};
template <kind K>
requires(K == kind::input || K == kind::internal) struct sample<K> {
  using type = double;
};
template <>
struct sample<kind::vector> {
  using type = vec3<>;
};
template <>
struct sample<kind::loop> {
  using type = loop_state<>;
};
template <>
struct sample<kind::contact> {
  using type = contact_state<>;
};

template <class Core, std::size_t... P>
things_list<typename sample<Core::ports[P].what>::type...> first_things(std::index_sequence<P...>);
template <class Core, std::size_t... P>
things_list<typename sample<Core::ports[P].what>::type..., typename sample<Core::ports.back().what>::load> with_load_at(
    std::index_sequence<P...>);
/// The items that a core reads; these and the load on the item that it writes.
template <class Core>
using things_read = decltype(first_things<Core>(std::make_index_sequence<input_count<Core>>{}));
template <class Core>
using things_and_load = decltype(with_load_at<Core>(std::make_index_sequence<input_count<Core>>{}));

/// The number of coordinates of a transmission. They are its first ports; the base and the end are its last two.
template <class Core>
inline constexpr std::size_t coordinates_of = [] {
  std::size_t n = 0;
  while (n < port_count<Core> && is_coordinate(Core::ports[n].what)) ++n;
  return n;
}();
/// The coordinates of a transmission.
template <class Core>
using coordinates_at = decltype(first_things<Core>(std::make_index_sequence<coordinates_of<Core>>{}));
/// The number of internal states of an element.
template <class Core>
inline constexpr std::size_t kept_count = [] {
  std::size_t n = 0;
  for (const auto& p : Core::ports) n += p.what == kind::internal && p.how == access::keep;
  return n;
}();

template <class T>
inline constexpr std::size_t load_count = std::size_t(-1);
template <class... L>
inline constexpr std::size_t load_count<values<L...>> = sizeof...(L);
/// The number of ports that a core reads and that have loads.
template <class Core>
inline constexpr std::size_t loaded_ports = [] {
  std::size_t n = 0;
  for (std::size_t p = 0; p < input_count<Core>; ++p) n += !is_signal(Core::ports[p].what);
  return n;
}();
/// The loads of a core: `make_loads(...)`, one for each port with a load.
template <class T, class Core>
concept loads_for = load_count<T>
== loaded_ports<Core>;

/// Whether it writes a coordinate or a frame.
template <class Core>
inline constexpr bool writes_coordinate = Core::ports.back().how
                                          == access::out&& is_coordinate(Core::ports.back().what);
template <class Core>
inline constexpr bool writes_frame = Core::ports.back().how == access::out&& is_frame(Core::ports.back().what);
/// Whether it reads a coordinate.
template <class Core>
inline constexpr bool reads_coordinates = [] {
  for (std::size_t p = 0; p < input_count<Core>; ++p)
    if (is_coordinate(Core::ports[p].what)) return true;
  return false;
}();
template <class Core>
inline constexpr bool has_several_coordinates =
    Core::ports.size() > 3 && Core::ports[0].what == kind::gen&& Core::ports[1].what
                                  == kind::gen&& is_frame(Core::ports.back().what);

}  // namespace kte::detail
