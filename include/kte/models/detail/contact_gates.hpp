#pragma once

#include <kte/models/detail/runtime_model_contacts.hpp>
#include <kte/models/detail/stepped_gates.hpp>

/// Gates of contacts (elements/gated_contact.hpp) at events.
namespace kte::detail {

/// Whether a contact comes down from a height above the touching gap, after `accelerate_freely`; slower ones count as
/// closed until now.
inline bool comes_from_clear(const contact_solver& m, const contact_at& x) {
  const double speed = -dot(x.place.normal, x.slip), gap_ddot = free_gap_ddot(m, x);
  return normal_velocity(m, x) < -1 &&
         (gap_ddot >= 0 || speed * speed > -2 * gap_ddot * touching_gap * m.equations.places.length);
}
/// Asks the gates of open contacts that land, or that are deeper than `deepest_start` at the start, and notes in x
/// which contacts pass through their surface. Returns which of them begin to, by number.
inline std::vector<char> ask_gates(const runtime_model_contacts& a, double t, Eigen::VectorXd& x) {
  std::vector<char> begins(static_cast<std::size_t>(a.contacts()));
  struct question {
    std::size_t contact;
    int element;
    Eigen::Index mode;
  };
  std::vector<question> all;
  const Eigen::Index modes = x.size() - numbers_of_contact * a.contacts();
  a.at(t, x, [&](const chain_constraints& c, runtime_state& s, contact_solver& m) {
    bool any = false;
    for (const auto& y : m.contacts) any |= y.has_gate && mode_of(s.get<kind::contact>(y.slot)) == contact_mode::open;
    if (!any) return;
    accelerate_freely(c, s, m, tree::given_forces<double>{});
    const double length = m.equations.places.length;
    for (std::size_t i = 0; i < m.contacts.size(); ++i) {
      const auto& y = m.contacts[i];
      if (!y.has_gate || mode_of(s.get<kind::contact>(y.slot)) != contact_mode::open) continue;
      const Eigen::Index mode = modes + numbers_of_contact * y.slot;
      if (y.place.gap > touching_gap * length)
        x[mode] = 0;
      else if (y.place.gap < -deepest_start * length ? !y.passes : comes_from_clear(m, y))
        all.push_back({i, m.place(y).element, mode});
    }
  });
  std::vector<char> open;
  for (const auto& y : all) open.push_back(admits_contact(a.model, t, x, y.element));
  for (std::size_t k = 0; k < all.size(); ++k) {
    double& mode = x[all[k].mode];
    begins[all[k].contact] = !open[k] && mode != passing_mode;
    mode = open[k] ? 0 : passing_mode;
  }
  return begins;
}

}  // namespace kte::detail
