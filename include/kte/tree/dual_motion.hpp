#pragma once

#include <kte/math/dual_number.hpp>
#include <kte/recursions/world_placement.hpp>
#include <kte/tree/newton_euler.hpp>
#include <kte/tree/placement.hpp>

/// Inverse dynamics in dual numbers D, for the derivatives of elements with their own laws: the recursion of
/// recursions/newton_euler.hpp, where joints move bodies by derivatives only.
namespace kte::tree {

/// The motion of a body by its joint, in its axes: `turn`, and `step` from the origin of the parent to its own in the
/// axes of the parent. The value of a turn is zero.
template <class D>
struct dual_joint_transform {
  vec3<D> turn{}, step{};
  vec3<D> turned{};               ///< in the world
  joint_transform<D> in_duals{};  ///< for `varying` joints: axes and their derivatives
};
/// Derivatives of motions and wrenches are in axes that move with the body. A joint therefore changes only the
/// quantities that come from the bodies before it.
template <class D>
struct dual_memory {
  // Input: displacements of joints along their axes (with the value 0), rates and accelerations of axes.
  std::vector<D> shift, rate, acceleration;
  std::vector<D> force;                                   ///< by axis
  std::vector<dual_joint_transform<D>> joint_transforms;  ///< by slot
  std::vector<body_motion<D>> bodies;                     ///< by slot
  std::vector<dense_wrench<D>> loads, wrenches;           ///< by slot
  std::vector<world_place<D>> world;                      ///< by slot, without steps

  template <class P>
  explicit dual_memory(const body_tree<P>& f)
      : shift(f.axes(), D(0)),
        rate(shift),
        acceleration(shift),
        force(shift),
        joint_transforms(f.slots()),
        bodies(f.slots()),
        loads(f.slots()),
        wrenches(f.slots()),
        world(f.slots()) {}
};

// Separate functions, because the code of dual numbers is long.
template <class D>
[[gnu::noinline]] vec3<D> dual_cross(const vec3<D>& a, const vec3<D>& b) {
  return cross(a, b);
}
template <class S, class D>
[[gnu::noinline]] vec3<D> product(const mat3<vec3<S>>& r, const vec3<D>& v) {
  return {dot(r.x, v), dot(r.y, v), dot(r.z, v)};
}
/// The values without derivatives.
template <class D, class S>
vec3<D> constants(const vec3<S>& v) {
  if constexpr (std::is_same_v<S, D>)
    return {D(v.x.value), D(v.y.value), D(v.z.value)};
  else
    return {D(v.x), D(v.y), D(v.z)};
}
template <class D, class S>
mat3<vec3<D>> constants(const mat3<vec3<S>>& m) {
  return {constants<D>(m.x), constants<D>(m.y), constants<D>(m.z)};
}

/// Sets the place of a body in the world.
template <class S, class D>
void place_in_duals(const mat3<vec3<S>>& rotation, const vec3<D>& turned, world_place<D>& to) {
  const auto row = [&](const vec3<S>& axis) {
    const vec3<D> n = constants<D>(axis);
    return vec3<D>(n + dual_cross(turned, n));
  };
  const mat3<vec3<S>> axes = transpose(rotation);
  to.rotation = transpose(mat3<vec3<D>>{row(axes.x), row(axes.y), row(axes.z)});
}
/// A rotation of a body in its parent as a matrix.
template <class P, class S>
mat3<vec3<S>> rotation_in_parent(const placed<P, S>& at) {
  return {at.in(vec3<S>{S(1), S(0), S(0)}), at.in(vec3<S>{S(0), S(1), S(0)}), at.in(vec3<S>{S(0), S(0), S(1)})};
}
/// Sets the places of bases from plain numbers.
template <class P, class S, class D>
void place_bases_in_duals(const body_tree<P>& f, const memory<P, S>& m, dual_memory<D>& d) {
  for (std::size_t b = 0; b < static_cast<std::size_t>(f.bases); ++b) {
    const body_motion<S>& x = m.bodies[b];
    d.bodies[b] = {constants<D>(x.velocity), constants<D>(x.ang_velocity), constants<D>(x.acceleration),
                   constants<D>(x.ang_acceleration)};
    d.world[b].position = constants<D>(m.world[b].position);
    d.joint_transforms[b].turned = {};
    place_in_duals(m.world[b].rotation, d.joint_transforms[b].turned, d.world[b]);
  }
}
/// A body node whose joint moves it by derivatives only (engine/body.hpp): R = (1 + [turn]x), in the axes of the body.
template <class P, class S, class D>
struct dual_body {
  using scalar = D;
  const body_node<P>& r;
  const dual_joint_transform<D>& transform;
  const mat3<vec3<S>> rotation;  ///< in the parent

