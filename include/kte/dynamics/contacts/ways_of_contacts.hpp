#pragma once

#include <kte/dynamics/unrolled/tree.hpp>

#include <algorithm>
#include <array>

/// The frames of the contacts of a static chain.
namespace kte::detail {

template <class Core>
constexpr bool is_joint_core() {
  if constexpr (is_transmission<Core>)
    return coordinates_of<Core> > 0;
  else
    return false;
}
/// The elements from a frame to its base, and the rows of v of their degrees of freedom.
template <class Chain, kind K, int Slot>
struct way_of_frame {
  using wiring = typename Chain::wiring;
  static constexpr int tip = wiring::writer(K, Slot);
  static constexpr auto places = []<std::size_t... I>(std::index_sequence<I...>) {
    return std::array{joint_place_of<Chain, I, is_free_joint<Chain, I>>()..., joint_place{}};
  }
  (std::make_index_sequence<Chain::size>{});
  static constexpr bool by_joints_and_links = [] {
    constexpr auto transmits = []<std::size_t... I>(std::index_sequence<I...>) {
      return std::array<bool, Chain::size + 1>{is_transmission<core_of<Chain, I>>...};
    }
    (std::make_index_sequence<Chain::size>{});
    for (int at = tip; at >= 0; at = places[static_cast<std::size_t>(at)].below)
      if (!transmits[static_cast<std::size_t>(at)]) return false;
    return true;
  }();
  /// From the base on.
  struct list {
    std::size_t count = 0;
    std::array<int, std::size_t{Chain::dofs} + 1> row{};
  };
  static constexpr list rows = [] {
    list l;
    for (int at = tip; at >= 0; at = places[static_cast<std::size_t>(at)].below) {
      const joint_place& p = places[static_cast<std::size_t>(at)];
      for (int row = p.row + p.axes; row-- > p.row;) l.row[l.count++] = row;
    }
    std::reverse(l.row.begin(), l.row.begin() + static_cast<std::ptrdiff_t>(l.count));
    return l;
  }();
  static constexpr bool moves = rows.count > 0;
  /// The joints from the frame on, then -1.
  static constexpr auto joints = [] {
    constexpr auto is_joint = []<std::size_t... I>(std::index_sequence<I...>) {
      return std::array<bool, Chain::size + 1>{is_joint_core<core_of<Chain, I>>()...};
    }
    (std::make_index_sequence<Chain::size>{});
    std::array<int, Chain::size + 1> all{};
    all.fill(-1);
    std::size_t count = 0;
    for (int at = tip; at >= 0; at = places[static_cast<std::size_t>(at)].below)
      if (is_joint[static_cast<std::size_t>(at)]) all[count++] = at;
    return all;
  }();
};

template <class Chain, class Elements = std::make_index_sequence<Chain::size>>
struct contacts_among;
/// The contacts of a chain, as an index_sequence of elements.
template <class Chain, std::size_t... E>
struct contacts_among<Chain, std::index_sequence<E...>>
    : numbers_where<std::array<bool, sizeof...(E) + 1>{is_contact<core_of<Chain, E>>...}> {};
/// The frames of a contact.
template <class Chain, std::size_t E, std::size_t Port>
using way_at_port = way_of_frame<Chain, core_of<Chain, E>::ports[Port].what, Chain::wiring::slot(E, Port)>;

}  // namespace kte::detail
