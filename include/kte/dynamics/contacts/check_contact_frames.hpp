#pragma once

#include <kte/dynamics/unrolled/tree.hpp>

#include <array>

namespace kte::detail {

template <class Core>
constexpr bool is_joint_core() {
  if constexpr (is_transmission<Core>)
    return coordinates_of<Core> > 0;
  else
    return false;
}
/// The elements from a frame of a static chain to its base.
template <class Chain, kind K, int Slot>
struct way_of_frame {
  static constexpr std::size_t size = Chain::size;
  /// The element that writes the frame; then the one before each element, or -1.
  static constexpr int tip = Chain::wiring::writer(K, Slot);
  static constexpr auto below = []<std::size_t... I>(std::index_sequence<I...>) {
    return std::array<int, size + 1>{joint_place_of<Chain, I, is_free_joint<Chain, I>>().below..., -1};
  }
  (std::make_index_sequence<size>{});
  static constexpr auto is_joint = []<std::size_t... I>(std::index_sequence<I...>) {
    return std::array<bool, size + 1>{is_joint_core<core_of<Chain, I>>()...};
  }
  (std::make_index_sequence<size>{});
  static constexpr auto is_rigid = []<std::size_t... I>(std::index_sequence<I...>) {
    return std::array<bool, size + 1>{is_transmission<core_of<Chain, I>>...};
  }
  (std::make_index_sequence<size>{});

  static constexpr bool by_joints_and_links = [] {
    for (int at = tip; at >= 0; at = below[static_cast<std::size_t>(at)])
      if (!is_rigid[static_cast<std::size_t>(at)]) return false;
    return true;
  }();
  /// The joints from the frame on, then -1.
  static constexpr auto joints = [] {
    std::array<int, size + 1> all{};
    all.fill(-1);
    std::size_t count = 0;
    for (int at = tip; at >= 0; at = below[static_cast<std::size_t>(at)])
      if (is_joint[static_cast<std::size_t>(at)]) all[count++] = at;
    return all;
  }();
};
/// The frame at a port of a contact.
template <class Chain, std::size_t E, std::size_t Port>
using way_at_port = way_of_frame<Chain, core_of<Chain, E>::ports[Port].what, Chain::wiring::slot(E, Port)>;

/// Whether joints may move the frames of contact E of a chain relative to each other; of frames that follow others this
/// is not known.
template <class Chain, std::size_t E>
inline constexpr bool moves_apart = [] {
  using first = way_at_port<Chain, E, 0>;
  using second = way_at_port<Chain, E, 1>;
  return !first::by_joints_and_links || !second::by_joints_and_links || first::joints != second::joints;
}();
template <class Frame1, class Frame2, class Contact, bool MovesApart>
struct check_frames_of_contact {
  static_assert(
      MovesApart,
      "kte: no joint moves the frames of this contact relative to each other (types Frame1, Frame2, Contact): "
      "they are on one body, or both on bases");
};
/// `type`: the check of element E of a chain, or nothing.
template <class Chain, std::size_t E, class Element>
struct check_of_element {
  struct type {};
};
template <class Chain, std::size_t E, class Core, class Frame1, class Frame2, class Contact>
requires is_contact<Core>
struct check_of_element<Chain, E, element<Core, Frame1, Frame2, Contact>> {
  using type = check_frames_of_contact<Frame1, Frame2, Contact, moves_apart<Chain, E>>;
};
template <class Chain, class Numbers = std::make_index_sequence<Chain::size>>
struct check_contact_frames;
/// Refuses contacts between frames that no joint moves relative to each other.
template <class Gravity, class... Element, std::size_t... E>
struct check_contact_frames<static_chain<Gravity, Element...>, std::index_sequence<E...>>
    : check_of_element<static_chain<Gravity, Element...>, E, Element>::type... {};

}  // namespace kte::detail
