#pragma once

#include <kte/recursions/axis_elimination_by_number.hpp>
#include <kte/recursions/newton_euler.hpp>

/// The articulated-body algorithm (ABA; Featherstone 1983; 2008, section 7.3), with classical accelerations in the axes
/// of each body. A joint is free to move, or its acceleration is given.
namespace kte::engine {

/// The part of the acceleration of a body that depends on velocities only: `centripetal` is w x (w x p), in the axes of
/// the parent; (linear, angular) are in the axes of the body.
template <class W, class A, class C, class CL>
struct bias_motion {
  using geometry = bias_motion;
  W ang_velocity;
  A centripetal;
  C linear;
  CL angular;
};
template <class W, class A, class C, class CL>
bias_motion(W, A, C, CL) -> bias_motion<W, A, C, CL>;

/// (1)  c = w x (w x p) in the axes of the parent; 2 (R^T w) x v_J + w_J x v_J, (R^T w) x w_J, each with dS/dt q_dot,
/// and
///      with S q_ddot for joints whose acceleration is given
template <body B, class M, class S>
KTE_INLINE constexpr auto bias_motion_of(const B& b, const M& parent, const S* rate, const S* change) {
  const auto& w = parent.ang_velocity;
  const auto [v_j, w_j] = b.along_axes(rate);
  const auto w_in = b.in(w);
  const auto linear = constant<2>{} * cross(w_in, v_j) + cross(w_j, v_j);
  if constexpr (B::always_free) {
    return bias_motion{w_in + w_j, cross(w, cross(w, b.position())), linear, cross(w_in, w_j)};
  } else {
    vec3<S> a, al;
    const auto [a_s, al_s] = bias_along_axes(b, rate);
    assign(a, linear + a_s), assign(al, cross(w_in, w_j) + al_s);
    if (!b.free()) {
      const auto [a_j, al_j] = b.along_axes(change);
      a = as<S>(a + a_j), al = as<S>(al + al_j);
    }
    return bias_motion{w_in + w_j, cross(w, cross(w, b.position())), a, al};
  }
}
/// The wrench of a body at the angular velocity w and zero acceleration.
template <class B, class W>
KTE_INLINE constexpr auto velocity_wrench(const B& b, const W& w) {
  const auto& [mass, c, inertia, published] = b.inertia();
  const auto f = mass * cross(w, cross(w, c));
  return wrench{fresh(f), plus_cross(cross(w, inertia * w), c, f)};
}

/// I^A and p^A of a body about the origin of its parent and in the axes of the parent.
template <body B, class I, class W, class A>
KTE_INLINE constexpr auto pulled_back(const B& b, const articulated_body<I, W>& x, const A& centripetal) {
  const auto& p = b.position();
  const articulated i{b.out(x.inertia.linear), b.out(x.inertia.coupling), b.out(x.inertia.angular)};
  const auto force = b.out(x.bias.force) + i.linear * centripetal;
  return articulated_body{
      shifted(p, i),
      wrench{fresh(force), plus_cross(b.out(x.bias.torque) + transpose(i.coupling) * centripetal, p, force)}};
}
/// Whether a body has no axes by its type: a rigid link.
template <class B>
inline constexpr bool without_joint = false;
template <body_with_axes B>
inline constexpr bool without_joint<B> = B::axes == 0;
/// The articulated inertia and bias force of a body as its parent carries them.
template <body B, class C, class Y, class Force>
KTE_INLINE constexpr auto seen_by_parent(const B& b, const C& c, const Y& y, const Force& force) {
  constexpr std::integral_constant<int, 0> first{};
  if constexpr (without_joint<B> || never_free<B>) {
    const auto more = accelerating_wrench(y.inertia, c.linear, c.angular);
    return pulled_back(b, articulated_body{y.inertia, y.bias + more}, c.centripetal);
  } else if constexpr (B::always_free) {
    const auto left = after_elimination<0>(b, y, no_wrench, force(first)).inertia;
    const auto more = accelerating_wrench(left, c.linear, c.angular);
    return pulled_back(b, articulated_body{left, after_elimination<0>(b, y, more, force(first)).bias}, c.centripetal);
  } else {
    using S = typename B::scalar;
    dense<S, decltype(articulated_body{y.inertia, y.bias})> left;
    if constexpr (body_with_axes<B>) {
      if (b.free())
        assign(left, after_elimination<0>(b, y, no_wrench, force(first)));
      else
        assign(left, articulated_body{y.inertia, y.bias});
    } else {
      assign(left, articulated_body{y.inertia, y.bias});
    }
    return pulled_back(
        b, articulated_body{left.inertia, left.bias + accelerating_wrench(left.inertia, c.linear, c.angular)},
        c.centripetal);
  }
}
template <class S, body B, class A>
KTE_INLINE constexpr auto accelerated_if_free(const B& b, const axis_factors<S>* factors, const A& a, S* change) {
  if constexpr (B::always_free) {
    return accelerated<0>(b, factors, a, change);
  } else if constexpr (never_free<B>) {
    return a;
  } else {
    dense<S, A> x;
    assign(x, a);
    if (b.free()) {
      if constexpr (body_with_axes<B>)
        assign(x, accelerated<0>(b, factors, a, change));
      else
        accelerate_by_number(b, factors, x, change);
    }
    return x;
  }
}

/// The step of the outward recursion (1), with the rates and given accelerations of axes.
template <class S>
struct bias_motion_of_child {
  const S* rate;
  const S* change;
  template <body B, class M>
  KTE_INLINE constexpr auto operator()(const B& b, const M& parent) const {
    return bias_motion_of(b, parent, rate + b.first(), change + b.first());
  }
};
/// Outward recursion (1), from the angular velocities of the bases in `kept`.
template <class Hand, class Driver, class Kept, class S>
KTE_INLINE auto bias_motions(const Driver& d, const Kept& kept, const S* rate, const S* change) {
  return d.template outward<Hand>(kept, bias_motion_of_child<S>{rate, change});
}
/// The steps of the inward recursion: a body alone, with own(body, bias motion) in its p^A; its joint, with
/// force(body)(k) on axis k; its parent.
template <class Own>
struct articulated_alone {
  Own own;
  template <class B, class M>
  KTE_INLINE constexpr auto operator()(const B& b, const M& m) const {
    return articulated_body{to_articulated(b.composite()), own(b, m)};
  }
};
template <class S, class Force, class Unmoved>
struct joint_elimination {
  Force force;
  axis_factors<S>* factors;
  Unmoved& unmoved;
  template <body B, class X, class Ends>
  KTE_INLINE constexpr auto operator()(const B& b, const X& x, const Ends& ends) const {
    if constexpr (body_with_axes<B>)
      return eliminated(b, x, force(b), factors + b.first(), unmoved);
    else
      return eliminated_by_number(b, x, force(b), factors + b.first(), ends, unmoved);
  }
};
template <class Force>
struct articulated_to_parent {
  Force force;
  template <body B, class M, class Y>
  KTE_INLINE constexpr auto operator()(const B& b, const M& m, const Y& y) const {
    return seen_by_parent(b, m, y, force(b));
  }
};
/// Inward recursion; writes `factors` by axis. `unmoved`: notes axes without inertia.
template <class Hand, class Driver, class Kept, class Biases, class Own, class Force, class S, class Unmoved>
KTE_INLINE void articulate(const Driver& d, const Kept& kept, const Biases& biases, const Own& own, const Force& force,
                           axis_factors<S>* factors, Unmoved& unmoved) {
  d.template inward<false, Hand, false>(kept, biases, articulated_alone<Own>{own},
                                        joint_elimination<S, Force, Unmoved>{force, factors, unmoved},
                                        articulated_to_parent<Force>{force});
}
/// Articulated inertias only: for a mechanism at rest, without loads and forces.
struct rest {
  template <class B>
  KTE_INLINE constexpr auto operator()(const B&) const {
    return [](int) KTE_INLINE_LAMBDA { return zero; };
  }
};
template <class Driver, class Kept, class S, class Unmoved>
KTE_INLINE void articulate_at_rest(const Driver& d, const Kept& kept, axis_factors<S>* factors, Unmoved& unmoved) {
  using inertia = articulated<sym3<S>, mat3<vec3<S>>, sym3<S>>;
  articulate<articulated_body<inertia, wrench<zero3, zero3>>>(
      d, kept, kept_constant<bias_motion<zero3, zero3, zero3, zero3>>{},
      [](const auto&, const auto&) KTE_INLINE_LAMBDA { return no_wrench; }, rest{}, factors, unmoved);
}
/// Outward recursion: accelerations of all bodies and axes, from the accelerations of the bases in `kept`.
template <class S>
struct acceleration_of_child {
  const axis_factors<S>* factors;
  S* change;
  template <body B, class M, class A>
  KTE_INLINE constexpr auto operator()(const B& b, const M& m, const A& parent) const {
    const motion_vector a{
        b.in(plus_cross(parent.acceleration + m.centripetal, parent.ang_acceleration, b.position())) + m.linear,
        b.in(parent.ang_acceleration) + m.angular};
    const auto found = accelerated_if_free(b, factors + b.first(), a, change + b.first());
    return body_motion{skip{}, m.ang_velocity, found.linear, found.angular};
  }
};
template <class Hand, class Driver, class Kept, class Biases, class S>
KTE_INLINE void accelerate(const Driver& d, const Kept& kept, const Biases& biases, const axis_factors<S>* factors,
                           S* change) {
  d.template descend<Hand>(kept, biases, acceleration_of_child<S>{factors, change});
}

}  // namespace kte::engine
