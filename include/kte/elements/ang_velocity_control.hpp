#pragma once

#include <kte/elements/rotation_control.hpp>

namespace kte {

namespace core {

/// A frame in the plane that turns in another about its origin at a given rate; an internal state z of the element is
/// its angle, rad:
///
///   R = Rot(z),   w,   al = w',   z' = w          (1)
struct ang_velocity_control_2D : no_parameters {
  static constexpr type_name type{"ang_velocity_control", kind::frame_2D};
  static constexpr std::array<port, 5> ports{{{kind::input, access::in, "ang_velocity"},
                                              {kind::input, access::in, "ang_acceleration"},
                                              {kind::internal, access::keep, "angle"},
                                              {kind::frame_2D, access::in, "base"},
                                              {kind::frame_2D, access::out, "end"}}};

  template <class W, class AL, class Z, class Base>
  KTE_INLINE constexpr auto doMotion(const W& w, const AL& al, const Z& z, const Base& base) const {
    return rotation_control_2D{}.doMotion(z, w, al, base);
  }
  template <class W, class AL, class Z, class Base>
  KTE_INLINE constexpr auto z_dot(const W& w, const AL&, const Z&, const Base&) const {
    return w;
  }
  template <class W, class AL, class Z, class Base, class Load>
  KTE_INLINE constexpr auto doForce(const W& w, const AL& al, const Z& z, const Base& base, const Load& end) const {
    return rotation_control_2D{}.doForce(z, w, al, base, end);
  }
};

}  // namespace core

/// A frame `end` that turns in `base` at the rate `ang_velocity` (rad/s), of which `ang_acceleration` is the
/// derivative, from the angle that its internal state `angle` says.
template <class W, class AL, class Z, class B, class E>
constexpr auto ang_velocity_control_2D(const W& ang_velocity, const AL& ang_acceleration, const Z& angle, const B& base,
                                       const E& end) {
  return connect(core::ang_velocity_control_2D{}, ang_velocity, ang_acceleration, angle, base, end);
}

KTE_CALL(ang_velocity_control_2D, "(ang_velocity, ang_acceleration, angle, base, end)")

namespace detail {
/// How model files make them.
struct ang_velocity_control_family {
  template <class Add>
  static void add_to(const Add& add) {
    add("ang_velocity_control_2D", [](const auto& x) {
      return ang_velocity_control_2D(x.name("ang_velocity"), x.name("ang_acceleration"), x.name("angle"),
                                     x.name("base"), x.name("end"));
    });
  }
};
}  // namespace detail

}  // namespace kte
