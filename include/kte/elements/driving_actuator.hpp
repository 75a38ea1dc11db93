#pragma once

#include <kte/contract/no_parameters.hpp>
#include <kte/contract/transmission.hpp>

namespace kte {

namespace detail {
constexpr kind kind_of_torque(kind frame) { return frame == kind::frame_2D ? kind::input : kind::vector; }
/// A wrench from two signals. In the plane the third number of the force is ignored, and the torque is a number.
template <kind Dim, class U, class T>
KTE_INLINE constexpr auto wrench_of_signals(const U& u, const T& t) {
  if constexpr (Dim == kind::frame_2D) {
    return wrench{vec3{u.x, u.y, zero}, vec3{zero, zero, t}};
  } else {
    return wrench{u, t};
  }
}
}  // namespace detail

namespace core {

/// A motor on a coordinate: f += u. The input u of the chain is in N or Nm.
struct driving_actuator_gen : no_parameters {
  static constexpr type_name type{"driving_actuator", kind::gen};
  static constexpr std::array<port, 2> ports{
      {{kind::gen, access::on, "coordinate"}, {kind::input, access::in, "input"}}};
  static constexpr bool is_load = true;

  template <class C, class U>
  KTE_INLINE constexpr auto doForce(const C&, const U& u) const {
    return make_loads(u);
  }
};
/// Thrusters on a frame: F += u, T += t, in axes of the frame, at its origin; u and t are signals, N and Nm. There is
/// no reaction on another frame.
template <kind Dim>
struct driving_actuator : no_parameters {
  static constexpr type_name type{"driving_actuator", Dim};
  static constexpr std::array<port, 3> ports{{{Dim, access::on, "frame"},
                                              {kind::vector, access::in, "force"},
                                              {detail::kind_of_torque(Dim), access::in, "torque"}}};
  static constexpr bool is_load = true;

  template <class Frame, class U, class T>
  KTE_INLINE constexpr auto doForce(const Frame&, const U& u, const T& t) const {
    return make_loads(detail::wrench_of_signals<Dim>(u, t));
  }
};

}  // namespace core

/// A motor that drives a coordinate by the generalized force `input`, N or Nm, set in the state: `s[motor] = 2.0`.
template <class Q, class U>
[[nodiscard]] constexpr auto driving_actuator_gen(const Q& coordinate, const U& input) {
  return connect(core::driving_actuator_gen{}, coordinate, input);
}

/// Thrusters on a frame in the plane: signals `force`, three numbers, N, and `torque`, a number, Nm, in axes of the
/// frame.
template <class F, class U, class T>
[[nodiscard]] constexpr auto driving_actuator_2D(const F& frame, const U& force, const T& torque) {
  return connect(core::driving_actuator<kind::frame_2D>{}, frame, force, torque);
}
/// Thrusters on a frame in space: signals `force`, N, and `torque`, Nm, of three numbers each, in axes of the frame.
template <class F, class U, class T>
[[nodiscard]] constexpr auto driving_actuator_3D(const F& frame, const U& force, const T& torque) {
  return connect(core::driving_actuator<kind::frame_3D>{}, frame, force, torque);
}

KTE_CALL(driving_actuator_gen, "(coordinate, input)")
KTE_CALL(driving_actuator_2D, "(frame, force, torque)")
KTE_CALL(driving_actuator_3D, "(frame, force, torque)")

}  // namespace kte
