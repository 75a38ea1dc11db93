#pragma once

#include <kte/models/detail/contact_steps.hpp>

/// The functions of rigid contacts that pass through zero where they change their mode.
namespace kte::detail {

/// Forces that satisfy the laws and give the accelerations of the modes, if those of least norm do not, and there are
/// such: contacts are redundant. Returns whether there are.
inline bool find_admissible_forces(const chain_constraints& c, runtime_state& s, contact_solver& m) {
  const Eigen::VectorXd a = m.change_of_motion, forces = m.forces, bias = m.bias;
  const auto modes = m.modes;
  m.make_matrix(c, s, m.equations.acceleration);
  const auto status = find_friction(m);
  bool same = false;
  if (has_forces(status)) {
    m.accelerate(s, m.change_of_motion);
    same = (m.change_of_motion - a).norm() <= 1e-8 * a.norm();
  }
  m.modes = modes, m.change_of_motion = a;
  if (!same) m.forces = forces;
  m.bias = bias;
  return same;
}
/// The normal force of contact i of those that touch, and its reserve of friction, mu lambda_n - |lambda_t|, N.
inline std::array<double, 2> reserves(const contact_solver& m, std::size_t i) {
  const auto& x = m.touched(i);
  const vec3<> force = m.force_of(x);
  const double normal = dot(force, x.place.normal);
  const vec3<> t = force - normal * x.place.normal;
  return {normal, x.place.law.friction * normal - std::sqrt(dot(t, t))};
}
/// Within the accuracy of the solution, forces at their limits are beyond them: relative to the largest force.
inline constexpr double least_reserve = 1e-9;
/// In space, sliding begins where the force of a contact that sticks is this much above its limit, relative to it, so
/// that a contact that only stays at its limit, as where a body rolls, sticks.
inline constexpr double excess_at_onset = 1e-9;
/// The functions of contact i of those that touch.
inline contact_margin margins_of_closed(const contact_solver& m, const forces_in_modes& k, std::size_t i,
                                        const vec3<>& start, double tiny) {
  const auto& x = m.touched(i);
  const auto [normal, reserve] = reserves(m, i);
  if (m.modes[i] == contact_mode::sticks) {
    const double excess = x.planar ? 0 : excess_at_onset * x.place.law.friction * std::abs(normal);
    return {normal + tiny, reserve + (std::max)(tiny, excess), 1, 0};
  }
  if (x.place.law.friction == 0) return {normal + tiny, 1, 1, 0};
  const vec3<> t = contact_workspace::tangential(x);
  const double along = dot(t, start);
  if (x.planar) return {normal + tiny, along, 1, 0};
  const double v = k.slow_speed * m.equations.places.length, share = (std::max)(1 - std::sqrt(dot(t, t)) / v, 0.0);
  const double turn = along + v * share * share + rest_velocity * m.equations.places.length;
  return {normal + tiny, k.speeds[i], turn, k.look_aheads[i]};
}
/// The largest force of contacts that touch, N.
inline double largest_force(const contact_solver& m) {
  return m.forces.size() > 0 ? m.forces.cwiseAbs().maxCoeff() / m.equations.places.length : 0;
}
/// The largest force of contacts that touch, and of those that would hold against the other forces, N.
inline double largest_force(const contact_solver& m, const forces_in_modes& forces) {
  double most = 0;
  for (std::size_t i = 0; i < m.touching.size(); ++i) {
    const auto& x = m.touched(i);
    const auto b = forces.rows.all.col(forces.rows.of_closures + x.first);
    most = (std::max)({most, std::abs(m.forces[x.first]), std::abs(m.bias[x.first]) / b.squaredNorm()});
  }
  return most / m.equations.places.length;
}
/// The first contact, of those that touch, whose force violates the laws by more than `tolerated`, N; -1: none.
inline int first_wrong_mode(const contact_solver& m, double tolerated) {
  for (std::size_t i = 0; i < m.touching.size(); ++i) {
    const auto [normal, reserve] = reserves(m, i);
    if (normal < -tolerated || (m.modes[i] == contact_mode::sticks && reserve < -tolerated)) return static_cast<int>(i);
  }
  return -1;
}
/// Replaces forces that do not satisfy the laws by such that do, if there are. Returns the first contact, of those that
/// touch, that violates them by more than `tolerated`, relative to the largest force; -1: none.
inline int admit_forces(const chain_constraints& c, runtime_state& s, contact_solver& m, forces_in_modes& forces,
                        double tolerated) {
  const double most = tolerated * largest_force(m, forces);
  if (const int wrong = first_wrong_mode(m, most); wrong < 0 || !forces.redundant() || !find_admissible_forces(c, s, m))
    return wrong;
  put_contacts(m, s);
  return -1;
}
/// The functions of all contacts at the time t and the state x, by number.
inline const std::vector<contact_margin>& contact_margins(const runtime_model_contacts& a, double t,
                                                          const Eigen::VectorXd& x) {
  auto& step = a.memory();
  if (step.margin_x.size() == x.size() && step.margin_x == x && step.margin_time == t) return step.margins;
  step.margin_x.resize(0);
  if (is_stepped(a, x)) {
    step.margins.assign(static_cast<std::size_t>(a.contacts()), {});
    return step.margins;
  }
  a.at(t, x, [&](const chain_constraints& c, runtime_state& s, contact_solver& m) {
    step.margins.assign(m.contacts.size(), {});
    step.zero_gaps.resize(m.contacts.size());
    bool closed = false;
    for (const auto& y : m.contacts) closed |= mode_of(s.get<kind::contact>(y.slot)) != contact_mode::open;
    std::vector<vec3<>> starts;
    for (const auto& y : m.contacts) starts.push_back(s.get<kind::contact>(y.slot).direction);
    if (!closed) {
      m.equations.at_positions(c, s, false);
      m.find(c, s);
      m.touching.clear();
    } else {
      accelerate_in_modes(c, s, m, step.forces);
    }
    for (std::size_t k = 0; k < m.contacts.size(); ++k)
      step.margins[k].touch = m.contacts[k].place.gap - step.zero_gaps[k];
    if (!closed) return;
    const bool admitted = admit_forces(c, s, m, step.forces, 1e-13) < 0;
    step.largest_force = (std::max)(step.largest_force, largest_force(m, step.forces));
    const double tiny = 1e-13 * step.largest_force, least = least_reserve * step.largest_force;
    for (std::size_t i = 0; i < m.touching.size(); ++i) {
      const auto k = static_cast<std::size_t>(m.touching[i]);
      auto& own = step.margins[k] = margins_of_closed(m, step.forces, i, starts[k], tiny);
      if (!admitted || !step.forces.redundant()) continue;
      const bool sticks = m.modes[i] == contact_mode::sticks;
      own.is_least = own.touch < least || (sticks && own.friction < least);
      own.touch = (std::max)(own.touch, least);
      if (sticks) own.friction = (std::max)(own.friction, least);
    }
    if (step.forces.jammed >= 0) {
      auto& own = step.margins[static_cast<std::size_t>(m.touching[static_cast<std::size_t>(step.forces.jammed)])];
      own.touch = -std::abs(own.touch) - tiny;
    }
  });
  step.margin_x = x, step.margin_time = t;
  return step.margins;
}

}  // namespace kte::detail
