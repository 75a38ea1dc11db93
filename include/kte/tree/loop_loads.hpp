#pragma once

#include <kte/tree/articulated.hpp>
#include <kte/tree/columns.hpp>
#include <kte/tree/jacobian.hpp>

#include <vector>

/// Loads on the bodies of a tree with known articulated inertias, and the accelerations that they cause.
namespace kte::tree {

inline constexpr std::size_t most_axes = 6;  ///< of a joint

/// The bodies on the path of loads to the bases, outermost first.
struct load_way {
  std::vector<int> nodes;
  std::vector<int> next;     ///< by place in `nodes`: the place of the parent, or -1
  std::vector<char> loaded;  ///< by place: whether loads act there, or come from a node other than the one before
};
/// Articulated inertias at some positions: joint transforms by body, factors by axis.
template <class S>
struct articulated_tree {
  std::vector<joint_transform<S>> joint_transforms;
  std::vector<axis_factors<S>> factors;
};

/// A wrench on a frame at p with rotation R, in the axes and at the origin of its parent: f = R f, n = R n + p x f.
template <class S, class R>
KTE_INLINE simd_wrench<S> seen_from(const mat3<vec3<R>>& r, const vec3<R>& p, const simd_wrench<S>& w) {
  const auto turned = [&r](const vec3<simd<S>>& u) KTE_INLINE_LAMBDA {
    return vec3<simd<S>>{r.x.x * u.x + r.x.y * u.y + r.x.z * u.z, r.y.x * u.x + r.y.y * u.y + r.y.z * u.z,
                         r.z.x * u.x + r.z.y * u.y + r.z.z * u.z};
  };
  simd_wrench<S> x{turned(w.force), turned(w.torque)};
  add_cross(x.torque, p, x.force);
  return x;
}

/// Sums of `send_to_bases`, one per load.
template <class S>
struct load_powers {
  static constexpr bool of_bases = true;
  simd<S> sum{};
  KTE_INLINE void at_axis(const simd<S>& e, const S& rate) { sum += e * rate; }
  KTE_INLINE void at_body(const simd_wrench<S>& w, const bias_motion<S>& c) {
    add(w.force, c.linear), add(w.torque, c.angular);
  }
  KTE_INLINE void at_parent(const simd_wrench<S>& w, const bias_motion<S>& c) { add(w.force, c.centripetal); }
  KTE_INLINE void at_base(const simd_wrench<S>& w, const body_motion<S>& base) {
    add(w.force, base.acceleration), add(w.torque, base.ang_acceleration);
  }

