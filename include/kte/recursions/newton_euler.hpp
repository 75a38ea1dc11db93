#pragma once

#include <kte/engine/body.hpp>
#include <kte/math/rigid_body.hpp>

#include <type_traits>

/// The recursive Newton-Euler algorithm (RNEA; Luh, Walker, Paul 1980; Featherstone 2008, section 5.3), with classical
/// accelerations in the axes of each body.
namespace kte::engine {

/// The motion of a body at its origin, in its axes. Linear velocities are skipped if unused.
template <class V, class W, class A, class AL>
struct body_motion {
  using geometry = body_motion;
  V velocity;
  W ang_velocity;
  A acceleration;
  AL ang_acceleration;
};
template <class V, class W, class A, class AL>
body_motion(V, W, A, AL) -> body_motion<V, W, A, AL>;

/// The motion of a body from that of its parent, v, w, a, al, with v_J, w_J = S q_dot:
///
///   v_i  = R^T (v + w x p) + v_J                                                             (1)
///   w_i  = R^T w + w_J,   al_i = R^T al + (R^T w) x w_J + S q_ddot + dS/dt q_dot                            (2)
///   a_i  = R^T (a + al x p + w x (w x p)) + 2 (R^T w) x v_J + w_J x v_J + S q_ddot + dS/dt q_dot            (3)
template <body B, class M, class S>
KTE_INLINE constexpr auto moved(const B& b, const M& parent, const S* rate, const S* change) {
  const auto& [v, w, a, al] = parent;
  const auto& p = b.position();
  const auto [v_j, w_j] = b.along_axes(rate);
  const auto [a_j, al_j] = b.along_axes(change) + bias_along_axes(b, rate);
  const auto w_in = b.in(w);
  return body_motion{b.in(plus_cross(v, w, p)) + v_j, w_in + w_j,
                     b.in(plus_cross(plus_cross(a, al, p), w, cross(w, p))) +
                         ((constant<2>{} * cross(w_in, v_j) + cross(w_j, v_j)) + a_j),
                     b.in(al) + (cross(w_in, w_j) + al_j)};
}
/// The velocities alone: (1), and w_i of (2).
template <body B, class M, class S>
KTE_INLINE constexpr auto moved_at_rate(const B& b, const M& parent, const S* rate) {
  const auto [v_j, w_j] = b.along_axes(rate);
  return body_motion{b.in(plus_cross(parent.velocity, parent.ang_velocity, b.position())) + v_j,
                     b.in(parent.ang_velocity) + w_j, skip{}, skip{}};
}
/// The wrench that gives a body its motion (Newton and Euler), at its origin:
///
///   f = m (a + al x c + w x (w x c)),   n = I al + w x I w + c x f          (4)
template <class B, class M>
KTE_INLINE constexpr auto body_wrench(const B& b, const M& m) {
  const auto& [mass, c, inertia, published] = b.inertia();
  const auto& [v, w, a, al] = m;
  const auto f = mass * plus_cross(plus_cross(a, al, c), w, cross(w, c));
  return wrench{fresh(f), plus_cross(plus_cross(inertia * al, w, inertia * w), c, f)};
}

/// Outward recursion (1) to (3): the motions of all bodies from the rates and accelerations of all axes.
template <class Hand, class Driver, class Kept, class S>
KTE_INLINE auto motions(const Driver& d, const Kept& kept, const S* rate, const S* change) {
  return d.template outward<Hand>(kept, [=](const body auto& b, const auto& parent) KTE_INLINE_LAMBDA {
    return moved(b, parent, rate + b.first(), change + b.first());
  });
}
/// Inward recursion: the wrenches own(body, motion) are summed along the tree; `force` receives for each axis the power
/// of the wrench that its joint transmits.
template <bool Keep, class Driver, class Kept, class Motions, class Own, class S>
KTE_INLINE void transmit(const Driver& d, const Kept& kept, const Motions& m, const Own& own, S* force) {
  d.template inward<Keep, wrench<vec3<S>, vec3<S>>, false>(
      kept, m, own,
      [=](const body auto& b, const auto& w, bool) KTE_INLINE_LAMBDA {
        S* const to = force + b.first();
        b.powers_along(w, [to](int k, const auto& x) KTE_INLINE_LAMBDA { to[k] = as<S>(x); });
        return fresh(w);
      },
      [](const body auto& b, const auto&, const auto& w) KTE_INLINE_LAMBDA { return pulled_back(b, w); });
}
/// `own` of `transmit`: the wrench of a moving body, or none if there are no motions, minus the load load(body) on it.
template <class Load>
struct wrench_under {
  Load load;
  template <class B, class M>
  KTE_INLINE constexpr auto operator()(const B& b, const M& m) const {
    if constexpr (std::is_same_v<M, no_value>)
      return no_wrench - load(b);
    else
      return body_wrench(b, m) - load(b);
  }
};
template <class Load>
wrench_under(Load) -> wrench_under<Load>;
/// Stands for no loads.
struct no_load {
  template <class B>
  KTE_INLINE constexpr auto operator()(const B&) const {
    return no_wrench;
  }
};

}  // namespace kte::engine
