#pragma once

#include <kte/contract/no_parameters.hpp>
#include <kte/contract/transmission.hpp>

namespace kte {

namespace core {

/// A coordinate whose motion is prescribed by signals: q = u, q' = u', q'' = u''.
struct position_control_gen : no_parameters {
  static constexpr type_name type{"position_control", kind::gen};
  static constexpr std::array<port, 4> ports{{{kind::input, access::in, "position"},
                                              {kind::input, access::in, "velocity"},
                                              {kind::input, access::in, "acceleration"},
                                              {kind::gen, access::out, "coordinate"}}};

  template <class U, class V, class A>
  KTE_INLINE constexpr auto doMotion(const U& u, const V& v, const A& a) const {
    return coordinate{u, v, a, skip{}, skip{}};
  }
  template <class U, class V, class A, class F>
  KTE_INLINE constexpr auto doForce(const U&, const V&, const A&, const F&) const {
    return make_loads();
  }
};
/// A frame that moves in another without rotation, as prescribed by signals:
///
///   p = u,   v = u',   a = u''          in axes of the base          (1)
///
/// On a base of the chain it is a base too, such as a shaking table.
template <kind Dim>
struct position_control : no_parameters {
  static constexpr type_name type{"position_control", Dim};
  static constexpr std::array<port, 5> ports{{{kind::vector, access::in, "position"},
                                              {kind::vector, access::in, "velocity"},
                                              {kind::vector, access::in, "acceleration"},
                                              {Dim, access::in, "base"},
                                              {Dim, access::out, "end"}}};

  template <class U, class V, class A, class Base>
  KTE_INLINE constexpr auto doMotion(const U& u, const V& v, const A& a, const Base& base) const {
    return compose(base, motion{planar(u), no_rotation{}, planar(v), zero3{}, planar(a), zero3{}});
  }
  template <class U, class V, class A, class Base, class F, class T>
  KTE_INLINE constexpr auto doForce(const U& u, const V&, const A&, const Base&, const wrench<F, T>& end) const {
    return make_loads(transmit(pose{no_rotation{}, planar(u)}, end));
  }

 private:
  template <class V>
  KTE_INLINE static constexpr auto planar(const V& v) {
    if constexpr (Dim == kind::frame_2D) {
      return vec3{v.x, v.y, zero};
    } else {
      return v;
    }
  }
};

}  // namespace core

/// A coordinate with the motion of three signals: position, m or rad, and its first and second time derivative.
template <class U, class V, class A, class Q>
[[nodiscard]] constexpr auto position_control_gen(const U& position, const V& velocity, const A& acceleration,
                                                  const Q& coordinate) {
  return connect(core::position_control_gen{}, position, velocity, acceleration, coordinate);
}
/// A frame `end` in the plane that moves in `base` without rotation, with the motion of three signals of three numbers:
/// position, m, and its first and second time derivative, in axes of the base.
template <class U, class V, class A, class B, class E>
[[nodiscard]] constexpr auto position_control_2D(const U& position, const V& velocity, const A& acceleration,
                                                 const B& base, const E& end) {
  return connect(core::position_control<kind::frame_2D>{}, position, velocity, acceleration, base, end);
}
/// A frame `end` in space that moves in `base` without rotation, with the motion of three signals of three numbers:
/// position, m, and its first and second time derivative, in axes of the base.
template <class U, class V, class A, class B, class E>
[[nodiscard]] constexpr auto position_control_3D(const U& position, const V& velocity, const A& acceleration,
                                                 const B& base, const E& end) {
  return connect(core::position_control<kind::frame_3D>{}, position, velocity, acceleration, base, end);
}

KTE_CALL(position_control_gen, "(position, velocity, acceleration, coordinate)")
KTE_CALL(position_control_2D, "(position, velocity, acceleration, base, end)")
KTE_CALL(position_control_3D, "(position, velocity, acceleration, base, end)")

}  // namespace kte
