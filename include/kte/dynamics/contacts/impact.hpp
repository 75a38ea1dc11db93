#pragma once

#include <kte/dynamics/contacts/contact_dynamics.hpp>
#include <kte/dynamics/contacts/strike.hpp>

namespace kte {

namespace detail {
const impact_result& impact_at_state(const runtime_chain& c, runtime_state& s, impact_law law);
}  // namespace detail

/// The velocities of a chain after an impact of its contacts, with Coulomb friction and Newton's restitution e:
///
///   M (v^+ - v) = J^T P,   u = J v                                                            (1)
///   P_n >= 0,   u_n^+ + e u_n >= 0,   P_n (u_n^+ + e u_n) = 0                                  (2)
///   |P_t| <= mu P_n if u_t^+ = 0,   otherwise P_t = -mu P_n u_t^+/|u_t^+|                      (3)
///
/// for all contacts with a gap of at most 1e-9 of the length of the chain. Closures of loops are satisfied after it. If
/// energy would grow, which Newton's law with friction permits, all e are reduced by the same factor, which the result
/// contains. `impact_law::sequential`: one contact after the other, the fastest first, as in Newton's cradle.
///
/// If no contact approaches, but sliding is jammed (Painleve), the result is a tangential impact: P_n > 0, e = 0.
///
///   impact(c, s, q, v)    r.v, r.impulse("foot"), r.energy
///
/// The result is in the memory of the state until the next call; the state has the velocities after the impact.
/// Arguments and errors as for `contact_dynamics`.
template <indexable Q, indexable V>
const impact_result& impact(const runtime_chain& c, runtime_state& s, const Q& q, const V& v,
                            impact_law law = impact_law::at_once) {
  detail::check_regular_tree(c, s);
  return detail::take(c, s, q, v).call([&]() -> const auto& { return detail::impact_at_state(c, s, law); });
}

}  // namespace kte

namespace kte::detail {

#ifdef KTE_FUNCTION
KTE_FUNCTION const impact_result& impact_at_state(const runtime_chain& c, runtime_state& s, impact_law law) {
  auto& m = contact_memory(c, s);
  auto& memory = s.impacts.get<impact_memory>([] { return impact_memory{}; });
  auto& r = memory.result;
  r.v = read_numbers<vector_of::v>(s);
  strike(contacts_of(c), s, m, memory, law, r.v);
  r.names = m.result.names;
  r.impulses.assign(m.contacts.size(), {});
  m.each_force([&r](std::size_t i, const vec3<>& p) { r.impulses[i] = p; });
  write_numbers<vector_of::v>(s, r.v, "v");
  return r;
}
#endif

}  // namespace kte::detail
