#pragma once

#include <kte/models/detail/contact_events.hpp>
#include <kte/models/moreau_jean.hpp>

/// Bridges: where events find no modes of contacts, or steps pile up, a few velocity steps of `moreau_jean` carry the
/// state over that time. The velocity problem always has a solution, also where accelerations have none (Stewart, SIAM
/// Journal on Mathematical Analysis 145, 1998). Their order is 1.
namespace kte::detail {

/// The time scale of a chain of this length that falls, s.
inline double time_of_fall(double length) { return std::sqrt(length / 9.81); }

/// Moves x by 20 velocity steps h, up to t_end, and finds modes there. Returns the time of x.
///
///   h = 1e-5 2^min(n, 8) sqrt(L/g),   n: bridges before, if they follow each other                (1)
/// Contacts that are inside their surface then are put on it. Throws `bad_argument` if a contact passes through its
/// surface.
template <class Access, class X>
double bridge_contacts(const Access& a, double t, X& x, double t_end, int n) {
  const auto& model = a.model;
  model.each_contact([&x](int, int first) {
    if (x[first] == passing_mode) raise<bad_argument>("kte: a contact passes through its surface");
  });
  const double length = a.memory().at.equations.places.length;
  const double h = 1e-5 * std::ldexp(1.0, (std::min)(n, 8)) * time_of_fall(length);
  moreau_jean solver(std::cref(model), t, x, h, {.depth = 1e-3});
  solver.integrate((std::min)(t_end, t + 20 * h));
  x = solver.state();
  model.each_contact([&x](int, int first) { x[first] = 0; });
  a.memory().x0.resize(0), a.memory().margin_x.resize(0), a.memory().wrong.resize(0);
  close_gaps(a, solver.time(), x);
  resolve_contacts(a, solver.time(), x, -1);
  return solver.time();
}

}  // namespace kte::detail
