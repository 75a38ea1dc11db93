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
template <class Access, class X>
void accelerate_in_step(const Access& a, const chain_constraints& c, runtime_state& s, contact_solver& m, const X& x) {
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
/// A step begins at x0.
template <class Access, class X>
void begin_step_with_contacts(const Access& a, const X& x0) {
  if (is_stepped(a, x0)) return;
  auto& step = contact_step_from(a, x0);
  if (!step.starts_wrong) [[likely]]
    return;
  step.x0.resize(0), step.wrong.resize(0);  // another integration may begin here, with events
  a.at(step.start_time, x0, [&](const auto& c, auto& s, contact_solver& m) {
    accelerate_in_modes(c, s, m, step.forces);
    refuse_wrong_modes(c, s, m, step.forces);
  });
}

}  // namespace kte::detail
