#pragma once

#include <kte/dynamics/closed_loops/chain_constraints.hpp>
#include <kte/dynamics/contacts/contact_forces.hpp>
#include <kte/runtime_chain.hpp>

namespace kte {

namespace detail {
const contact_dynamics_result& contact_dynamics_under_kept(const runtime_chain& c, runtime_state& s);
}  // namespace detail

/// Accelerations of a chain with rigid contacts, and the contact forces, with Coulomb's law of friction:
///
///   M a = tau - bias + J^T lambda,   u' = J a + J_dot v                                     (1)
///   lambda_n >= 0,   g'' >= 0,   lambda_n g'' = 0                                            (2)
///   |lambda_t| <= mu lambda_n if u_t' = 0,   otherwise lambda_t = -mu lambda_n u_t'/|u_t'|   (3)
///   lambda_t = -mu lambda_n u_t/|u_t| for contacts that slide                                (4)
///
/// at contacts that touch: gap at most 1e-9 of the length of the chain, no velocity apart. Closures of loops are
/// satisfied too.
///
///   contact_dynamics(c, s, q, v, tau)    r.a, r.force("foot"), r.contact("foot").mode
///
/// The result is in the memory of the state until the next call; coordinates, contacts and loops of the state get
/// accelerations and forces. Arguments and errors as for `forward_dynamics`. Throws `bad_argument` for a contact whose
/// frames approach, and `no_solution` if no forces satisfy the laws; `impact` gives the velocities after both.
template <indexable Q, indexable V, indexable T>
const contact_dynamics_result& contact_dynamics(const runtime_chain& c, runtime_state& s, const Q& q, const V& v,
                                                const T& tau) {
  detail::check_regular_tree(c, s);
  return detail::take(c, s, q, v, detail::not_given{}, tau).call([&]() -> const auto& {
    for (int i = 0; i < s.dofs(); ++i)
      s.work.kept[static_cast<std::size_t>(i)] = static_cast<double>(tau[static_cast<std::size_t>(i)]);
    return detail::contact_dynamics_under_kept(c, s);
  });
}

}  // namespace kte

namespace kte::detail {

/// The memory of a runtime state for the contacts of its chain.
struct contact_memory_of_state : contact_solver {
  std::shared_ptr<const char> layout;
  contact_dynamics_result result;
  contact_memory_of_state(const chain_constraints& c, const runtime_state& s)
      : contact_solver(c, s), layout(c.layout()) {
    for (const auto& x : contacts) result.names.push_back(c.loop_name(place(x).loop));
    result.contacts.resize(contacts.size());
  }
};
inline contact_memory_of_state& contact_memory(const runtime_chain& c, runtime_state& s) {
  const auto make = [&] { return contact_memory_of_state(contacts_of(c), s); };
  auto& m = s.contacts.get<contact_memory_of_state>(make);
  if (m.layout != c.wiring().layout) m = make();
  return m;
}
#ifdef KTE_FUNCTION
KTE_FUNCTION const contact_dynamics_result& contact_dynamics_under_kept(const runtime_chain& c, runtime_state& s) {
  auto& m = contact_memory(c, s);
  m.result.several = accelerate_with_contacts(contacts_of(c), s, m, tree::given_forces(s.work.kept.data()));
  check_result(s, diagnose_state{"an acceleration", s});
  m.put_loop_forces(m.loop_forces), put_forces_of_closures(m, s);
  write_numbers<vector_of::a>(s, s.work.forces, "a");
  m.result.a = s.work.forces;
  for (std::size_t i = 0; i < m.contacts.size(); ++i) m.result.contacts[i] = s.get<kind::contact>(m.contacts[i].slot);
  return m.result;
}
#endif

}  // namespace kte::detail
