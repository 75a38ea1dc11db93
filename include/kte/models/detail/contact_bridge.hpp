#pragma once

#include <kte/models/detail/contact_events.hpp>
#include <kte/models/moreau_jean.hpp>

#ifdef KTE_FUNCTION
/// Bridges: where events find no modes of contacts, or steps pile up, a few velocity steps of `moreau_jean` carry the
/// state over that time. The velocity problem always has a solution, also where accelerations have none (Stewart, SIAM
/// Journal on Mathematical Analysis 145, 1998). Their order is 1.
namespace kte {

namespace detail {
/// The time scale of a chain of this length that falls, s.
inline double time_of_fall(double length) { return std::sqrt(length / 9.81); }
}  // namespace detail

/// Moves x by 20 velocity steps h, up to t_end, and finds modes there. Returns the time of x.
///
///   h = 1e-5 2^min(n, 8) sqrt(L/g),   n: bridges before, if they follow each other                (1)
/// Contacts that are inside their surface then are put on it. Throws `bad_argument` if a contact passes through its
/// surface.
KTE_FUNCTION double manipulator_dynamics_model<runtime_chain>::bridge_contacts(double t, state& x, double t_end,
                                                                               int n) const {
  each_contact([&x](int, int first) {
    if (x[first] == detail::passing_mode) detail::raise<bad_argument>("kte: a contact passes through its surface");
  });
  const auto contacts = contacts_of_model();
  auto& step = contacts.memory();
  const double h = 1e-5 * std::ldexp(1.0, (std::min)(n, 8)) * detail::time_of_fall(contact_length());  // (1)
  moreau_jean solver(std::cref(*this), t, x, h, {.depth = 1e-3});
  solver.integrate((std::min)(t_end, t + 20 * h));
  x = solver.state();
  each_contact([&x](int, int first) { x[first] = 0; });
  step.x0.resize(0), step.margin_x.resize(0), step.wrong.resize(0);
  detail::close_gaps(contacts, solver.time(), x);
  detail::resolve_contacts(contacts, solver.time(), x, -1);
  return solver.time();
}

}  // namespace kte
#endif
