#pragma once

#include <kte/elements/rotation_control.hpp>

namespace kte {

namespace core {

/// A frame in the plane that rotates about the origin of another at a prescribed rate w, rad/s; an internal state z of
/// the element is its angle, rad:
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
/// A frame in space that rotates about the origin of another at a prescribed angular velocity w, rad/s, in axes of the
/// end. Internal states are the entries of a quaternion q less those of the identity, so that zeros are the identity:
///
///   q = (1 + e, x, y, z),   q' = q (0, w) / 2,   R = R(q / |q|),   al = w'          (1)
///
/// R' = R [w]x for every |q|. Exact integration would not change |q|.
struct ang_velocity_control_3D : no_parameters {
  static constexpr type_name type{"ang_velocity_control", kind::frame_3D};
  static constexpr std::array<port, 8> ports{{{kind::vector, access::in, "ang_velocity"},
                                              {kind::vector, access::in, "ang_acceleration"},
                                              {kind::internal, access::keep, "e"},
                                              {kind::internal, access::keep, "x"},
                                              {kind::internal, access::keep, "y"},
                                              {kind::internal, access::keep, "z"},
                                              {kind::frame_3D, access::in, "base"},
                                              {kind::frame_3D, access::out, "end"}}};

  template <class W, class AL, class Z, class Base>
  KTE_INLINE constexpr auto doMotion(const W& w, const AL& al, const Z& e, const Z& x, const Z& y, const Z& z,
                                     const Base& base) const {
    return compose(base, motion{zero3{}, turn(e, x, y, z), zero3{}, w, zero3{}, al});
  }
  template <class W, class AL, class Z, class Base>
  KTE_INLINE constexpr auto z_dot(const W& w, const AL&, const Z& e, const Z& x, const Z& y, const Z& z,
                                  const Base&) const {
    const vec3 u{x, y, z};
    const auto rate = (one + e) * w + cross(u, w);
    return make_rates(-detail::half(dot(u, w)), detail::half(rate.x), detail::half(rate.y), detail::half(rate.z));
  }
  template <class W, class AL, class Z, class Base, class Load>
  KTE_INLINE constexpr auto doForce(const W&, const AL&, const Z& e, const Z& x, const Z& y, const Z& z, const Base&,
                                    const Load& end) const {
    return make_loads(transmit(pose{turn(e, x, y, z), zero3{}}, end));
  }

 private:
  template <class Z>
  KTE_INLINE static constexpr auto turn(const Z& e, const Z& x, const Z& y, const Z& z) {
    if constexpr (std::is_same_v<Z, zero_t>) {
      return no_rotation{};
    } else {
      return matrix_of_any_length(unit_quaternion<Z>{Z(1) + e, x, y, z});
    }
  }
};

}  // namespace core

/// A frame `end` that rotates in `base` at the prescribed rate `ang_velocity`, rad/s. `ang_acceleration` is its
/// derivative, rad/s^2. The internal state `angle` is the angle, rad.
template <class W, class AL, class Z, class B, class E>
[[nodiscard]] constexpr auto ang_velocity_control_2D(const W& ang_velocity, const AL& ang_acceleration, const Z& angle,
                                                     const B& base, const E& end) {
  return connect(core::ang_velocity_control_2D{}, ang_velocity, ang_acceleration, angle, base, end);
}
/// A frame `end` in space that rotates in `base` at the angular velocity of a signal of three numbers, rad/s, in axes
/// of the end. `ang_acceleration` is its derivative, rad/s^2. The internal states e, x, y, z are the rotation, the
/// quaternion (1 + e, x, y, z).
template <class W, class AL, class Q0, class Q1, class Q2, class Q3, class B, class E>
[[nodiscard]] constexpr auto ang_velocity_control_3D(const W& ang_velocity, const AL& ang_acceleration, const Q0& e,
                                                     const Q1& x, const Q2& y, const Q3& z, const B& base,
                                                     const E& end) {
  return connect(core::ang_velocity_control_3D{}, ang_velocity, ang_acceleration, e, x, y, z, base, end);
}

KTE_CALL(ang_velocity_control_3D, "(ang_velocity, ang_acceleration, e, x, y, z, base, end)")
KTE_CALL(ang_velocity_control_2D, "(ang_velocity, ang_acceleration, angle, base, end)")

}  // namespace kte
