#pragma once

#include <kte/dynamics/closed_loops/static_chains.hpp>
#include <kte/dynamics/contacts/static_contacts.hpp>

/// Contacts of static chains: the algorithms of runtime chains on memory that the chain keeps.
namespace kte {

namespace detail {
template <class Chain, class Key>
inline constexpr std::size_t slot_of_contact = [] {
  constexpr int slot = Key::what == kind::contact ? Chain::wiring::template find<Key>() : -1;
  static_assert(slot >= 0, "kte: this chain has no contact of this name (contact_key)");
  return std::size_t{slot < 0 ? 0 : slot};
}();
/// Calls f(contacts, state with its contacts) at q and v.
template <class Chain, class Q, class V, class F>
decltype(auto) with_contacts_at(const Chain& c, const Q& q, const V& v, const F& f) {
  static_assert(std::is_convertible_v<value_of<Q>, double>, "kte: contacts are computed in double");
  check_configuration<Chain>(q);
  const configuration<double, typename Chain::wiring, Q> at(q);
  at.check();
  const given g{at, each<double, V>{v}, not_moving{}, base_under_gravity(c)};
  auto lent = c.kept.template borrow<static_contact_state<Chain>>(c);
  static_contact_state<Chain>& s = lent;
  s.take(g), check_regular(c, s);
  return f(static_contacts<Chain, std::remove_cvref_t<decltype(g)>>{{{c, g}}}, s);
}
}  // namespace detail

/// The result of `contact_dynamics` of a static chain.
template <class Chain>
struct static_contact_dynamics_result {
  joint_vector<double, Chain::dofs> a;  ///< accelerations
  bool several = false;                 ///< as for runtime chains
  std::array<contact_state<>, static_cast<std::size_t>(Chain::wiring::count(kind::contact))> contacts;

  /// A contact: its gap, slip, force and mode.
  template <key_type Key>
  const contact_state<>& contact(const Key&) const {
    return contacts[detail::slot_of_contact<Chain, Key>];
  }
  /// The force of a contact on its body, N, in axes of its surface.
  template <key_type Key>
  const vec3<>& force(const Key& key) const {
    return contact(key).force;
  }
};

/// As for runtime chains; r.contact(foot).mode, r.force(foot).
template <class Gravity, class... E, indexable Q, indexable V, indexable T>
[[nodiscard]] auto contact_dynamics(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const T& tau) {
  using chain_type = static_chain<Gravity, E...>;
  check_size<chain_type::dofs>(v, "v"), check_size<chain_type::dofs>(tau, "tau");
  joint_vector<double, chain_type::dofs> f;
  for (int i = 0; i < chain_type::dofs; ++i) f[i] = static_cast<double>(tau[static_cast<std::size_t>(i)]);
  return detail::with_contacts_at(c, q, v, [&](const auto& contacts, auto& s) {
    static_contact_dynamics_result<chain_type> r;
    r.several = detail::accelerate_with_contacts(contacts, s, s.contacts, [&f](int i) { return f[i]; });
    r.a = s.work.forces;
    detail::check_accelerations<typename chain_type::wiring>(r.a, contacts.given, f);
    for (std::size_t i = 0; i < r.contacts.size(); ++i)
      r.contacts[i] = s.template get<kind::contact>(static_cast<int>(i));
    return r;
  });
}

}  // namespace kte