 private:
  KTE_INLINE void add(const vec3<simd<S>>& x, const vec3<S>& a) { sum += x.x * a.x + x.y * a.y + x.z * a.z; }
};
struct no_powers {
  static constexpr bool of_bases = false;
  KTE_INLINE void at_axis(const auto&, const auto&) const {}
  KTE_INLINE void at_body(const auto&, const auto&) const {}
  KTE_INLINE void at_parent(const auto&, const auto&) const {}
  KTE_INLINE void at_base(const auto&, const auto&) const {}
};

/// The effect of loads on each axis of their path: with the axis s, U D^-1 of articulated_body.hpp, and a force f on
/// the axis itself,
///
///   e = f + s.W,   W' = W - U D^-1 e          (1)
///
/// by put(axis, e). The sum of e_k D^-1 e_l over all axes is the acceleration of load k due to load l
/// (recursions/inverse_mass.hpp). `loads`: by place in `way`, if `loaded`, one load per lane; `force`: by place,
/// `most_axes` forces for the axes of the joint there, or null.
///
/// If `Sum` is `load_powers`, it adds up the powers of the loads on the accelerations of the mechanism: with the bias
/// motion c of a body and the rate u D^-1 of an axis in the working memory,
///
///   W.a + f q'' = e u D^-1 + W'.(c + X a_parent)          (2)
template <class P, class S, class Put, class Sum>
void send_to_bases(const body_tree<P>& f, const memory<P, S>& m, const load_way& way, simd_wrench<S>* loads,
                   const S* force, const Put& put, Sum& sum) {
  simd_wrench<S> load{};
  bool at_hand = false;
  for (std::size_t n = 0; n < way.nodes.size(); ++n) {
    const auto i = static_cast<std::size_t>(way.nodes[n]);
    const body_node<P>& r = f.nodes[i];
    const axis_factors<S>* const factors = &m.factors[static_cast<std::size_t>(r.first)];
    if (!at_hand)
      load = way.loaded[n] ? loads[n] : simd_wrench<S>{};
    else if (way.loaded[n])
      load.add(loads[n]);
    const joint_transform<S>& at = m.joint_transforms[i];
    const S* const forces = force + (force ? most_axes * n : 0);
    simd<S> e;
    if (m.is_free[i] && !r.has_matrix()) {
      load.power_on(r, e);
      if (force) e += forces[0];
      put(r.first, e), sum.at_axis(e, factors[0].rate);
      load.subtract(factors[0].gain, e);
    } else if (m.is_free[i]) {
      simd<S>* const all[]{&load.force.x, &load.force.y, &load.force.z, &load.torque.x, &load.torque.y, &load.torque.z};
      for (int k = r.axes; k-- > 0;) {
        if (r.moves == joint::varying)
          load.power_on(at.axis(k), e);
        else
          e = *all[r.axis[static_cast<std::size_t>(k)]];
        if (force) e += forces[k];
        put(r.first + k, e), sum.at_axis(e, factors[k].rate);
        load.subtract(factors[k].gain, e);
      }
    }
    at_hand = false;
    if (!Sum::of_bases && way.next[n] < 0) continue;
    sum.at_body(load, m.biases[static_cast<std::size_t>(f.bases) + i]);
    load.go_in(r, at);
    sum.at_parent(load, m.biases[static_cast<std::size_t>(f.bases) + i]);
    if (way.next[n] < 0) {
      sum.at_base(load, m.bodies[static_cast<std::size_t>(r.parent)]);
      continue;
    }
    at_hand = way.next[n] == static_cast<int>(n) + 1;
    if (!at_hand) loads[way.next[n]].add(load);
  }
}
template <class P, class S, class Put>
void send_to_bases(const body_tree<P>& f, const memory<P, S>& m, const load_way& way, simd_wrench<S>* loads,
                   const S* force, const Put& put) {
  const no_powers none;
  send_to_bases(f, m, way, loads, force, put, none);
}
/// The place of a frame in a body, and its velocity there at the rates of axes, in the axes of the body.
template <class S>
struct moving_place {
  mat3<vec3<S>> rotation;
  vec3<S> position, velocity;
};
/// The place and velocity of a frame in its base, or in the body of slot `top` if that carries it. Returns the slot.
template <class P, class S>
int place_and_velocity(const body_tree<P>& f, const memory<P, S>& m, const frame_place<P>& frame, int top,
                       moving_place<S>& x) {
  dense_pose<S> at;
  direction<S> velocity{};
  const auto move = [&velocity, rate = m.rate.data()](int k, const direction<S>& linear, const direction<S>&)
                        KTE_INLINE_LAMBDA { velocity = velocity + rate[k] * linear; };
  const int slot = jacobian_columns(f, m, frame, at, move, top);
  x = {at.rotation, at.position, at.rotation * components<S>(velocity)};
  return slot;
}
/// Writes to `acceleration` the accelerations of axes, from rest and on bases at rest, for the part `rate` of their
/// factors: D^-1 e of (1).
template <class P, class S>
void accelerate_from_rest(const body_tree<P>& f, memory<P, S>& m,
                          const std::vector<joint_transform<S>>& joint_transforms, const axis_factors<S>* factors) {
  using hand = engine::body_motion<skip, zero3, vec3<S>, vec3<S>>;
  for (std::size_t b = 0; b < static_cast<std::size_t>(f.bases); ++b) m.bodies[b] = {};
  const articulated_bodies<P, S> bodies(f, m, joint_transforms);
  engine::accelerate<hand>(engine::looped{bodies}, m.bodies.data(),
                           engine::kept_constant<engine::bias_motion<zero3, zero3, zero3, zero3>>{}, factors,
                           m.acceleration.data());
}

}  // namespace kte::tree
