#pragma once

#include <kte/recursions/force_variations.hpp>
#include <kte/tree/coriolis.hpp>
#include <kte/tree/newton_euler.hpp>
#include <kte/tree/simd.hpp>

/// Derivatives of inverse dynamics in world axes at the origin of each body (`vary_forces_in_world` of
/// recursions/force_variations.hpp). A spatial motion is (linear,
/// angular): the velocity of the body's point at the origin, and its angular velocity. Each body has an observer who
/// moves with its origin at its present velocity, so that no large velocities are subtracted from each other.
namespace kte::tree {

/// Body nodes as joints in the world.
template <class P, class S>
class nodes_in_world {
 public:
  nodes_in_world(const body_tree<P>& f, const memory<P, S>& m)
      : nodes_(f.nodes.data()),
        places_(m.world.data() + f.bases),
        axes_(m.axes.data()),
        count_(static_cast<int>(f.nodes.size())),
        bases_(f.bases) {}
  KTE_INLINE int count() const { return count_; }
  KTE_INLINE int parent(int i) const { return nodes_[i].parent - bases_; }  // bases come first
  KTE_INLINE int first(int i) const { return nodes_[i].first; }
  KTE_INLINE int axes(int i) const { return nodes_[i].axes; }
  KTE_INLINE bool slides(int i) const { return nodes_[i].moves != joint::revolute; }
  KTE_INLINE const world_axis<S>& axis(int k) const { return axes_[k]; }
  KTE_INLINE const vec3<S>& step(int i) const { return places_[i].step; }

 private:
  const body_node<P>* nodes_;
  const world_place<S>* places_;
  const world_axis<S>* axes_;
  int count_, bases_;
};

template <class S>
struct spatial_motion {
  vec3<S> linear{}, angular{};
  KTE_INLINE friend spatial_motion operator+(const spatial_motion& a, const spatial_motion& b) {
    return {a.linear + b.linear, a.angular + b.angular};
  }
};
/// The rate of change of a motion b that moves with a.
template <class S>
KTE_INLINE spatial_motion<S> cross(const spatial_motion<S>& a, const spatial_motion<S>& b) {
  return {cross(a.angular, b.linear) + cross(a.linear, b.angular), cross(a.angular, b.angular)};
}

/// Four vectors side by side, in memory.
template <class S>
struct four_vectors {
  std::array<S, 4> x{}, y{}, z{};

  KTE_INLINE void set(std::size_t i, const vec3<S>& v) { x[i] = v.x, y[i] = v.y, z[i] = v.z; }
  KTE_INLINE vec3<S> get(std::size_t i) const { return {x[i], y[i], z[i]}; }
};
/// Four numbers in a register.
template <class S>
struct four_lanes {
  using type = simd<S, 4>;
  KTE_INLINE static void load(vec3<type>& to, const four_vectors<S>& from) {
    tree::load<S>(to.x, from.x.data()), tree::load<S>(to.y, from.y.data()), tree::load<S>(to.z, from.z.data());
  }
  /// (x_2, x_2, x_2, x_3)
  KTE_INLINE static void repeat_third(const type& x, type& y) {
    if constexpr (requires { x.n; })
      y.n = {x[2], x[2], x[2], x[3]};
    else
      y = __builtin_shufflevector(x, x, 2, 2, 2, 3);
  }
};

/// For an axis s of a body with velocity v, whose parent has v_p, a_p (all at the origin of the body):
///
///   s' = v_p x s,   s'' = a_p x s + v_p x s',   mixed = s' + v x s          (1)
///
/// stored side by side as the forces need them: (s'', mixed, s), and for angular parts also s'.
template <class S>
struct axis_variation {
  four_vectors<S> linear, angular;  ///< (s'', mixed, s, 0 or s')
  four_vectors<S> turning;          ///< (s', s, 0, 0), angular

