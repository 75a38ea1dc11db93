#pragma once

#include <kte/dynamics/frame_motion.hpp>
#include <kte/elements/base.hpp>
#include <kte/elements/rigid_link.hpp>
#include <kte/runtime_chain.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <tuple>
#include <vector>

/// The elements of a chain after joints are locked.
namespace kte::detail {

/// The pose of a link in the plane and in space, with the type that links have.
template <kind Dim, class M>
constexpr auto link_at(const M& m) {
  if constexpr (Dim == kind::frame_2D) {
    const auto r = as<double>(m.rotation * rotation_2D{one, zero});
    const auto p = in_plane(vec2<double>{as<double>(m.position.x), as<double>(m.position.y)});
    return core::rigid_link<Dim, rotation_2D<>, vec3<double, double, zero_t>>(p, r);
  } else {
    return core::rigid_link<Dim, mat3<vec3<>>, vec3<>>(as<double>(m.position), as<double>(matrix(m.rotation)));
  }
}

/// Visits the elements of a runtime chain in order, at a configuration.
class chain_reduction {
  enum lock_state : char {
    free = 0,
    as_locked,
    as_constant
  };  ///< as_locked: removed; as_constant: added again as a constant
  template <class Lists>
  static auto& at(Lists& lists, kind k, int i) {
    return lists[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)];
  }

 public:
  template <class Q>
  chain_reduction(const runtime_chain& c, const Q& q) : chain_(c), state_(c.make_state()) {
    refuse_loops(c), refuse_contacts(c);
    take(c, state_, q);
    for (std::size_t k = 0; k < kinds; ++k) locked_[k].resize(c.wiring().names[k].size());
  }
  /// Locks a coordinate or joint. Throws `unknown_name`, `bad_argument`.
  void lock(std::string_view name) {
    const topology& t = chain_.wiring();
    const kind k = t.kind_of(name, false);
    const int index = t.find(name, k);
    for (const freedom& f : t.free)
      if (f.what == k && f.slot == index) {
        at(locked_, k, index) = as_locked;
        return;
      }
    throw bad_argument("kte: '" + std::string(name) + "' is not a degree of freedom: only those can be locked");
  }
  runtime_chain make() {
    runtime_chain r;
    r.gravity(chain_.gravity());
    for (const auto& e : chain_.wiring().elements) add(e, r);
    return r;
  }

 private:
  const std::string& name(kind k, int i) const { return at(chain_.wiring().names, k, i); }

