#pragma once

#include <kte/dynamics/contacts/contact_forces.hpp>

/// Gates of contacts (elements/gated_contact.hpp) in simulations.
namespace kte::detail {

/// Whether the gate of element e, a contact, is open at the time t and the state x of a model.
template <class Model, class X>
bool admits_contact(const Model& m, double t, const X& x, int e) {
  auto s = make_state(m.chain());
  m.setJointStates(t, x, s);
  m.doMotion(s);
  return m.wiring().elements[static_cast<std::size_t>(e)].element->admits(t, s);
}

/// Whether a contact comes down from a height above the touching gap, after `accelerate_freely`; slower ones count as
/// closed until now.
inline bool comes_from_clear(const contact_solver& m, const contact_at& x) {
  const double speed = -dot(x.place.normal, x.slip), gap_ddot = free_gap_ddot(m, x);
  return normal_velocity(m, x) < -1 &&
         (gap_ddot >= 0 || speed * speed > -2 * gap_ddot * touching_gap * m.equations.places.length);
}
/// Asks the gates of open contacts that land, or that are deeper than `deepest_start` at the start, and notes in x
/// which contacts pass through their surface. Returns which of them begin to, by number.
template <class Access, class X>
std::vector<char> ask_gates(const Access& a, double t, X& x) {
  std::vector<char> begins(static_cast<std::size_t>(a.contacts()));
  struct question {
    std::size_t contact;
    int element;
    Eigen::Index mode;
  };
  std::vector<question> all;
  const Eigen::Index modes = x.size() - numbers_of_contact * a.contacts();
  a.at(t, x, [&](const auto& c, auto& s, contact_solver& m) {
    bool any = false;
    for (const auto& y : m.contacts)
      any |= y.has_gate && mode_of(s.template get<kind::contact>(y.slot)) == contact_mode::open;
    if (!any) return;
    accelerate_freely(c, s, m, tree::given_forces<double>{});
    const double length = m.equations.places.length;
    for (std::size_t i = 0; i < m.contacts.size(); ++i) {
      const auto& y = m.contacts[i];
      if (!y.has_gate || mode_of(s.template get<kind::contact>(y.slot)) != contact_mode::open) continue;
      const Eigen::Index mode = modes + numbers_of_contact * y.slot;
      if (y.place.gap > touching_gap * length)
        x[mode] = 0;
      else if (y.place.gap < -deepest_start * length ? !y.passes : comes_from_clear(m, y))
        all.push_back({i, m.place(y).element, mode});
    }
  });
  std::vector<char> open;
  for (const auto& y : all) open.push_back(a.admits(t, x, y.element));
  for (std::size_t k = 0; k < all.size(); ++k) {
    double& mode = x[all[k].mode];
    begins[all[k].contact] = !open[k] && mode != passing_mode;
    mode = open[k] ? 0 : passing_mode;
  }
  return begins;
}

/// Gates in time stepping, whose closed contacts may open for some steps, by a gap of the order h^2. A contact is clear
/// of its surface after `steps_until_clear` steps in a row without touching.
class stepped_gates {
 public:
  static constexpr int steps_until_clear = 10;

  /// A function that finds which contacts pass through their surface, at the state x of a model.
  template <class Model, class X>
  auto at(const Model& model, double t, const X& x) {
    return [this, &model, t, &x](contact_workspace& m) {
      open_.resize(m.contacts.size());
      for (std::size_t i = 0; i < open_.size(); ++i) {
        auto& y = m.contacts[i];
        if (!y.has_gate) continue;
        int& steps = open_[i];
        if (y.place.gap > touching_gap * m.equations.places.length) {
          steps = y.passes ? steps_until_clear : (std::min)(steps + 1, steps_until_clear);
          y.passes = false;
        } else if (!y.passes) {
          y.passes = steps == steps_until_clear && !admits_contact(model, t, x, m.place(y).element);
          steps = 0;
        }
      }
    };
  }

 private:
  std::vector<int> open_;  ///< steps without touching, by contact
};

}  // namespace kte::detail
