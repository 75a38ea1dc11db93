#pragma once

#include <kte/dynamics/contacts/contact_rows.hpp>
#include <kte/errors.hpp>

namespace kte::detail {

/// Throws `bad_argument` that names the contact whose body is the deepest in its surface, if it is deeper than `depth`,
/// relative to the length of the chain, at the positions of the state. Contacts that deep with a closed gate, admits(e)
/// of the element e, pass through their surface.
template <class Admits>
void check_starting_depth(const chain_constraints& c, runtime_state& s, contact_workspace& m, double depth,
                          const Admits& admits) {
  if (!(depth >= 0)) raise<bad_argument>("kte: the depth of a start must not be negative, got " + number(depth));
  place_bodies(c.elements(), s);
  m.equations.at_positions(c, s, false, true);
  const contact_at* deepest = nullptr;
  double gap = -depth * m.equations.places.length;
  for (auto& x : m.contacts) {
    const auto& at = m.place(x);
    m.locate(c, x, loop_equations::motion_between(s, at));
    x.passes = x.has_gate && x.place.gap < -depth * m.equations.places.length && !admits(at.element);
    if (!x.passes && x.place.gap < gap) gap = x.place.gap, deepest = &x;
  }
  if (deepest != nullptr) [[unlikely]]
    raise<bad_argument>("kte: contact '" + c.loop_name(m.place(*deepest).loop) + "' starts " + number(-gap) +
                        " m inside its surface");
}

}  // namespace kte::detail
