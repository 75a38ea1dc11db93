#pragma once

#include <kte/contact/impact.hpp>
#include <kte/dynamics/contacts/contact_dynamics.hpp>

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

/// The memory of impacts.
struct impact_memory {
  impact_solver<double> solver;
  std::vector<double> restitution;
  impact_result result;
};
/// Whether a contact that slides at rest in its normal direction is jammed: W_nn - mu W_nt <= 0, t along the velocity.
inline bool is_jammed(const contact_solver& m, std::size_t i) {
  const auto& x = m.touched(i);
  return m.laws[i].sliding && !(m.w(x.first, x.first) > m.laws[i].friction * m.w(x.first, x.first + 1));
}
/// Replaces v by the velocities after the impact at the positions of the state.
template <class Contacts, class State>
void strike(const Contacts& c, State& s, contact_solver& m, impact_memory& memory, impact_law law, Eigen::VectorXd& v) {
  check_loops(c, s);
  auto& e = m.equations;
  e.at_positions(c, s, true);
  m.factor.factorize(c, s, e);
  m.before = e.times(v);
  m.find_positions(c, s, m.before);
  m.choose([](const contact_at&) { return true; });
  auto& r = memory.result;
  r.energy = 0, r.restitution = 1;
  memory.restitution.clear();
  bool approaches = false;
  for (std::size_t i = 0; i < m.touching.size(); ++i) {
    const auto& x = m.touched(i);
    approaches |= normal_velocity(m, x) < -1;
    memory.restitution.push_back(x.place.law.restitution);
  }
  for (std::size_t i = 0; i < m.touching.size(); ++i) {
    if (!approaches && slides(m, m.touched(i))) m.let_slide(i);
    m.put_rows(m.touched(i), m.touched(i).slip, m.bias);
  }
  m.make_matrix(c, s, m.before);
  for (std::size_t i = 0; i < m.touching.size(); ++i) {
    if (is_jammed(m, i)) m.laws[i].pressed = true, memory.restitution[i] = 0;
    m.laws[i].sliding.reset();
  }
  m.modes.clear();
  if (!m.touching.empty()) {
    const auto& found = memory.solver.solve({m.w, m.bias, m.laws}, memory.restitution, law);
    if (!found.solved()) [[unlikely]]
      raise<no_solution>("kte: no impulses satisfy the laws of impact at contacts " + names_of_touching(c, m) +
                         "; residual " + number(found.residual));
    for (Eigen::Index k = 0; k < m.forces.size(); ++k) m.forces[k] = found.impulse[static_cast<std::size_t>(k)];
    r.energy = found.energy, r.restitution = found.restitution_factor;
    for (const auto mode : found.modes) m.modes.push_back(as_contact_mode(mode));
  }
  m.accelerate(s, m.change_of_motion);
  v += m.change_of_motion;
}
#ifdef KTE_FUNCTION
KTE_FUNCTION const impact_result& impact_at_state(const runtime_chain& c, runtime_state& s, impact_law law) {
  auto& m = contact_memory(c, s);
  auto& memory = s.impacts.get<impact_memory>([] { return impact_memory{}; });
  auto& r = memory.result;
  r.v = read_numbers<vector_of::v>(s);
  strike(contacts_of(c), s, m, memory, law, r.v);
  r.names = m.result.names;
  r.impulses.assign(m.contacts.size(), {});
  for (std::size_t i = 0; i < m.touching.size(); ++i)
    r.impulses[static_cast<std::size_t>(m.touching[i])] = m.force_of(m.touched(i));
  write_numbers<vector_of::v>(s, r.v, "v");
  return r;
}
#endif

}  // namespace kte::detail
