#pragma once

#include <kte/models/detail/contact_margins.hpp>

/// Steps in modes that violate the laws of contact: events may mend them at the start of a step, otherwise they are
/// refused.
namespace kte::detail {

/// Throws `bad_argument` for modes whose forces violate the laws, after `accelerate_in_modes`.
inline void refuse_wrong_modes(const chain_constraints& c, runtime_state& s, contact_solver& m,
                               forces_in_modes& forces) {
  const int wrong = admit_forces(c, s, m, forces, 1e-6);
  if (wrong < 0) return;
  const auto& x = m.touched(static_cast<std::size_t>(wrong));
  const double normal = reserves(m, static_cast<std::size_t>(wrong))[0];
  raise<bad_argument>("kte: " + name_of(c, m, x) +
                      (normal < 0 ? " is closed, but pulls with " + number(-normal) + " N"
                                  : std::string(" sticks, but its force exceeds friction")) +
                      ": integrate with kte::element_events(model), which changes modes");
}
/// The accelerations of a model at x, for stages of steps, written to `forces` of the working memory. Wrong modes
/// at the start of a step are noted, because events may mend them, and refused at the next one.
inline void accelerate_in_step(const runtime_model_contacts& a, const chain_constraints& c, runtime_state& s,
                               contact_solver& m, const Eigen::VectorXd& x) {
  auto& step = a.memory();
  step.margin_x.resize(0);
  accelerate_in_modes(c, s, m, step.forces);
  put_forces_of_closures(m, s);
  if (first_wrong_mode(m, 1e-6 * largest_force(m, step.forces)) < 0) [[likely]]
    return;
  step.wrong = x;
  if (step.x0.size() != x.size() || step.x0 != x) return;
  if (step.begun > 1) refuse_wrong_modes(c, s, m, step.forces);
  step.starts_wrong = true;
}
/// The accelerations of a model with contacts at t and x, also in the state.
inline const Eigen::VectorXd& accelerate_with_contacts_in_step(const runtime_model_contacts& a, double t,
                                                               const Eigen::VectorXd& x) {
  a.at(t, x, [&](const chain_constraints& c, runtime_state& s, contact_solver& m) {
    accelerate_in_step(a, c, s, m, x);
    check_result(s, diagnose_state{"an acceleration", s});
    write_numbers<vector_of::a>(s, s.work.forces, "a");
  });
  return a.s.work.forces;
}
/// A step begins at x0.
inline void begin_step_with_contacts(const runtime_model_contacts& a, const Eigen::VectorXd& x0) {
  if (is_stepped(a, x0)) return;
  auto& step = contact_step_from(a, x0);
  if (!step.starts_wrong) [[likely]]
    return;
  step.x0.resize(0), step.wrong.resize(0);  // another integration may begin here, with events
  a.at(step.start_time, x0, [&](const chain_constraints& c, runtime_state& s, contact_solver& m) {
    accelerate_in_modes(c, s, m, step.forces);
    refuse_wrong_modes(c, s, m, step.forces);
  });
}

}  // namespace kte::detail
