#pragma once

#include <kte/dynamics/closed_loops/at_run_time.hpp>
#include <kte/dynamics/closed_loops/static_chains.hpp>
#include <kte/dynamics/contacts/check_contact_frames.hpp>
#include <kte/dynamics/contacts/contact_dynamics_in_lanes.hpp>
#include <kte/dynamics/contacts/static_contacts.hpp>
#include <kte/dynamics/contacts/unrolled_contacts.hpp>
#include <kte/dynamics/unrolled/arguments.hpp>

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
  check_configuration<Chain>(q), check_velocities<Chain>(v);
  const configuration<double, typename Chain::wiring, Q> at(q);
  at.check();
  const given g{at, each<double, V>{v}, not_moving{}, base_under_gravity(c)};
  auto lent = c.kept.template borrow<static_contact_state<Chain>>(c);
  static_contact_state<Chain>& s = lent;
  s.take(g), check_regular(c, s);
  return f(static_contacts<Chain, std::remove_cvref_t<decltype(g)>>{{{c, g}}}, s);
}
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
template <class Chain, class S>
auto& solver_of(static_contact_state<Chain, S>& s) {
  if constexpr (is_pack<S>)
    return s.lanes;
  else
    return s.contacts;
}
template <class Chain, class Q, class V, class S>
static_contact_dynamics_result<Chain, S> contact_dynamics_unrolled(const Chain& c, const Q& q, const V& v,
                                                                   const joint_vector<S, Chain::dofs>& tau) {
  check_configuration<Chain>(q);
  const configuration<S, typename Chain::wiring, Q> at(q);
  at.check();
  using given_type = given_on_contacts<Chain, Q, V>;
  const given_type g{at, each<S, V>{v}, {}, base_beside_contacts(c)};
  auto lent = c.kept.template borrow<static_contact_state<Chain, S>>(c);
  auto& m = solver_of<Chain, S>(lent);
  const static_contacts<Chain, given_type> contacts{{{c, g}}};
  static_contact_dynamics_result<Chain, S> r;
  r.several = chain_on_contacts<S, Chain, given_type>(c, g).accelerate(contacts, m, tau, r.a);
  put_contacts_at(
      m, [&r](int slot) -> auto& { return r.contacts[static_cast<std::size_t>(slot)]; });
  return r;
}
/// By the loops of runtime chains, in packs.
template <class Chain, class Q, class V, class S>
static_contact_dynamics_result<Chain, S> contact_dynamics_in_lanes(const Chain& c, const Q& q, const V& v,
                                                                   const joint_vector<S, Chain::dofs>& tau) {
  check_configuration<Chain>(q);
  return at_run_time<S>(c, [&](const auto& chain, auto& s) {
    const auto& found = contact_dynamics(chain, s, q, v, tau);
    static_contact_dynamics_result<Chain, S> r;
    r.a = found.a, r.several = found.several;
    for (std::size_t i = 0; i < r.contacts.size(); ++i) r.contacts[i] = found.contacts[i];
    return r;
  });
}
}  // namespace detail

/// As for runtime chains; r.contact(foot).mode, r.force(foot). In packs for q, v and tau of packs.
template <class Gravity, class... E, indexable Q, indexable V, indexable T>
[[nodiscard]] auto contact_dynamics(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const T& tau) {
  using chain_type = static_chain<Gravity, E...>;
  using S = detail::scalar_at_contacts<Q>;
  static_assert(std::is_convertible_v<value_of<Q>, double> || detail::has_lanes_of_double<value_of<Q>>,
                "kte: contacts are computed in double, and packs of it");
  static_assert(sizeof(detail::check_contact_frames<chain_type>) > 0);
  check_size<chain_type::dofs>(v, "v"), check_size<chain_type::dofs>(tau, "tau");
  joint_vector<S, chain_type::dofs> f;
  for (int i = 0; i < chain_type::dofs; ++i) f[i] = static_cast<S>(tau[static_cast<std::size_t>(i)]);
  if constexpr (detail::unrolls_contacts<chain_type, Q, V>)
    return detail::contact_dynamics_unrolled(c, q, v, f);
  else if constexpr (detail::is_pack<S>)
    return detail::contact_dynamics_in_lanes(c, q, v, f);
  else
    return detail::with_contacts_at(c, q, v, [&](const auto& contacts, auto& s) {
      static_contact_dynamics_result<chain_type> r;
      r.several = detail::accelerate_with_contacts(contacts, s, s.contacts, tree::given_forces(f.data()));
      r.a = s.work.forces;
      detail::check_accelerations<typename chain_type::wiring>(r.a, contacts.given, f);
      for (std::size_t i = 0; i < r.contacts.size(); ++i)
        r.contacts[i] = s.template get<kind::contact>(static_cast<int>(i));
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
  return detail::with_contacts_at(c, q, v, [&](const auto& contacts, auto& s) {
    static_impact_result<chain_type> r;
    Eigen::VectorXd& after = s.contacts.velocities;
    after.resize(chain_type::dofs);
    for (int i = 0; i < chain_type::dofs; ++i) after[i] = static_cast<double>(v[static_cast<std::size_t>(i)]);
    detail::strike(contacts, s, s.contacts, s.impacts, law, after);
    r.v = after, r.energy = s.impacts.result.energy, r.restitution = s.impacts.result.restitution;
    s.contacts.each_force([&r](std::size_t i, const vec3<>& p) { r.impulses[i] = p; });
    return r;
  });
}

}  // namespace kte
