#pragma once

#include <kte/dynamics/contacts/ways_of_contacts.hpp>

namespace kte::detail {

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
