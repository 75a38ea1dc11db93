#pragma once

#include <kte/elements/spring.hpp>

namespace kte {

namespace core {

/// Drag of a fluid on a frame, at its origin, in a flow of velocity w in axes of the world:
///
///   u = v - R^T w                                       (1)
///   F = -(c_2 |u| + c_1) u                              (2)
///
/// in axes of the frame; there is no torque. Aerodynamic drag has c_2 = rho C A/2, Stokes drag of a sphere c_1 = 6 pi
/// mu r.
template <kind Dim, class Quadratic, class Linear, class Flow>
struct fluid_drag {
  static constexpr type_name type{"fluid_drag", Dim};
  static constexpr std::array<port, 1> ports{{{Dim, access::on, "frame"}}};
  static constexpr bool reads_positions = true;

  Quadratic quadratic;
  Linear linear;
  Flow flow;

  template <class Frame>
  KTE_INLINE constexpr auto doForce(const Frame& x) const {
    const auto u = x.velocity - transpose(x.rotation) * flow;  // (1)
    const auto c = quadratic * detail::to_polar(u).length + linear;
    return make_loads(wrench{-(c * u), zero3{}});  // (2)
  }
  constexpr void check(const parameter_check& where) const {
    where.not_negative(quadratic, "quadratic drag must be finite and not negative");
    where.not_negative(linear, "linear drag must be finite and not negative");
    where.finite(flow, "flow must be finite");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("quadratic", self.quadratic), visit("linear", self.linear), visit("flow", self.flow);
  }
};

}  // namespace core

/// Drag on a frame in the plane: quadratic coefficient rho C A/2, N s^2/m^2, and optionally the linear coefficient, N
/// s/m, and the velocity of the flow in axes of the world, m/s.
template <class F, entry Quadratic, entry Linear = zero_t, geometric Flow = zero3>
[[nodiscard]] constexpr auto fluid_drag_2D(const F& frame, const Quadratic& quadratic, const Linear& linear = {},
                                           const Flow& flow = {}) {
  const auto w = detail::planar(flow);
  using core_type = core::fluid_drag<kind::frame_2D, decltype(real(quadratic)), decltype(real(linear)),
                                     std::remove_const_t<decltype(w)>>;
  return connect(core_type{real(quadratic), real(linear), w}, frame);
}
/// Drag on a frame in space: quadratic coefficient rho C A/2, N s^2/m^2, and optionally the linear coefficient, N s/m,
/// and the velocity of the flow in axes of the world, m/s.
template <class F, entry Quadratic, entry Linear = zero_t, class X = zero_t, class Y = X, class Z = Y>
[[nodiscard]] constexpr auto fluid_drag_3D(const F& frame, const Quadratic& quadratic, const Linear& linear = {},
                                           const vec3<X, Y, Z>& flow = {}) {
  using core_type = core::fluid_drag<kind::frame_3D, decltype(real(quadratic)), decltype(real(linear)), vec3<X, Y, Z>>;
  return connect(core_type{real(quadratic), real(linear), flow}, frame);
}

KTE_CALL(fluid_drag_2D, "(frame, quadratic[, linear[, flow]]); a flow is a vector, such as kte::along_x(3.0)")
KTE_CALL(fluid_drag_3D, "(frame, quadratic[, linear[, flow]]); a flow is a vector, such as kte::along_x(3.0)")

}  // namespace kte
