#pragma once

#include <kte/contact/impact.hpp>
#include <kte/dynamics/contacts/contact_forces.hpp>

/// Velocities after impacts, in the working memory of a state.
namespace kte::detail {

/// The memory of impacts.
struct impact_memory {
  impact_solver<double> solver;
  std::vector<double> restitution;
  impact_result result;
};
/// Whether a contact that slides at rest in its normal direction is jammed: W_nn - mu W_nt <= `least_support` W_nn, t
/// along the velocity.
inline bool is_jammed(const contact_solver& m, std::size_t i) {
  const auto& x = m.touched(i);
  const double alone = m.w(x.first, x.first);
  return m.laws[i].sliding && !((1 - least_support) * alone > m.laws[i].friction * m.w(x.first, x.first + 1));
}
/// Whether the forces found grow without limit as the sliding of a contact jams.
bool is_near_jam(const contact_solver& m);
/// Replaces v, the velocities of the state, by those after the impact. restitution(x): Newton's e of a contact.
template <class Restitution>
void strike(const chain_constraints& c, runtime_state& s, contact_solver& m, impact_memory& memory, impact_law law,
            Eigen::VectorXd& v, const Restitution& restitution) {
  check_loops(c, s);
  auto& e = m.equations;
  e.at_positions(c, s, true);
  m.factor.factorize(c, s, e);
  e.at_rates(c, s);
  m.find(c, s);
  m.before = e.times(v);
  m.choose([&m](const contact_at& x) { return m.touches(x); });
  auto& r = memory.result;
  r.energy = 0, r.restitution = 1;
  memory.restitution.clear();
  bool approaches = false;
  for (std::size_t i = 0; i < m.touching.size(); ++i) {
    const auto& x = m.touched(i);
    approaches |= normal_velocity(m, x) < -1;
    memory.restitution.push_back(restitution(x));
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
  if (!m.touching.empty()) {
    const auto& found = memory.solver.solve({m.w, m.bias, m.laws}, memory.restitution, law);
    if (!is_taken(found.status, found.residual)) [[unlikely]]
      raise<no_solution>("kte: no impulses satisfy the laws of impact at contacts " + names_of_touching(c, m) +
                         "; residual " + number(found.residual));
    for (Eigen::Index k = 0; k < m.forces.size(); ++k) m.forces[k] = found.impulse[static_cast<std::size_t>(k)];
    r.energy = found.energy, r.restitution = found.restitution_factor;
    put_modes(m, found.modes, found.impulse, found.u);
  }
  r.energy -= m.energy_of_closures();
  m.accelerate(s, m.change_of_motion);
  v += m.change_of_motion;
}
inline void strike(const chain_constraints& c, runtime_state& s, contact_solver& m, impact_memory& memory,
                   impact_law law, Eigen::VectorXd& v) {
  strike(c, s, m, memory, law, v, [](const contact_at& x) { return x.place.law.restitution; });
}

#ifdef KTE_FUNCTION
KTE_FUNCTION bool is_near_jam(const contact_solver& m) {
  double load = 0, force = 0;
  bool jammed = false;
  for (std::size_t i = 0; i < m.touching.size(); ++i) {
    const auto n = m.touched(i).first;
    load = (std::max)(load, std::abs(m.bias[n]) / m.w(n, n)), force = (std::max)(force, m.forces[n]);
    jammed |= is_jammed(m, i);
  }
  return jammed && force > 0.1 / least_support * load;
}
#endif

}  // namespace kte::detail
