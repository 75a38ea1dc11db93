#pragma once

#include <kte/dynamics/contacts/check_contact_frames.hpp>
#include <kte/dynamics/contacts/contact_dynamics_in_lanes.hpp>
#include <kte/dynamics/contacts/impact.hpp>
#include <kte/dynamics/contacts/unrolled_contacts.hpp>
#include <kte/dynamics/runtime/at_run_time.hpp>
#include <kte/dynamics/unrolled/arguments.hpp>

/// Contacts of static chains, by the algorithms of runtime chains; unrolled up to the friction problem where
/// unrolled_contacts.hpp can (docs/decisions/30-unrolled-contacts.md).
namespace kte {

namespace detail {
template <class Chain, class Key>
inline constexpr std::size_t slot_of_contact = [] {
  constexpr int slot = Key::what == kind::contact ? Chain::wiring::template find<Key>() : -1;
  static_assert(slot >= 0, "kte: this chain has no contact of this name (contact_key)");
  return std::size_t{slot < 0 ? 0 : slot};
}();
}  // namespace detail

/// The result of `contact_dynamics` of a static chain. S: double, or packs of states.
template <class Chain, class S = double>
struct static_contact_dynamics_result {
  joint_vector<S, Chain::dofs> a;       ///< accelerations
  detail::truth_of_lanes<S> several{};  ///< as for runtime chains
  std::array<contact_state<S>, static_cast<std::size_t>(Chain::wiring::count(kind::contact))> contacts;

  /// A contact: its gap, slip, force and mode.
  template <key_type Key>
  const contact_state<S>& contact(const Key&) const {
    return contacts[detail::slot_of_contact<Chain, Key>];
  }
  /// The force of a contact on its body, N, in axes of its surface.
  template <key_type Key>
  const vec3<S>& force(const Key& key) const {
    return contact(key).force;
  }
};

namespace detail {
template <class S, class Chain, class Q, class V, class T>
static_contact_dynamics_result<Chain, S> contact_dynamics_unrolled(const Chain& c, const Q& q, const V& v,
                                                                   const T& tau) {
  return at_run_time(c, q, v, tau, [&c](const auto& r, auto& s, const auto& x, const auto& rates, const auto& forces) {
    const S* const positions = x.data();  // `each` refers to its numbers
    const S* const velocities = rates.data();
    const configuration<S, typename Chain::wiring, const S*> at(positions);
    at.check();
    const given_on_contacts<Chain, S> g{at, each<S, const S*>{velocities}, {}, base_beside_contacts(c)};
    auto& m = solver_of(r, s);
    static_contact_dynamics_result<Chain, S> result;
    result.several = chain_on_contacts<S, Chain, given_on_contacts<Chain, S>>(c, g).accelerate(
        contacts_of(r), m, joint_vector<S, Chain::dofs>(forces), result.a);
    put_contacts_at(
        m, [&result](int slot) -> auto& { return result.contacts[static_cast<std::size_t>(slot)]; });
    return result;
  });
}
}  // namespace detail

/// As for runtime chains; r.contact(foot).mode, r.force(foot). In packs for q, v and tau of packs.
template <class Gravity, class... E, indexable Q, indexable V, indexable T>
[[nodiscard]] auto contact_dynamics(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const T& tau) {
  using chain_type = static_chain<Gravity, E...>;
  static_assert(sizeof(detail::check_contact_frames<chain_type>) > 0);
  using S = detail::scalar_at_run_time<Q>;
  if constexpr (detail::unrolls_contacts<chain_type, S>)
    return detail::contact_dynamics_unrolled<S>(c, q, v, tau);
  else
    return detail::at_run_time(c, q, v, tau, [](auto&... at) {
      const auto& found = contact_dynamics(at...);
      static_contact_dynamics_result<chain_type, S> r;
      r.a = found.a, r.several = found.several;
      std::copy(found.contacts.begin(), found.contacts.end(), r.contacts.begin());
      return r;
    });
}

/// The result of `impact` of a static chain.
template <class Chain>
struct static_impact_result {
  joint_vector<double, Chain::dofs> v;  ///< velocities after the impact
  double energy = 0;                    ///< as for runtime chains
  double restitution = 1;               ///< as for runtime chains
  std::array<vec3<>, static_cast<std::size_t>(Chain::wiring::count(kind::contact))> impulses{};

  /// The impulse of a contact on its body, Ns, in axes of its surface.
  template <key_type Key>
  const vec3<>& impulse(const Key&) const {
    return impulses[detail::slot_of_contact<Chain, Key>];
  }
};

/// As for runtime chains; r.v, r.impulse(foot).
template <class Gravity, class... E, indexable Q, indexable V>
[[nodiscard]] auto impact(const static_chain<Gravity, E...>& c, const Q& q, const V& v,
                          impact_law law = impact_law::at_once) {
  using chain_type = static_chain<Gravity, E...>;
  static_assert(sizeof(detail::check_contact_frames<chain_type>) > 0);
  return detail::at_run_time(c, q, v, [law](auto&... at) {
    const impact_result& found = impact(at..., law);
    static_impact_result<chain_type> r;
    r.v = found.v, r.energy = found.energy, r.restitution = found.restitution;
    std::copy(found.impulses.begin(), found.impulses.end(), r.impulses.begin());
    return r;
  });
}

}  // namespace kte
