#pragma once

#include <kte/dynamics/detail/reduction.hpp>

#include <boost/hana/transform.hpp>

#include <string>
#include <vector>

/// Chains in which some joints are locked: of runtime chains by name, of static chains by key.
namespace kte {

/// A chain without the degrees of freedom that are named: their joints are links, in the position that they have at q.
/// Names of frames, and of all other coordinates, stay; these keep their order, so q and v of the new chain are the
/// old ones without the numbers of the locked.
///
///   const auto planar = kte::reduced(arm, q, "wrist", "elbow");
///
/// Coordinates that follow none but locked ones are locked with them. A number that springs, dampers or motors act on
/// is still there for them, as a constant, and so is their energy; masses on it, and brakes, are gone. Throws
/// `unknown_name`, and `bad_argument` for what is no degree of freedom, or a rotation or pose that something besides
/// its joint acts on.
template <indexable Q, text_type... Names>
requires(!names_something<Q>) runtime_chain reduced(const runtime_chain& c, const Q& q, const Names&... names) {
  detail::chain_reduction r(c, q);
  (r.lock(names), ...);
  return r.make();
}
template <indexable Q>
runtime_chain reduced(const runtime_chain& c, const Q& q, const std::vector<std::string>& names) {
  detail::chain_reduction r(c, q);
  for (const auto& name : names) r.lock(name);
  return r.make();
}

/// The same of a static chain, by keys; in double. Nothing but joints may read a coordinate that is locked.
template <class Gravity, class... E, indexable Q, key_type... Locked>
auto reduced(const static_chain<Gravity, E...>& c, const Q& q, const Locked&...) {
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
  static_assert(known, "kte: this chain has no degree of freedom of this name, which could be locked");
  static_assert(clean || !known,
                "kte: an element besides its joint acts on a coordinate that is to be locked: leave it out, or use a "
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
