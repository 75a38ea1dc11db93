#pragma once

#include <kte/contract/no_parameters.hpp>
#include <kte/contract/transmission.hpp>
#include <kte/kernels/relative_turn.hpp>

namespace kte {

namespace core {

/// Measures the rotation of a frame in the plane: y is its angle in the world, in [-pi, pi], rad.
struct rotation_measure_2D : no_parameters {
  static constexpr type_name type{"rotation_measure", kind::frame_2D};
  static constexpr std::array<port, 2> ports{
      {{kind::frame_2D, access::on, "frame"}, {kind::input, access::out, "output"}}};

  template <class Frame>
  KTE_INLINE constexpr auto doMotion(const Frame& x) const {
    return detail::turn_of(x.rotation * rotation_2D{one, zero}).z;
  }
};
/// Measures the rotation of a frame in space: y is the rotation vector of R, rad, of length <= pi. Its numbers are
/// equal in axes of the frame and of the world. At half a turn the sign of the axis is undetermined.
struct rotation_measure_3D : no_parameters {
  static constexpr type_name type{"rotation_measure", kind::frame_3D};
  static constexpr std::array<port, 2> ports{
      {{kind::frame_3D, access::on, "frame"}, {kind::vector, access::out, "output"}}};

  template <class Frame>
  KTE_INLINE constexpr auto doMotion(const Frame& x) const {
    return detail::turn_of(matrix(x.rotation));
  }
};

}  // namespace core

/// Measures the angle of a frame in the plane.
template <class F, class Y>
[[nodiscard]] constexpr auto rotation_measure_2D(const F& frame, const Y& output) {
  return connect(core::rotation_measure_2D{}, frame, output);
}
/// Measures the rotation vector of a frame in space.
template <class F, class Y>
[[nodiscard]] constexpr auto rotation_measure_3D(const F& frame, const Y& output) {
  return connect(core::rotation_measure_3D{}, frame, output);
}

KTE_CALL(rotation_measure_2D, "(frame, output)")
KTE_CALL(rotation_measure_3D, "(frame, output)")

}  // namespace kte