  KTE_INLINE int first() const { return r.first; }
  KTE_INLINE const auto& inertia() const { return r.body; }
  KTE_INLINE const vec3<D>& position() const { return transform.step; }
  vec3<D> in(const vec3<D>& u) const {
    const vec3<D> x = product(transpose(rotation), u);
    return x - dual_cross(transform.turn, x);
  }
  vec3<D> out(const vec3<D>& u) const { return product(rotation, vec3<D>(u + dual_cross(transform.turn, u))); }
  engine::motion_vector<vec3<D>, vec3<D>> along_axes(const D* x) const {
    engine::motion_vector<vec3<D>, vec3<D>> sum{};
    tree::along_axes(r, transform.in_duals, x, sum.linear, sum.angular);
    return sum;
  }
  engine::motion_vector<vec3<D>, vec3<D>> bias(const D* rate) const {
    engine::motion_vector<vec3<D>, vec3<D>> sum{};
    if (r.moves == joint::varying) {
      const auto [linear, angular] = bias_of_varying(r, transform.in_duals, rate);
      sum = {linear, angular};
    }
    return sum;
  }
  template <class Put>
  void powers_along(const dense_wrench<D>& w, const Put& put) const {
    tree::powers_along(r, transform.in_duals, w, r.axes, put);
  }
};
template <class P, class S, class D>
struct dual_bodies {
  const body_tree<P>& f;
  const memory<P, S>& m;
  const dual_memory<D>& d;

