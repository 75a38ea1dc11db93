#pragma once

#include <kte/contract/no_parameters.hpp>
#include <kte/contract/transmission.hpp>

namespace kte {

namespace core {

/// Measures a coordinate: y = q, m or rad.
struct position_measure_gen : no_parameters {
  static constexpr type_name type{"position_measure", kind::gen};
  static constexpr std::array<port, 2> ports{
      {{kind::gen, access::on, "coordinate"}, {kind::input, access::out, "output"}}};

  template <class C>
  KTE_INLINE constexpr auto doMotion(const C& c) const {
    return c.q;
  }
};
/// Measures the position of the origin of a frame: y = p, m, in axes of the world.
template <kind Dim>
struct position_measure : no_parameters {
  static constexpr type_name type{"position_measure", Dim};
  static constexpr std::array<port, 2> ports{{{Dim, access::on, "frame"}, {kind::vector, access::out, "output"}}};

  template <class Frame>
  KTE_INLINE constexpr auto doMotion(const Frame& x) const {
    return x.position;
  }
};

}  // namespace core

/// Measures a coordinate, m or rad.
template <class Q, class Y>
[[nodiscard]] constexpr auto position_measure_gen(const Q& coordinate, const Y& output) {
  return connect(core::position_measure_gen{}, coordinate, output);
}
/// Measures the position of a frame in the plane, m, in axes of the world.
template <class F, class Y>
[[nodiscard]] constexpr auto position_measure_2D(const F& frame, const Y& output) {
  return connect(core::position_measure<kind::frame_2D>{}, frame, output);
}
/// Measures the position of a frame in space, m, in axes of the world.
template <class F, class Y>
[[nodiscard]] constexpr auto position_measure_3D(const F& frame, const Y& output) {
  return connect(core::position_measure<kind::frame_3D>{}, frame, output);
}

KTE_CALL(position_measure_gen, "(coordinate, output)")
KTE_CALL(position_measure_2D, "(frame, output)")
KTE_CALL(position_measure_3D, "(frame, output)")

}  // namespace kte
