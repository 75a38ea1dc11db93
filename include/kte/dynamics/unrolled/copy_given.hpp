#pragma once

#include <kte/dynamics/unrolled/given.hpp>
#include <kte/dynamics/unrolled/plan.hpp>

/// Copies given quantities (dynamics/unrolled/given.hpp) to a state.
namespace kte::detail {

/// Copies a number; quantities that were not computed become zero.
template <class S, class To, class From>
void copy_number(To& to, const From& from) {
  if constexpr (std::is_same_v<From, skip>) {
    to = To(0);
  } else if constexpr (std::is_same_v<To, S>) {
    to = as<S>(from);
  } else {
    copy_number<S>(to.x, from.x), copy_number<S>(to.y, from.y);
    if constexpr (requires { to.z; }) copy_number<S>(to.z, from.z);
  }
}
template <class S, class C>
void copy_coordinate(gen_coord<S>& to, const C& c) {
  copy_number<S>(to.q, c.q), copy_number<S>(to.q_dot, c.q_dot), copy_number<S>(to.q_ddot, c.q_ddot);
  copy_number<S>(to.cos, c.cos), copy_number<S>(to.sin, c.sin);
}
template <class S, class M>
void copy_coordinate(pose_coord_2D<S>& to, const M& m) {
  copy_number<S>(to.position, m.position);
  copy_number<S>(to.cos, m.rotation.cos), copy_number<S>(to.sin, m.rotation.sin);
  copy_number<S>(to.velocity, m.velocity), copy_number<S>(to.ang_velocity, m.ang_velocity.z);
  copy_number<S>(to.acceleration, m.acceleration), copy_number<S>(to.ang_acceleration, m.ang_acceleration.z);
}
template <class S, class To, class M>
void copy_coordinate(To& to, const M& m) {
  to.matrix = m.rotation;
  if constexpr (requires { to.position; }) {
    copy_number<S>(to.position, m.position), copy_number<S>(to.velocity, m.velocity);
    copy_number<S>(to.acceleration, m.acceleration);
  }
  copy_number<S>(to.ang_velocity, m.ang_velocity), copy_number<S>(to.ang_acceleration, m.ang_acceleration);
}
/// Returns x, or the other value if x was not computed.
template <class X, class Other>
const auto& known_or(const X& x, const Other& otherwise) {
  if constexpr (std::is_same_v<X, skip>) {
    return otherwise;
  } else {
    return x;
  }
}
template <class Frame, class M>
void copy_base(Frame& to, const M& m) {
  static constexpr zero3 none{};
  set_motion(
      to, motion{known_or(m.position, none), known_or(m.rotation, no_rotation{}), known_or(m.velocity, none),
                 known_or(m.ang_velocity, none), known_or(m.acceleration, none), known_or(m.ang_acceleration, none)});
}
/// All but the degrees of freedom: prescribed coordinates, signals, internal states, bases. slot<kind>(i): the item of
/// the state for item i of the chain.
template <class Wiring, class Given, class State, class Slot>
void copy_given_items(const Given& g, State& s, const Slot& slot) {
  using S = typename State::scalar;
  const auto item = [&]<kind K>(int i) -> auto& { return s.template get<K>(slot.template operator()<K>(i)); };
  unroll(given_things<Wiring, kind::gen>{}, [&]<std::size_t I>() {
    copy_coordinate<S>(item.template operator()<kind::gen>(int{I}), g.template fixed<int{I}>());
  });
  unroll(given_things<Wiring, kind::input>{},
         [&]<std::size_t I>() { item.template operator()<kind::input>(int{I}) = as<S>(g.template input<int{I}>()); });
  unroll(given_things<Wiring, kind::vector>{},
         [&]<std::size_t I>() { item.template operator()<kind::vector>(int{I}) = as<S>(g.template vector<int{I}>()); });
  unroll<Wiring::count(kind::internal)>(
      [&]<int I>() { item.template operator()<kind::internal>(I).z = as<S>(g.template internal<I>()); });
  for_each_base<Wiring>([&]<kind K, int I>() { copy_base(item.template operator()<K>(I), g.template base<K, I>()); });
}

}  // namespace kte::detail
