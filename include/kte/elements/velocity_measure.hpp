#pragma once

#include <kte/contract/no_parameters.hpp>
#include <kte/contract/transmission.hpp>

namespace kte {

namespace core {

/// Measures the rate of a coordinate: y = q', m/s or rad/s.
struct velocity_measure_gen : no_parameters {
  static constexpr type_name type{"velocity_measure", kind::gen};
  static constexpr std::array<port, 2> ports{
      {{kind::gen, access::on, "coordinate"}, {kind::input, access::out, "output"}}};

  template <class C>
  KTE_INLINE constexpr auto doMotion(const C& c) const {
    return c.q_dot;
  }
};
/// Measures the velocity of the origin of a frame: y = R v, the derivative of its `position_measure`, m/s, in axes of
/// the world.
template <kind Dim>
struct velocity_measure : no_parameters {
  static constexpr type_name type{"velocity_measure", Dim};
  static constexpr std::array<port, 2> ports{{{Dim, access::on, "frame"}, {kind::vector, access::out, "output"}}};

  template <class Frame>
  KTE_INLINE constexpr auto doMotion(const Frame& x) const {
    return x.rotation * x.velocity;
  }
};

}  // namespace core

/// Measures the rate of a coordinate, m/s or rad/s.
template <class Q, class Y>
[[nodiscard]] constexpr auto velocity_measure_gen(const Q& coordinate, const Y& output) {
  return connect(core::velocity_measure_gen{}, coordinate, output);
}
/// Measures the linear velocity of a frame in the plane, m/s, in axes of the world.
template <class F, class Y>
[[nodiscard]] constexpr auto velocity_measure_2D(const F& frame, const Y& output) {
  return connect(core::velocity_measure<kind::frame_2D>{}, frame, output);
}
/// Measures the linear velocity of a frame in space, m/s, in axes of the world.
template <class F, class Y>
[[nodiscard]] constexpr auto velocity_measure_3D(const F& frame, const Y& output) {
  return connect(core::velocity_measure<kind::frame_3D>{}, frame, output);
}

KTE_CALL(velocity_measure_gen, "(coordinate, output)")
KTE_CALL(velocity_measure_2D, "(frame, output)")
KTE_CALL(velocity_measure_3D, "(frame, output)")

}  // namespace kte
