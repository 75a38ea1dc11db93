#pragma once

#include <kte/dynamics/contacts/contact_forces.hpp>

/// Gates of contacts (elements/gated_contact.hpp) in time stepping.
namespace kte::detail {

/// Whether the gate of element e, a contact, is open at the time t and the state x of a model.
template <class Model, class X>
bool admits_contact(const Model& m, double t, const X& x, int e) {
  auto s = make_state(m.chain());
  m.setJointStates(t, x, s);
  m.doMotion(s);
  return m.wiring().elements[static_cast<std::size_t>(e)].element->admits(t, s);
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
