#pragma once

#include <kte/contract/no_parameters.hpp>
#include <kte/contract/transmission.hpp>

namespace kte {

namespace core {

/// An accelerometer at the origin of a frame: y = a - R^T g, the acceleration relative to free fall, m/s^2, in axes of
/// the frame. As gravity is an acceleration of bases, this is the acceleration of the frame in the state. No force may
/// depend on it.
template <kind Dim>
struct acceleration_measure : no_parameters {
  static constexpr type_name type{"acceleration_measure", Dim};
  static constexpr std::array<port, 2> ports{{{Dim, access::on, "frame"}, {kind::vector, access::out, "output"}}};
  static constexpr bool reads_accelerations = true;

  template <class Frame>
  KTE_INLINE constexpr auto doMotion(const Frame& x) const {
    return x.acceleration;
  }
};

}  // namespace core

/// An accelerometer on a frame in the plane.
template <class F, class Y>
[[nodiscard]] constexpr auto acceleration_measure_2D(const F& frame, const Y& output) {
  return connect(core::acceleration_measure<kind::frame_2D>{}, frame, output);
}
/// An accelerometer on a frame in space.
template <class F, class Y>
[[nodiscard]] constexpr auto acceleration_measure_3D(const F& frame, const Y& output) {
  return connect(core::acceleration_measure<kind::frame_3D>{}, frame, output);
}

KTE_CALL(acceleration_measure_2D, "(frame, output)")
KTE_CALL(acceleration_measure_3D, "(frame, output)")

}  // namespace kte
