#pragma once

#include <kte/contract/no_parameters.hpp>
#include <kte/contract/transmission.hpp>

namespace kte {

namespace core {

/// A coordinate that moves at a given rate; where it is, an internal state z of the element knows (m or rad), which
/// begins where the state of the model says:
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

}  // namespace core

/// A coordinate that moves at the rate `velocity` (m/s, rad/s), of which `acceleration` is the derivative, from where
/// its internal state `position` says.
template <class V, class A, class Z, class Q>
constexpr auto velocity_control_gen(const V& velocity, const A& acceleration, const Z& position, const Q& coordinate) {
  return connect(core::velocity_control_gen{}, velocity, acceleration, position, coordinate);
}

KTE_CALL(velocity_control_gen, "(velocity, acceleration, position, coordinate)")

namespace detail {
/// How model files make them.
struct velocity_control_family {
  template <class Add>
  static void add_to(const Add& add) {
    add("velocity_control_gen", [](const auto& x) {
      return velocity_control_gen(x.name("velocity"), x.name("acceleration"), x.name("position"), x.name("coordinate"));
    });
  }
};
}  // namespace detail

}  // namespace kte
