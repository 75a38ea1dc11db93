#pragma once

#include <kte/contract/key.hpp>
#include <kte/frames/contact_state.hpp>
#include <kte/frames/coordinates.hpp>
#include <kte/frames/frame_3D.hpp>
#include <kte/frames/gen_coord.hpp>
#include <kte/frames/internal_state.hpp>
#include <kte/frames/loop_state.hpp>

#include <concepts>
#include <tuple>

/// The content of a state for each kind, and the numbers of coordinates in order.
namespace kte::detail {

/// In the order of `kind`.
template <class S>
using things = std::tuple<gen_coord<S>, frame_2D<S>, frame_3D<S>, S, rotation_coord_3D<S>, pose_coord_2D<S>,
                          pose_coord_3D<S>, internal_state<S>, vec3<S>, loop_state<S>, contact_state<S>>;
template <kind K, class S>
using thing_of = std::tuple_element_t<static_cast<std::size_t>(K), things<S>>;

/// The kind of an item by its type, for any scalar.
template <class T>
inline constexpr kind kind_of_thing = [] {
  static_assert(!std::is_same_v<T, T>, "kte: this is not a coordinate, frame, input or internal state");
  return kind{};
}();
template <std::floating_point S>
inline constexpr kind kind_of_thing<S> = kind::input;
template <class S>
inline constexpr kind kind_of_thing<gen_coord<S>> = kind::gen;
template <class S>
inline constexpr kind kind_of_thing<frame_2D<S>> = kind::frame_2D;
template <class S>
inline constexpr kind kind_of_thing<frame_3D<S>> = kind::frame_3D;
template <class S>
inline constexpr kind kind_of_thing<rotation_coord_3D<S>> = kind::rotation_3D;
template <class S>
inline constexpr kind kind_of_thing<pose_coord_2D<S>> = kind::pose_2D;
template <class S>
inline constexpr kind kind_of_thing<pose_coord_3D<S>> = kind::pose_3D;
template <class S>
inline constexpr kind kind_of_thing<internal_state<S>> = kind::internal;
template <class S>
inline constexpr kind kind_of_thing<vec3<S, S, S>> = kind::vector;
template <class S>
inline constexpr kind kind_of_thing<loop_state<S>> = kind::loop;
template <class S>
inline constexpr kind kind_of_thing<contact_state<S>> = kind::contact;

/// Member K of a tuple with one member per kind.
template <kind K, class Tuple>
KTE_INLINE constexpr auto& of_kind(Tuple& t) {
  return std::get<static_cast<std::size_t>(K)>(t);
}

/// A signal as kernels see it.
template <kind K, class T>
KTE_INLINE constexpr const auto& number_of_signal(const T& x) {
  if constexpr (K == kind::internal) {
    return x.z;
  } else {
    return x;
  }
}
template <class V, class Visit>
KTE_INLINE constexpr void visit_vector(V& v, const Visit& visit) {
  visit(v.x), visit(v.y);
  if constexpr (requires { v.z; }) visit(v.z);
}
/// The numbers of the configuration, in the order of q.
template <class C, class Visit>
KTE_INLINE constexpr void visit_q(C& c, const Visit& visit) {
  if constexpr (requires { c.q; }) {
    visit(c.q);
  } else {
    if constexpr (requires { c.position; }) visit_vector(c.position, visit);
    if constexpr (requires { c.angle; }) {
      visit(c.angle);
    } else {
      visit(c.rotation.w), visit(c.rotation.x), visit(c.rotation.y), visit(c.rotation.z);
    }
  }
}
/// A linear and an angular quantity, in the order of v.
template <class Linear, class Angular, class Visit>
KTE_INLINE constexpr void visit_rates(Linear& linear, Angular& angular, const Visit& visit) {
  visit_vector(linear, visit);
  if constexpr (requires { angular.x; }) {
    visit_vector(angular, visit);
  } else {
    visit(angular);
  }
}
template <class C, class Visit>
KTE_INLINE constexpr void visit_v(C& c, const Visit& visit) {
  if constexpr (requires { c.q_dot; }) {
    visit(c.q_dot);
  } else if constexpr (requires { c.velocity; }) {
    visit_rates(c.velocity, c.ang_velocity, visit);
  } else {
    visit_vector(c.ang_velocity, visit);
  }
}
template <class C, class Visit>
KTE_INLINE constexpr void visit_a(C& c, const Visit& visit) {
  if constexpr (requires { c.q_ddot; }) {
    visit(c.q_ddot);
  } else if constexpr (requires { c.acceleration; }) {
    visit_rates(c.acceleration, c.ang_acceleration, visit);
  } else {
    visit_vector(c.ang_acceleration, visit);
  }
}
template <class C, class Visit>
KTE_INLINE constexpr void visit_f(C& c, const Visit& visit) {
  if constexpr (requires { c.f; }) {
    visit(c.f);
  } else if constexpr (requires { c.force; }) {
    visit_rates(c.force, c.torque, visit);
  } else {
    visit_vector(c.torque, visit);
  }
}

}  // namespace kte::detail
