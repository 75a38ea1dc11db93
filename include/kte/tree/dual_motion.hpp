#pragma once

#include <kte/math/dual_number.hpp>
#include <kte/tree/frame_motion.hpp>
#include <kte/tree/newton_euler.hpp>

/// Inverse dynamics in dual numbers D, for derivatives where elements have laws of their own: tree/newton_euler.hpp
/// with as little code as there can be.
namespace kte::tree {

/// Of a body, in its axes: how far its joint turns it, and from the origin of its parent to its own in axes of that.
/// Turns have no value.
template <class D>
struct dual_seat {
  vec3<D> turn{}, step{};
  vec3<D> turned{};  ///< in the world
};
/// Derivatives of motions and wrenches are those that their body sees, in axes that move with it: a joint changes
/// nothing beyond it but what comes from before it.
template <class D>
struct dual_memory {
  // From outside: how far joints move along their axes (of value nothing), rates and accelerations of axes.
  std::vector<D> shift, rate, acceleration;
  std::vector<D> force;                ///< on axes
  std::vector<dual_seat<D>> seats;     ///< of slots
  std::vector<body_motion<D>> bodies;  ///< likewise
  std::vector<world_place<D>> world;   ///< likewise, but for steps

  template <class P>
  explicit dual_memory(const forest<P>& f)
      : shift(f.axes(), D(0)),
        rate(shift),
        acceleration(shift),
        force(shift),
        seats(f.slots()),
        bodies(f.slots()),
        world(f.slots()) {}
};

// In functions of their own: dual numbers are long.
template <class D>
[[gnu::noinline]] vec3<D> dual_cross(const vec3<D>& a, const vec3<D>& b) {
  return cross(a, b);
}
template <class S, class D>
[[gnu::noinline]] vec3<D> product(const mat3<vec3<S>>& r, const vec3<D>& v) {
  return {dot(r.x, v), dot(r.y, v), dot(r.z, v)};
}
/// The values alone.
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

/// Where a body stands in the world.
template <class S, class D>
void place_in_duals(const mat3<vec3<S>>& rotation, const vec3<D>& turned, world_place<D>& to) {
  const auto row = [&](const vec3<S>& axis) {
    const vec3<D> n = constants<D>(axis);
    return vec3<D>(n + dual_cross(turned, n));
  };
  const mat3<vec3<S>> axes = transpose(rotation);
  to.rotation = transpose(mat3<vec3<D>>{row(axes.x), row(axes.y), row(axes.z)});
}
/// As `motion_of_frame` of tree/frame_motion.hpp.
template <class S, int N, class P>
auto motion_of_frame(const world_place<dual<S, N>>& place, const body_motion<dual<S, N>>& b,
                     const pose<mat3<vec3<P>>, vec3<P>>& at) {
  using D = dual<S, N>;
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
/// A rotation of a body in its parent as a matrix.
template <class P, class S>
mat3<vec3<S>> rotation_in_parent(const placed<P, S>& at) {
  return {at.in(vec3<S>{S(1), S(0), S(0)}), at.in(vec3<S>{S(0), S(1), S(0)}), at.in(vec3<S>{S(0), S(0), S(1)})};
}
/// Bases where they are in plain numbers.
template <class P, class S, class D>
void place_bases_in_duals(const forest<P>& f, const memory<P, S>& m, dual_memory<D>& d) {
  for (std::size_t b = 0; b < static_cast<std::size_t>(f.bases); ++b) {
    const body_motion<S>& x = m.bodies[b];
    d.bodies[b] = {constants<D>(x.velocity), constants<D>(x.ang_velocity), constants<D>(x.acceleration),
                   constants<D>(x.ang_acceleration)};
    d.world[b].position = constants<D>(m.world[b].position);
    d.seats[b].turned = {};
    place_in_duals(m.world[b].rotation, d.seats[b].turned, d.world[b]);
  }
}
/// The motions of all bodies from those of axes, by (2), (3) of tree/newton_euler.hpp, and what they need for them:
/// after `place_in_world` in plain numbers, and with bases in place.
template <class P, class S, class D>
void move_in_duals(const forest<P>& f, const memory<P, S>& m, dual_memory<D>& d) {
  for (std::size_t i = 0; i < f.records.size(); ++i) {
    const record<P>& r = f.records[i];
    const std::size_t slot = static_cast<std::size_t>(f.bases) + i, parent = static_cast<std::size_t>(r.parent);
    const mat3<vec3<S>> out = rotation_in_parent(placed{r, m.spots[i]}), in = transpose(out);
    const body_motion<D>& on = d.bodies[parent];
    dual_seat<D>& seat = d.seats[slot];
    vec3<D> slide{}, slides{}, turns{}, faster{}, turns_faster{};
    seat.turn = {};
    along_axes(r, &d.shift[static_cast<std::size_t>(r.first)], slide, seat.turn);
    along_axes(r, &d.rate[static_cast<std::size_t>(r.first)], slides, turns);
    along_axes(r, &d.acceleration[static_cast<std::size_t>(r.first)], faster, turns_faster);
    const vec3<D> step = constants<D>(m.spots[i].position) + product(out, slide);
    seat.step = step;
    const vec3<D> passing = dual_cross(on.ang_velocity, step);
    const auto seen = [&in, &seat](const vec3<D>& v) {  // by the body
      const vec3<D> x = product(in, v);
      return vec3<D>(x - dual_cross(seat.turn, x));
    };
    const vec3<D> w = seen(on.ang_velocity);
    body_motion<D>& x = d.bodies[slot];
    x.velocity = seen(on.velocity + passing) + slides;
    x.ang_velocity = w + turns;
    x.ang_acceleration = seen(on.ang_acceleration) + (dual_cross(w, turns) + turns_faster);
    x.acceleration =
        seen(on.acceleration + (dual_cross(on.ang_acceleration, step) + dual_cross(on.ang_velocity, passing))) +
        (dual_cross(w, slides) + dual_cross(x.ang_velocity, slides) + faster);
    x.needs = wrench_of(r.body, x.acceleration, x.ang_velocity, x.ang_acceleration);
    const vec3<D>& turned = d.seats[parent].turned;
    const vec3<D> in_world = product(m.world[parent].rotation, step);
    seat.turned = turned + product(m.world[slot].rotation, seat.turn);
    d.world[slot].position = d.world[parent].position + (in_world + dual_cross(turned, in_world));
    place_in_duals(m.world[slot].rotation, seat.turned, d.world[slot]);
  }
}

/// What bodies need goes in along the tree; of an axis its power into `force`.
template <class P, class S, class D>
void take_needs_in_duals(const forest<P>& f, const memory<P, S>& m, dual_memory<D>& d) {
  for (std::size_t i = f.records.size(); i-- > 0;) {
    const record<P>& r = f.records[i];
    const std::size_t slot = static_cast<std::size_t>(f.bases) + i;
    const dual_seat<D>& seat = d.seats[slot];
    const dense_wrench<D>& x = d.bodies[slot].needs;
    D* const power = &d.force[static_cast<std::size_t>(r.first)];
    powers_along(r, x, r.axes, [power](int k, const D& p) { power[k] = p; });
    if (r.parent < f.bases) continue;
    const mat3<vec3<S>> out = rotation_in_parent(placed{r, m.spots[i]});
    const auto seen = [&out, &seat](const vec3<D>& v) {  // by the parent
      return product(out, vec3<D>(v + dual_cross(seat.turn, v)));
    };
    dense_wrench<D>& to = d.bodies[static_cast<std::size_t>(r.parent)].needs;
    const vec3<D> force = seen(x.force);
    to = {to.force + force, to.torque + (seen(x.torque) + dual_cross(seat.step, force))};
  }
}

}  // namespace kte::tree