  const body_node<P>& at(int i) const { return f.nodes[static_cast<std::size_t>(i)]; }
  int count() const { return static_cast<int>(f.nodes.size()); }
  int bases() const { return f.bases; }
  int parent(int i) const { return at(i).parent; }
  bool branches(int i) const { return at(i).branches; }
  dual_body<P, S, D> body(int i) const {
    return {at(i), d.joint_transforms[static_cast<std::size_t>(f.bases + i)],
            rotation_in_parent(placed{at(i), m.joint_transforms[static_cast<std::size_t>(i)]})};
  }
  rigid_node<P> rigid(int i) const { return {at(i), f.bases + i}; }
};

/// The axes of a `varying` joint and their derivatives by coordinates, from derivatives of the next order.
template <class P, class S, class D>
void axes_in_duals(const body_node<P>& r, const joint_transform<S>& at, const D* shift,
                   std::vector<world_axis<D>>& axes) {
  const auto n = static_cast<std::size_t>(r.axes), count = n + n * n;
  axes.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    const world_axis<S>& s = at.axis(static_cast<int>(k));
    axes[k] = {constants<D>(s.linear), constants<D>(s.angular)};
    for (std::size_t j = 0; j < n; ++j) {
      const world_axis<S>& by = at.axis(static_cast<int>(n + n * k + j));
      axes[k] = {axes[k].linear + shift[j] * by.linear, axes[k].angular + shift[j] * by.angular};
    }
  }
}
/// Moves bodies by the derivatives of `shift`. Call `place_in_world` in plain numbers and place the bases first.
template <class P, class S, class D>
void place_bodies_in_duals(const body_tree<P>& f, const memory<P, S>& m, dual_memory<D>& d) {
  for (std::size_t i = 0; i < f.nodes.size(); ++i) {
    const body_node<P>& r = f.nodes[i];
    const std::size_t slot = static_cast<std::size_t>(f.bases) + i, parent = static_cast<std::size_t>(r.parent);
    dual_joint_transform<D>& transform = d.joint_transforms[slot];
    vec3<D> slide{};
    transform.turn = {};
    const D* const shift = &d.shift[static_cast<std::size_t>(r.first)];
    along_axes(r, m.joint_transforms[i], shift, slide, transform.turn);
    if (r.moves == joint::varying) [[unlikely]] {
      transform.in_duals.more.resize(1);
      axes_in_duals(r, m.joint_transforms[i], shift, transform.in_duals.more.front().axes);
    }
    transform.step = constants<D>(m.joint_transforms[i].position) +
                     product(rotation_in_parent(placed{r, m.joint_transforms[i]}), slide);
    const vec3<D>& turned = d.joint_transforms[parent].turned;
    const vec3<D> in_world = product(m.world[parent].rotation, transform.step);
    transform.turned = turned + product(m.world[slot].rotation, transform.turn);
    d.world[slot].position = d.world[parent].position + (in_world + dual_cross(turned, in_world));
    place_in_duals(m.world[slot].rotation, transform.turned, d.world[slot]);
  }
}
/// The motions of all bodies, as in tree/newton_euler.hpp; derivatives are in the axes of the bodies.
template <class P, class S, class D>
void move_in_duals(const body_tree<P>& f, const memory<P, S>& m, dual_memory<D>& d) {
  place_bodies_in_duals(f, m, d);
  const dual_bodies<P, S, D> bodies{f, m, d};
  (void)engine::motions<body_motion<D>>(engine::looped<dual_bodies<P, S, D>>{bodies}, d.bodies.data(), d.rate.data(),
                                        d.acceleration.data());
}
template <class P, class S, class D>
void transmit_in_duals(const body_tree<P>& f, const memory<P, S>& m, dual_memory<D>& d) {
  const dual_bodies<P, S, D> bodies{f, m, d};
  engine::transmit<true>(engine::looped<dual_bodies<P, S, D>>{bodies}, d.wrenches.data(),
                         engine::kept_array<body_motion<D>>{d.bodies.data() + f.bases},
                         engine::wrench_under{load_of_slot<D>{d.loads.data()}}, d.force.data());
}

}  // namespace kte::tree

namespace kte::engine {

/// See `motion_of_frame` of recursions/world_placement.hpp.
template <class S, int N, class P>
auto motion_of_frame(const tree::world_place<dual<S, N>>& place, const tree::body_motion<dual<S, N>>& b,
                     const pose<mat3<vec3<P>>, vec3<P>>& at) {
  using D = dual<S, N>;
  using tree::constants, tree::dual_cross, tree::product;
  const mat3<vec3<P>> axes = transpose(at.rotation);
  const mat3<vec3<D>>& r = place.rotation;
  const vec3<D> p = constants<D>(at.position), turning = dual_cross(b.ang_velocity, p);
  const vec3<D> faster = dual_cross(b.ang_acceleration, p) + dual_cross(b.ang_velocity, turning);
  return motion{vec3<D>(place.position + vec3<D>{dot(r.x, at.position), dot(r.y, at.position), dot(r.z, at.position)}),
                mat3<vec3<D>>{product(axes, r.x), product(axes, r.y), product(axes, r.z)},
                product(axes, vec3<D>(b.velocity + turning)),
                product(axes, b.ang_velocity),
                product(axes, vec3<D>(b.acceleration + faster)),
                product(axes, b.ang_acceleration)};
}

}  // namespace kte::engine
