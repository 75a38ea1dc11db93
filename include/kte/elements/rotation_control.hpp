#pragma once

#include <kte/contract/no_parameters.hpp>
#include <kte/contract/transmission.hpp>
#include <kte/kernels/midway.hpp>
#include <kte/math/quaternion.hpp>

namespace kte {

namespace detail {
/// The rotation by an angle about z; none for a typed zero.
template <class Angle>
KTE_INLINE constexpr auto turn_about_z(const Angle& angle) {
  if constexpr (std::is_same_v<Angle, zero_t>) {
    return rotation_2D{one, zero};
  } else {
    Angle sine, cosine;
    sincos(angle, sine, cosine);
    return rotation_2D{cosine, sine};
  }
}
/// The matrix exp [r]x of a rotation vector r of any length: of the quaternion (cos(t/2), sin(t/2)/t r).
template <class X, class Y, class Z>
KTE_INLINE constexpr auto turn_by(const vec3<X, Y, Z>& r) {
  if constexpr (std::is_same_v<vec3<X, Y, Z>, zero3>) {
    return no_rotation{};
  } else {
    const auto tt = as_number(dot(r, r));
    using S = std::remove_const_t<decltype(tt)>;
    const auto half = half_turn_functions_of(tt);
    return matrix(unit_quaternion<S>{half.c, S(half.s * r.x), S(half.s * r.y), S(half.s * r.z)});
  }
}
}  // namespace detail

namespace core {

/// A frame in the plane that rotates about the origin of another, as prescribed by signals:
///
///   R = Rot(z, u),   w = u',   al = u''          (1)
struct rotation_control_2D : no_parameters {
  static constexpr type_name type{"rotation_control", kind::frame_2D};
  static constexpr std::array<port, 5> ports{{{kind::input, access::in, "angle"},
                                              {kind::input, access::in, "ang_velocity"},
                                              {kind::input, access::in, "ang_acceleration"},
                                              {kind::frame_2D, access::in, "base"},
                                              {kind::frame_2D, access::out, "end"}}};

  template <class U, class W, class AL, class Base>
  KTE_INLINE constexpr auto doMotion(const U& u, const W& w, const AL& al, const Base& base) const {
    return compose(
        base, motion{zero3{}, detail::turn_about_z(u), zero3{}, vec3{zero, zero, w}, zero3{}, vec3{zero, zero, al}});
  }
  template <class U, class W, class AL, class Base, class F, class T>
  KTE_INLINE constexpr auto doForce(const U& u, const W&, const AL&, const Base&, const wrench<F, T>& end) const {
    return make_loads(transmit(pose{detail::turn_about_z(u), zero3{}}, end));
  }
};
/// A frame in space that rotates about the origin of another, as prescribed by signals: a rotation vector r, and the
/// angular velocity w, both in axes of the end:
///
///   R = exp [r]x,   w,   al = w'                 (1)
///
/// For a fixed axis n: r = n u, w = n u', al = n u''. In general w differs from r'.
struct rotation_control_3D : no_parameters {
  static constexpr type_name type{"rotation_control", kind::frame_3D};
  static constexpr std::array<port, 5> ports{{{kind::vector, access::in, "rotation"},
                                              {kind::vector, access::in, "ang_velocity"},
                                              {kind::vector, access::in, "ang_acceleration"},
                                              {kind::frame_3D, access::in, "base"},
                                              {kind::frame_3D, access::out, "end"}}};

  template <class U, class W, class AL, class Base>
  KTE_INLINE constexpr auto doMotion(const U& r, const W& w, const AL& al, const Base& base) const {
    return compose(base, motion{zero3{}, detail::turn_by(r), zero3{}, w, zero3{}, al});
  }
  template <class U, class W, class AL, class Base, class F, class T>
  KTE_INLINE constexpr auto doForce(const U& r, const W&, const AL&, const Base&, const wrench<F, T>& end) const {
    return make_loads(transmit(pose{detail::turn_by(r), zero3{}}, end));
  }
};

}  // namespace core

/// A frame `end` that rotates in `base` by signals: angle, rad, and its first and second time derivative.
template <class U, class W, class AL, class B, class E>
[[nodiscard]] constexpr auto rotation_control_2D(const U& angle, const W& ang_velocity, const AL& ang_acceleration,
                                                 const B& base, const E& end) {
  return connect(core::rotation_control_2D{}, angle, ang_velocity, ang_acceleration, base, end);
}
/// A frame `end` that rotates in `base` by signals of three numbers: rotation vector, rad, angular velocity, rad/s, and
/// angular acceleration, rad/s^2, in axes of the end.
template <class U, class W, class AL, class B, class E>
[[nodiscard]] constexpr auto rotation_control_3D(const U& rotation, const W& ang_velocity, const AL& ang_acceleration,
                                                 const B& base, const E& end) {
  return connect(core::rotation_control_3D{}, rotation, ang_velocity, ang_acceleration, base, end);
}

KTE_CALL(rotation_control_2D, "(angle, ang_velocity, ang_acceleration, base, end)")
KTE_CALL(rotation_control_3D, "(rotation, ang_velocity, ang_acceleration, base, end)")

}  // namespace kte
