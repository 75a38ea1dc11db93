#pragma once

#include <kte/contract/transmission.hpp>
#include <kte/detail/short_list.hpp>
#include <kte/static_chain/wiring.hpp>
#include <kte/tree/dependencies.hpp>

#include <span>
#include <utility>

/// A static chain in the form that `arrange` (tree/plan.hpp) and `dependencies_of` read.
namespace kte::detail {

template <class Chain, std::size_t I>
using core_of = std::remove_cvref_t<decltype(std::declval<const Chain&>().template core<I>())>;

template <class Wiring, class... Core>
struct connections_of {
  struct element {
    std::span<const port> ports;
    bool rigid, distributed_mass;
  };
  static constexpr std::size_t size = sizeof...(Core);
  std::array<element, size> all{
      {{std::span<const port>(Core::ports), is_transmission<Core>, kte::distributed_mass<Core>}...}};

  constexpr std::size_t elements() const { return size; }
  constexpr std::span<const port> ports(std::size_t e) const { return all[e].ports; }
  constexpr int index(std::size_t e, std::size_t p) const { return Wiring::slot(e, p); }
  constexpr bool rigid(std::size_t e) const { return all[e].rigid; }
  constexpr bool distributed_mass(std::size_t e) const { return all[e].distributed_mass; }
  constexpr int count(kind k) const { return Wiring::count(k); }
  constexpr int writer(kind k, int i) const { return Wiring::writer(k, i); }
  constexpr std::size_t freedoms() const { return Wiring::freedoms; }
  constexpr freedom freedom_at(std::size_t f) const { return Wiring::table.free[f]; }
  constexpr int dofs() const { return Wiring::dofs; }
};
template <class Chain, class Elements = std::make_index_sequence<Chain::size>>
struct connections_in;
template <class Chain, std::size_t... I>
struct connections_in<Chain, std::index_sequence<I...>> {
  using type = connections_of<typename Chain::wiring, core_of<Chain, I>...>;
};
template <class Chain>
using static_connections = typename connections_in<Chain>::type;
template <class Wiring>
struct static_lists {
  /// There are at most two rows per port, because elements have at most six rows for three ports.
  template <class T>
  using list = short_list<T, 2 * Wiring::ports + 2>;
};

/// Whether an element writes a signal, or writes a frame without being a joint or link.
template <class Core>
inline constexpr bool writes_freely = Core::ports.back().how == access::out && !is_transmission<Core> &&
                                      !is_coordinate(Core::ports.back().what);
/// Whether an element writes a coordinate that is not a function of exactly one other.
template <class Core>
inline constexpr bool follows_freely = Core::ports.back().how == access::out&& is_coordinate(Core::ports.back().what) &&
                                       (port_count<Core> != 2 || Core::ports[0].what != kind::gen);

/// The connections of the elements of a chain.
template <class Wiring, class... Core>
struct shapes_of {
  /// For each element: whether it writes freely and forces depend on it.
  static constexpr auto acts_freely = [] {
    std::array<bool, sizeof...(Core) + 1> x{};
    if constexpr ((writes_freely<Core> || ...)) {
      constexpr auto d = dependencies_of<static_lists<Wiring>::template list>(connections_of<Wiring, Core...>{});
      const bool freely[]{writes_freely<Core>...};
      for (std::size_t e = 0; e < sizeof...(Core); ++e) x[e] = freely[e] && d.matters[e];
    }
    return x;
  }();
  /// Whether a force reads positions, rotations or velocities of frames.
  static constexpr bool reads_positions = [] {
    const bool reads[]{kte::reads_positions<Core>..., false}, freely[]{writes_freely<Core>..., false};
    for (std::size_t e = 0; e < sizeof...(Core); ++e)
      if (freely[e] ? acts_freely[e] : reads[e]) return true;
    return false;
  }();
  /// Whether one that is not of a contact does.
  static constexpr bool reads_positions_but_contacts = [] {
    const bool reads[]{(kte::reads_positions<Core> && !is_contact<Core>)..., false};
    for (std::size_t e = 0; e < sizeof...(Core); ++e)
      if (acts_freely[e] || reads[e]) return true;
    return false;
  }();
  /// Whether no part of the chain but contacts requires the loops over body nodes.
  static constexpr bool common_but_contacts = [] {
    const bool rare[]{(follows_freely<Core> || kte::distributed_mass<Core> || kte::load_dependent_friction<Core> ||
                       kte::locks_coordinate<Core> || is_closure<Core> || kte::varying_axes<Core>)...,
                      false};
    for (std::size_t e = 0; e < sizeof...(Core); ++e)
      if (rare[e] || acts_freely[e]) return false;
    return true;
  }();
  /// Whether no part of the chain requires the loops over body nodes.
  static constexpr bool common = common_but_contacts && [] {
    const bool touches[]{is_contact<Core>..., false};
    for (std::size_t e = 0; e < sizeof...(Core); ++e)
      if (touches[e]) return false;
    return true;
  }();
};

}  // namespace kte::detail
