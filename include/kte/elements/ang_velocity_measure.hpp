#pragma once

#include <kte/contract/no_parameters.hpp>
#include <kte/contract/transmission.hpp>

namespace kte {

namespace core {

/// Measures the angular velocity of a frame in the plane: y = w, rad/s.
struct ang_velocity_measure_2D : no_parameters {
  static constexpr type_name type{"ang_velocity_measure", kind::frame_2D};
  static constexpr std::array<port, 2> ports{
      {{kind::frame_2D, access::on, "frame"}, {kind::input, access::out, "output"}}};

  template <class Frame>
  KTE_INLINE constexpr auto doMotion(const Frame& x) const {
    return x.ang_velocity.z;
  }
};
/// Measures the angular velocity of a frame in space: y = R w, rad/s, in axes of the world, as all measures.
struct ang_velocity_measure_3D : no_parameters {
  static constexpr type_name type{"ang_velocity_measure", kind::frame_3D};
  static constexpr std::array<port, 2> ports{
      {{kind::frame_3D, access::on, "frame"}, {kind::vector, access::out, "output"}}};

  template <class Frame>
  KTE_INLINE constexpr auto doMotion(const Frame& x) const {
    return x.rotation * x.ang_velocity;
  }
};

}  // namespace core

/// Measures the angular velocity of a frame, rad/s, in axes of the world. `output` is a signal: a number in the plane,
/// three numbers in space.
template <class F, class Y>
[[nodiscard]] constexpr auto ang_velocity_measure_2D(const F& frame, const Y& output) {
  return connect(core::ang_velocity_measure_2D{}, frame, output);
}
/// Measures the angular velocity of a frame in space.
template <class F, class Y>
[[nodiscard]] constexpr auto ang_velocity_measure_3D(const F& frame, const Y& output) {
  return connect(core::ang_velocity_measure_3D{}, frame, output);
}

KTE_CALL(ang_velocity_measure_2D, "(frame, output)")
KTE_CALL(ang_velocity_measure_3D, "(frame, output)")

}  // namespace kte
