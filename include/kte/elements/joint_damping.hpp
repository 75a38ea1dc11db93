#pragma once

#include <kte/elements/damper.hpp>

namespace kte {

namespace core {

/// Viscous damping c of a coordinate:
///
///   f -= c q_dot          (1)
template <class Damping>
struct joint_damping_gen : damper_parameters<Damping> {
  static constexpr type_name type{"joint_damping", kind::gen};
  static constexpr std::array<port, 1> ports{{{kind::gen, access::on, "coordinate"}}};

  template <class C>
  KTE_INLINE constexpr auto doForce(const C& c) const {
    return make_loads(-(this->damping * c.q_dot));  // (1)
  }
};

}  // namespace core

/// Viscous damping of a coordinate, such as the friction of a bearing, N s/m or Nm s/rad. `damper_gen` acts between two
/// coordinates.
template <class Q, entry Damping>
[[nodiscard]] constexpr auto joint_damping_gen(const Q& coordinate, const Damping& damping) {
  return connect(core::joint_damping_gen<decltype(real(damping))>{{real(damping)}}, coordinate);
}

KTE_CALL(joint_damping_gen, "(coordinate, damping)")

}  // namespace kte
