#pragma once

#include <kte/contract/element.hpp>

namespace kte {

namespace core {

/// A rigid contact that lands only where a function of the state, its gate, is true:
///
///   point_contact_2D(swing_foot, ground, tip, half_space{}, law).only_if([](const auto& s) {
///     return s[tip].position.x > s[hip].position.x;
///   })
///
/// The gate is asked where the contact comes down on its surface, and only if it was clear of the surface since it last
/// closed; closed contacts stay closed. If the gate is false, the contact passes through the surface, and is open until
/// it is clear of it. Simulations ask gates, with events and by `moreau_jean`; `contact_dynamics` and `impact` do not.
/// s is a state after doMotion: of a static chain, s[tip], or of a runtime chain, s.frame_2D("tip"). A chain with it
/// cannot be saved.
template <class Contact, class Gate>
struct gated_contact : Contact {
  static constexpr bool holds_code = true, has_gate = true;

  Gate gate;

  template <class State>
  constexpr bool admits(const State& s) const {
    return static_cast<bool>(gate(s));
  }
};

}  // namespace core

namespace detail {
template <class Contact>
struct gate_on_contact {
  template <class F>
  static constexpr core::gated_contact<Contact, F> on(const Contact& contact, const F& f) {
    return {contact, f};
  }
};
}  // namespace detail

}  // namespace kte
