#pragma once

#include <kte/dynamics/contacts/contact_forces.hpp>

/// The step of velocities of time stepping with contacts, in the working memory of a state.
namespace kte::detail {

/// The velocities at the end of a step h, from q and v of the state, with impulses P of the contacts with gaps of at
/// most zero (Moreau 1999; Jean, Computer Methods in Applied Mechanics and Engineering 177, 1999):
///
///   v^+ = v + h a_0 + M^-1 J^T P,   u^+ = W P + J (v + h a_0)                                  (1)
///   u_n' = u_n^+ + e min(u_n, 0),   u_t' = u_t^+, a friction problem of lambda = P             (2)
///
/// a_0: the accelerations without contacts. Closures are satisfied by v^+. Contacts of the state get the forces P/h.
template <class Contacts, class State>
const Eigen::VectorXd& step_velocities(const Contacts& c, State& s, contact_solver& m, double h, Eigen::VectorXd& v) {
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
    m.factor.factorize(c, s, e);
  m.find_positions(c, s, e.times(v));
  m.change_of_motion = v + h * m.before;
  const Eigen::VectorXd at_end = e.times(m.change_of_motion);
  m.choose([](const contact_at& x) { return x.place.gap <= 0; });
  for (std::size_t i = 0; i < m.touching.size(); ++i) {
    const auto& x = m.touched(i);
    m.put_rows(x, m.unscaled(x, at_end), m.bias);
    m.bias[x.first] += x.place.law.restitution * (std::min)(dot(x.place.normal, x.slip), 0.0) / e.places.length;
  }
  m.make_matrix(c, s, at_end);
  (void)solve_friction(c, m);
  v += h * m.before;
  m.accelerate(s, m.change_of_motion);
  v += m.change_of_motion;
  put_contacts(m, s);
  for (const auto& x : m.contacts) {
    auto& force = s.template get<kind::contact>(x.slot).force;
    force = (1 / h) * force;
  }
  return v;
}

}  // namespace kte::detail
