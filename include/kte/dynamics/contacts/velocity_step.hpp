#pragma once

#include <kte/dynamics/contacts/contact_forces.hpp>

/// The step of velocities of time stepping with contacts, in the working memory of a state.
namespace kte::detail {

/// The velocities at the end of a step h, from v, with forces at the state, and impulses P of the contacts with gaps of
/// at most zero (Moreau 1999; Jean, Computer Methods in Applied Mechanics and Engineering 177, 1999):
///
///   v^+ = v + h a_0 + M^-1 J^T P,   u^+ = W P + J (v + h a_0)                                  (1)
///   u_n' = u_n^+ + e min(u_n, 0),   u_t' = u_t^+, a friction problem of lambda = P             (2)
///
/// a_0: the accelerations without contacts. Closures are satisfied by v^+. Contacts of the state get the forces P/h.
template <class Contacts, class State>
void step_velocities(const Contacts& c, State& s, contact_solver& m, double h, Eigen::VectorXd& v) {
  check_loops(c, s);
  auto& e = m.equations;
  const bool tree = s.tree().plan.tree;
  const auto none = [](int) { return 0.0; };
  accelerate_by_tree(c.elements(), s, none, {});
  m.before = s.work.forces;
  e.at_positions(c, s, true, tree);
  if (tree)
    m.factor.take_articulated(s, e);
  else
    m.factor.factorize(c, s, e), e.at_rates(c, s);
  m.find(c, s);  // with the velocities of the state, and of bases
  m.change_of_motion.resize(s.dofs());
  read_listed_numbers<vector_of::v>(s, m.change_of_motion);
  const Eigen::VectorXd to_start = e.times(v - m.change_of_motion);
  m.change_of_motion = v + h * m.before;
  const Eigen::VectorXd at_end = e.times(m.change_of_motion), by_forces = h * e.times(m.before);
  m.choose([](const contact_at& x) { return x.place.gap <= 0; });
  for (auto& x : m.contacts) x.slip = x.slip + m.unscaled(x, to_start);
  for (std::size_t i = 0; i < m.touching.size(); ++i) {
    const auto& x = m.touched(i);
    m.put_rows(x, x.slip + m.unscaled(x, by_forces), m.bias);
    m.bias[x.first] += x.place.law.restitution * (std::min)(dot(x.place.normal, x.slip), 0.0) / e.places.length;
  }
  m.make_matrix(c, s, at_end);
  (void)solve_friction(c, m, true);
  v += h * m.before;
  m.accelerate(s, m.change_of_motion);
  v += m.change_of_motion;
  put_contacts(m, s);
  for (const auto& x : m.contacts) {
    auto& force = s.template get<kind::contact>(x.slot).force;
    force = (1 / h) * force;
  }
}

}  // namespace kte::detail
