#pragma once

#include <kte/elements/position_control.hpp>

namespace kte {

namespace core {

/// A coordinate with a prescribed rate v. An internal state z of the element, m or rad, is its position; its initial
/// value is part of the state of the model:
///
///   q = z,   q' = v,   q'' = v',   z' = v          (1)
struct velocity_control_gen : no_parameters {
  static constexpr type_name type{"velocity_control", kind::gen};
  static constexpr std::array<port, 4> ports{{{kind::input, access::in, "velocity"},
                                              {kind::input, access::in, "acceleration"},
                                              {kind::internal, access::keep, "position"},
                                              {kind::gen, access::out, "coordinate"}}};

  template <class V, class A, class Z>
  KTE_INLINE constexpr auto doMotion(const V& v, const A& a, const Z& z) const {
    return coordinate{z, v, a, skip{}, skip{}};
  }
  template <class V, class A, class Z>
  KTE_INLINE constexpr auto z_dot(const V& v, const A&, const Z&) const {
    return v;
  }
  template <class V, class A, class Z, class F>
  KTE_INLINE constexpr auto doForce(const V&, const A&, const Z&, const F&) const {
    return make_loads();
  }
};
/// A frame in the plane that moves in another at a prescribed velocity, without rotation. Internal states x, y are its
/// position:
///
///   p = (x, y),   v = u,   a = u',   (x', y') = u          in axes of the base          (1)
struct velocity_control_2D : no_parameters {
  static constexpr type_name type{"velocity_control", kind::frame_2D};
  static constexpr std::array<port, 6> ports{{{kind::vector, access::in, "velocity"},
                                              {kind::vector, access::in, "acceleration"},
                                              {kind::internal, access::keep, "x"},
                                              {kind::internal, access::keep, "y"},
                                              {kind::frame_2D, access::in, "base"},
                                              {kind::frame_2D, access::out, "end"}}};
  using at_position = position_control<kind::frame_2D>;

  template <class V, class A, class X, class Y, class Base>
  KTE_INLINE constexpr auto doMotion(const V& v, const A& a, const X& x, const Y& y, const Base& base) const {
    return at_position{}.doMotion(vec3{x, y, zero}, v, a, base);
  }
  template <class V, class A, class X, class Y, class Base>
  KTE_INLINE constexpr auto z_dot(const V& v, const A&, const X&, const Y&, const Base&) const {
    return make_rates(v.x, v.y);
  }
  template <class V, class A, class X, class Y, class Base, class Load>
  KTE_INLINE constexpr auto doForce(const V& v, const A& a, const X& x, const Y& y, const Base& base,
                                    const Load& end) const {
    return at_position{}.doForce(vec3{x, y, zero}, v, a, base, end);
  }
};
/// A frame in space that moves in another at a prescribed velocity, without rotation. Internal states x, y, z are its
/// position.
struct velocity_control_3D : no_parameters {
  static constexpr type_name type{"velocity_control", kind::frame_3D};
  static constexpr std::array<port, 7> ports{{{kind::vector, access::in, "velocity"},
                                              {kind::vector, access::in, "acceleration"},
                                              {kind::internal, access::keep, "x"},
                                              {kind::internal, access::keep, "y"},
                                              {kind::internal, access::keep, "z"},
                                              {kind::frame_3D, access::in, "base"},
                                              {kind::frame_3D, access::out, "end"}}};
  using at_position = position_control<kind::frame_3D>;

  template <class V, class A, class X, class Y, class Z, class Base>
  KTE_INLINE constexpr auto doMotion(const V& v, const A& a, const X& x, const Y& y, const Z& z,
                                     const Base& base) const {
    return at_position{}.doMotion(vec3{x, y, z}, v, a, base);
  }
  template <class V, class A, class X, class Y, class Z, class Base>
  KTE_INLINE constexpr auto z_dot(const V& v, const A&, const X&, const Y&, const Z&, const Base&) const {
    return make_rates(v.x, v.y, v.z);
  }
  template <class V, class A, class X, class Y, class Z, class Base, class Load>
  KTE_INLINE constexpr auto doForce(const V& v, const A& a, const X& x, const Y& y, const Z& z, const Base& base,
                                    const Load& end) const {
    return at_position{}.doForce(vec3{x, y, z}, v, a, base, end);
  }
};

}  // namespace core

/// A coordinate with the prescribed rate `velocity`, m/s or rad/s, and its derivative `acceleration`. The internal
/// state `position` is its position, m or rad.
template <class V, class A, class Z, class Q>
[[nodiscard]] constexpr auto velocity_control_gen(const V& velocity, const A& acceleration, const Z& position,
                                                  const Q& coordinate) {
  return connect(core::velocity_control_gen{}, velocity, acceleration, position, coordinate);
}
/// A frame `end` in the plane that moves in `base` without rotation, at the velocity of a signal of three numbers, m/s,
/// with its derivative `acceleration`. The internal states x, y are its position, m.
template <class V, class A, class X, class Y, class B, class E>
[[nodiscard]] constexpr auto velocity_control_2D(const V& velocity, const A& acceleration, const X& x, const Y& y,
                                                 const B& base, const E& end) {
  return connect(core::velocity_control_2D{}, velocity, acceleration, x, y, base, end);
}
/// A frame `end` in space that moves in `base` without rotation, at the velocity of a signal of three numbers, m/s,
/// with its derivative `acceleration`. The internal states x, y, z are its position, m.
template <class V, class A, class X, class Y, class Z, class B, class E>
[[nodiscard]] constexpr auto velocity_control_3D(const V& velocity, const A& acceleration, const X& x, const Y& y,
                                                 const Z& z, const B& base, const E& end) {
  return connect(core::velocity_control_3D{}, velocity, acceleration, x, y, z, base, end);
}

KTE_CALL(velocity_control_2D, "(velocity, acceleration, x, y, base, end)")
KTE_CALL(velocity_control_3D, "(velocity, acceleration, x, y, z, base, end)")
KTE_CALL(velocity_control_gen, "(velocity, acceleration, position, coordinate)")

}  // namespace kte
