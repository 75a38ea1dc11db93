#pragma once

#include <kte/contract/transmission.hpp>

namespace kte {

namespace core {

/// A force computed by a function of the coordinate or frame on which it acts: f += law(coordinate), or F, T of a frame
/// += law(frame), in axes of the frame, at its origin. For a frame the function returns a `wrench{force, torque}`, or a
/// force vector.
template <kind Dim, class Law>
struct force_law {
  static constexpr type_name type{"force_law", Dim};
  static constexpr std::array<port, 1> ports{{{Dim, access::on, Dim == kind::gen ? "coordinate" : "frame"}}};
  static constexpr bool reads_positions = is_frame(Dim);
  static constexpr bool holds_code = true;

  Law law;

  template <class X>
  KTE_INLINE constexpr auto doForce(const X& x) const {
    const auto load = law(x);
    if constexpr (Dim == kind::gen || requires { load.torque; }) {
      return make_loads(load);
    } else {
      return make_loads(wrench{load, zero3{}});
    }
  }
  constexpr void check(const parameter_check&) const {}
  template <class Self, class Visit>
  static constexpr void parameters(Self&, Visit&&) {}
};

}  // namespace core

/// A force on a coordinate, computed by your function of the coordinate: `c.q`, `c.q_dot`. The function must accept
/// numbers of any type, such as dual numbers for derivatives:
///
///   force_law_gen(q, [](const auto& c) { return -3.0 * c.q_dot; })
///
/// A chain with it cannot be saved.
template <class Q, class Law>
[[nodiscard]] constexpr auto force_law_gen(const Q& coordinate, const Law& law) {
  return connect(core::force_law<kind::gen, Law>{law}, coordinate);
}
/// A load on a frame in the plane, computed by your function of the frame: `x.position`, `x.rotation`, `x.velocity`,
/// `x.ang_velocity`, vectors in space with typed zeros out of the plane:
///
///   force_law_2D(hull, [](const auto& x) { return vec3{zero, -40.0 * x.velocity.y, zero}; })
template <class F, class Law>
[[nodiscard]] constexpr auto force_law_2D(const F& frame, const Law& law) {
  return connect(core::force_law<kind::frame_2D, Law>{law}, frame);
}
/// A load on a frame in space, computed by your function of the frame; see `force_law_2D`.
template <class F, class Law>
[[nodiscard]] constexpr auto force_law_3D(const F& frame, const Law& law) {
  return connect(core::force_law<kind::frame_3D, Law>{law}, frame);
}

}  // namespace kte
