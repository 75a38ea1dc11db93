#pragma once

#include <kte/contract/transmission.hpp>

namespace kte {

namespace core {

/// A motor on a coordinate: f += u, with u an input of the chain, N or Nm.
struct driving_actuator_gen {
  static constexpr type_name type{"driving_actuator", kind::gen};
  static constexpr std::array<port, 2> ports{
      {{kind::gen, access::on, "coordinate"}, {kind::input, access::in, "input"}}};

  template <class C, class U>
  KTE_INLINE constexpr auto doForce(const C&, const U& u) const {
    return make_loads(u);
  }
  constexpr void check(const parameter_check&) const {}
  template <class Self, class Visit>
  static constexpr void parameters(Self&, Visit&&) {}
};

}  // namespace core

/// A motor that drives a coordinate by the force `input`, set in the state: `s[motor] = 2.0`.
template <class Q, class U>
constexpr auto driving_actuator_gen(const Q& coordinate, const U& input) {
  return connect(core::driving_actuator_gen{}, coordinate, input);
}

KTE_CALL(driving_actuator_gen, "(coordinate, input)")

namespace detail {
/// How model files make them.
struct driving_actuator_family {
  template <class Add>
  static void add_to(const Add& add) {
    add("driving_actuator_gen",
        [](const auto& x) { return driving_actuator_gen(x.name("coordinate"), x.name("input")); });
  }
};
}  // namespace detail

}  // namespace kte