  KTE_INLINE void set(const spatial_motion<S>& second, const spatial_motion<S>& mixed, const spatial_motion<S>& s,
                      const vec3<S>& first) {
    linear.set(0, second.linear), linear.set(1, mixed.linear), linear.set(2, s.linear);
    angular.set(0, second.angular), angular.set(1, mixed.angular), angular.set(2, s.angular), angular.set(3, first);
    turning.set(0, first), turning.set(1, s.angular);
  }
  KTE_INLINE spatial_motion<S> axis() const { return {linear.get(2), angular.get(2)}; }
};
/// For a body with its subtree: inertia M, and 2 B, which acts on angular parts only,
///
///   B = (v x* M - M v x + (M v) x*) / 2          (2)
///
/// `passing`: the velocity u of its origin relative to the observer of its parent. `ways`: (p, p, p, 2 u), with the
/// displacement p of the origin.
template <class S>
struct body_variation {
  vec3<S> ang_velocity, acceleration, ang_acceleration, passing;
  four_vectors<S> ways;
  dense_composite<S> inertia;
  vec3<S> force;         ///< 2 B gives the force `force` x w
  mat3<vec3<S>> torque;  ///< and the torque `torque` w
};
using engine::cross_twice, engine::gyroscopic;
template <class S>
struct variation_memory {
  std::vector<axis_variation<S>> axes;
  std::vector<body_variation<S>> bodies;  ///< of slots
};

/// (1), (2) for each body alone. Call `move_bodies`, `place_in_world` first.
template <class P, class S>
void start_variations(const body_tree<P>& f, const memory<P, S>& m, variation_memory<S>& v) {
  const std::size_t bases = static_cast<std::size_t>(f.bases);
  const auto take_motion = [&](std::size_t slot) {
    const mat3<vec3<S>>& r = m.world[slot].rotation;
    const body_motion<S>& b = m.bodies[slot];
    body_variation<S>& x = v.bodies[slot];
    x.ang_velocity = r * b.ang_velocity, x.acceleration = r * b.acceleration;
    x.ang_acceleration = r * b.ang_acceleration;
  };
  for (std::size_t b = 0; b < bases; ++b) take_motion(b);
  for (std::size_t i = 0; i < f.nodes.size(); ++i) {
    const body_node<P>& r = f.nodes[i];
    const std::size_t slot = bases + i;
    const world_place<S>& place = m.world[slot];
    take_motion(slot);
    body_variation<S>& b = v.bodies[slot];
    const body_variation<S>& parent = v.bodies[static_cast<std::size_t>(r.parent)];
    const vec3<S>& w_p = parent.ang_velocity;
    vec3<S> slides{};  // of the joint
    if (r.moves != joint::revolute)
      for (int k = r.first; k < r.first + r.axes; ++k)
        slides = slides + m.rate[static_cast<std::size_t>(k)] * m.axes[static_cast<std::size_t>(k)].linear;
    const vec3<S> turned = cross(w_p, place.step);
    b.passing = turned + slides;
    for (std::size_t n = 0; n < 3; ++n) b.ways.set(n, place.step);
    b.ways.set(3, S(2) * b.passing);
    const spatial_motion<S> v_p{-slides, w_p};
    const spatial_motion<S> a_p{
        parent.acceleration + (cross(parent.ang_acceleration, place.step) + cross(w_p, vec3<S>(turned + slides))),
        parent.ang_acceleration};
    for (int k = r.first; k < r.first + r.axes; ++k) {
      const world_axis<S>& s = m.axes[static_cast<std::size_t>(k)];
      axis_variation<S>& x = v.axes[static_cast<std::size_t>(k)];
      const spatial_motion<S> axis{s.linear, s.angular};
      if (r.moves == joint::revolute) {  // linear parts are zero; w x s is s'
        const vec3<S> first = cross(w_p, s.angular);
        x.set({cross(a_p.linear, s.angular), cross(a_p.angular, s.angular) + cross(w_p, first)}, {{}, S(2) * first},
              axis, first);
        continue;
      }
      const spatial_motion<S> first = cross(v_p, axis);
      x.set(cross(a_p, axis) + cross(v_p, first), first + cross(spatial_motion<S>{{}, b.ang_velocity}, axis), axis,
            first.angular);  // (1)
    }
    const rigid_body<P, vec3<P>, sym3<P>>& body = r.body;
    const vec3<S> c = place.rotation * body.com;
    const vec3<S>& w = b.ang_velocity;
    const sym3<S> inertia = congruence(place.rotation, body.inertia);
    b.inertia = {S(body.mass), body.mass * c, detail::shifted(inertia, c, detail::half(S(body.mass)) * c)};
    b.force = S(-2) * (body.mass * cross(w, c));
    b.torque = gyroscopic(w, inertia) + cross_twice(c, b.force);
  }
}

/// The derivatives of the forces on all axes, put(j, i, by_q, by_v, by_a): of the force on axis j by coordinate i. Call
/// `transmit_wrenches`, `start_variations` first.
template <class P, class S, class Put>
void vary_forces(const body_tree<P>& f, const memory<P, S>& m, variation_memory<S>& v, const Put& put) {
  engine::vary_forces_in_world<four_lanes<S>, S>(
      nodes_in_world<P, S>(f, m), v.axes.data(), v.bodies.data() + f.bases,
      [&](int i) KTE_INLINE_LAMBDA {
        const auto slot = static_cast<std::size_t>(f.bases + i);
        const mat3<vec3<S>>& r = m.world[slot].rotation;
        return dense_wrench<S>{r * m.wrenches[slot].force, r * m.wrenches[slot].torque};
      },
      put);
}

}  // namespace kte::tree
