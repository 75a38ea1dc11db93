#pragma once

#include <kte/dynamics/detail/reduction.hpp>

#include <boost/hana/transform.hpp>

#include <string>
#include <vector>

/// Chains with locked joints: runtime chains by name, static chains by key.
namespace kte {

/// A chain without the named degrees of freedom: their joints become links, fixed at q. Frames and the other
/// coordinates keep their names and order, so q and v of the new chain are the old ones without the numbers of the
/// locked coordinates.
///
///   const auto planar = kte::reduced(arm, q, "wrist", "elbow");
///
/// Coordinates that follow only locked coordinates are locked too. Springs, dampers and motors see a locked number as a
/// constant; their energy remains. Masses and brakes on it are removed. Throws `unknown_name`, and `bad_argument` for a
/// name that is not a degree of freedom, and for a rotation or pose on which an element other than its joint acts.
template <indexable Q, text_type... Names>
requires(!names_something<Q>) runtime_chain reduced(const runtime_chain& c, const Q& q, const Names&... names) {
  detail::chain_reduction r(c, q);
  (r.lock(names), ...);
  return r.make();
}
template <indexable Q>
[[nodiscard]] runtime_chain reduced(const runtime_chain& c, const Q& q, const std::vector<std::string>& names) {
  detail::chain_reduction r(c, q);
  for (const auto& name : names) r.lock(name);
  return r.make();
}

/// A static chain with locked joints, by keys; in double. Only joints may read a locked coordinate.
template <class Gravity, class... E, indexable Q, key_type... Locked>
[[nodiscard]] auto reduced(const static_chain<Gravity, E...>& c, const Q& q, const Locked&...) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  using wiring = typename chain_type::wiring;
  constexpr bool known = (is_freedom<Locked, wiring> && ...);
  constexpr bool clean = [] {
    const auto each = []<class Key>(std::type_identity<Key>) {
      const bool all[]{locks_cleanly<Key, E>..., true};
      for (const bool each_one : all)
        if (!each_one) return false;
      return true;
    };
    return (each(std::type_identity<Locked>{}) && ...);
  }();
  static_assert(known, "kte: this chain has no degree of freedom of this name to lock");
  static_assert(clean || !known,
                "kte: an element other than its joint acts on a coordinate to be locked: leave it out, or use a "
                "runtime chain");
  check_configuration<chain_type>(q);
  if constexpr (known && clean) {
    const configuration<value_of<Q>, wiring, Q> at(q);
    at.check();
    const given g{at, same<skip>{}, same<skip>{}, base_with_pose};
    const static_reduction<chain_type, std::remove_const_t<decltype(g)>, Locked...> reduce{c, g};
    return boost::hana::unpack(boost::hana::transform(c.elements(), reduce),
                               [](const auto&... e) { return chain(e...); })
        .gravity(c.gravity());
  } else {
    return c;
  }
}

}  // namespace kte