  void add(const topology::connection& e, runtime_chain& to) {
    const std::size_t last = e.ports.size() - 1;
    const bool follows = !e.rigid && e.ports[last].how == access::out && e.ports[last].what == kind::gen;
    bool any = false, all = true;
    for (std::size_t p = 0; p < (follows ? last : last + 1); ++p) {
      const bool is = is_coordinate(e.ports[p].what) && at(locked_, e.ports[p].what, e.index[p]) != free;
      any |= is, all &= is;
    }
    if (follows) e.element->doMotion(state_);  // before joints read it
    if (!any) {
      to.append(e.element->clone());
    } else if (e.rigid) {
      const auto coordinates = std::size_t(
          std::count_if(e.ports.begin(), e.ports.end(), [](const port& p) { return is_coordinate(p.what); }));
      for (std::size_t p = 0; p < coordinates; ++p)
        if (at(locked_, e.ports[p].what, e.index[p]) == free)
          throw bad_argument("kte: " + describe_element(*e.element) +
                             " has several coordinates: lock all of them or none");
      add_link(e, to);
    } else if (follows && all) {
      at(locked_, kind::gen, e.index[last]) = as_locked;
    } else if (!needless(e, all)) {
      for (std::size_t p = 0; p < e.ports.size(); ++p) keep_constant(e.ports[p].what, e.index[p], to);
      to.append(e.element->clone());
    }
  }
  /// Whether an element is not needed: a mass that cannot move, or a lock of a locked coordinate. `all`: it is
  /// connected to nothing else.
  bool needless(const topology::connection& e, bool all) const {
    const auto n = e.element->numbers();
    return (all && n.has_mass) || (n.locks_coordinate && at(locked_, e.ports[0].what, e.index[0]) != free);
  }
  /// The pose of a joint equals that of its end if its base is at the origin.
  void add_link(const topology::connection& e, runtime_chain& to) {
    const std::size_t at_end = e.ports.size() - 1, at_base = at_end - 1;
    const auto& base = name(e.ports[at_base].what, e.index[at_base]);
    const auto& end = name(e.ports[at_end].what, e.index[at_end]);
    if (e.ports[at_base].what == kind::frame_2D) {
      state_.get<kind::frame_2D>(e.index[at_base]) = {};
      e.element->doMotion(state_);
      to << connect(link_at<kind::frame_2D>(spatial(state_.get<kind::frame_2D>(e.index[at_end]))), base, end);
    } else {
      state_.get<kind::frame_3D>(e.index[at_base]) = {};
      e.element->doMotion(state_);
      to << connect(link_at<kind::frame_3D>(state_.get<kind::frame_3D>(e.index[at_end])), base, end);
    }
  }
  /// Replaces a locked coordinate that an element acts on by one at a constant value.
  void keep_constant(kind k, int i, runtime_chain& to) {
    if (!is_coordinate(k) || at(locked_, k, i) != as_locked) return;
    if (k != kind::gen)
      throw bad_argument("kte: '" + name(k, i) + "' cannot be locked: an element other than its joint acts on it");
    const std::string origin = "origin of " + name(k, i);
    to << base_gen(origin) << rigid_link_gen(origin, name(k, i), state_.get<kind::gen>(i).q);
    at(locked_, k, i) = as_constant;
  }

  const runtime_chain& chain_;
  runtime_state state_;
  std::array<std::vector<lock_state>, kinds> locked_;  ///< by kind of item
};

template <class Locked, class Core, class... Keys>
inline constexpr bool reads_key = [] {
  const bool each[]{std::is_same_v<Locked, Keys>..., false};
  for (const bool same : each)
    if (same) return true;
  return false;
}();
/// Whether only joints read the locked coordinates.
template <class Locked, class Element>
inline constexpr bool locks_cleanly = true;
template <class Locked, class Core, class... Keys>
inline constexpr bool locks_cleanly<Locked, element<Core, Keys...>> =
    is_transmission<Core> || !reads_key<Locked, Core, Keys...>;
/// Whether a key names a degree of freedom, or several.
template <class Key, class Wiring>
inline constexpr bool is_freedom = [] {
  constexpr int slot = Wiring::template find<Key>();
  if constexpr (is_coordinate(Key::what) && slot >= 0) {
    return Wiring::freedom_of(Key::what, slot).what == Key::what;
  } else {
    return false;
  }
}();
template <class Chain, class Given, class... Locked>
struct static_reduction {
  using types = flow_types<Chain, Given>;
  using wiring = typename Chain::wiring;
  const Chain& chain;
  const Given& given;

  template <class Core, class... Keys>
  constexpr auto operator()(const element<Core, Keys...>& e) const {
    constexpr bool locked = (reads_key<Locked, Core, Keys...> || ...);
    if constexpr (!locked) {
      return e;
    } else {
      constexpr std::size_t n = coordinates_of<Core>;
      static_assert(rule<Core, void, (0 + ... + reads_key<Locked, Core, Keys...>) == n>,
                    "kte: this joint has several coordinates: lock all of them or none");
      using keys = std::tuple<Keys...>;
      const auto m =
          relative_at(e.core, tuple_of_coordinates<Core>([this]<std::size_t K>() {
                        using key = std::tuple_element_t<K, keys>;
                        return position_only(motion_of<types, key::what, wiring::template find<key>()>(chain, given));
                      }));
      return connect(link_at<Core::ports.back().what>(m), std::tuple_element_t<sizeof...(Keys) - 2, keys>{},
                     std::tuple_element_t<sizeof...(Keys) - 1, keys>{});
    }
  }
};

}  // namespace kte::detail
