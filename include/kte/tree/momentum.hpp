#pragma once

#include <kte/tree/composite.hpp>

namespace kte::tree {

/// The mass, and the mass times the position of the centre of mass.
template <class S>
struct mass_moment {
  S mass{};
  vec3<S> moment{};
};
/// The mass moment of all bodies in world axes. Call `place_in_world` and `carry_bodies` first.
template <class P, class S>
mass_moment<S> weight_in_world(const body_tree<P>& f, const memory<P, S>& m) {
  mass_moment<S> sum;
  for (std::size_t b = 0; b < static_cast<std::size_t>(f.bases); ++b) {
    const auto& x = m.world[b];
    const auto& c = m.carried[b];
    sum = {sum.mass + c.mass, sum.moment + (x.rotation * c.moment + c.mass * x.position)};
  }
  return sum;
}
/// The pose of body i in the world, seen from a point.
template <class P, class S>
KTE_INLINE auto poses_from(const body_tree<P>& f, const memory<P, S>& m, const vec3<S>& point) {
  return [world = m.world.data() + f.bases, point](int i) KTE_INLINE_LAMBDA {
    return pose<const mat3<vec3<S>>&, vec3<S>>{world[i].rotation, world[i].position - point};
  };
}
/// Calls put(k, momentum at the unit rate of axis k about a point, in world axes).
template <class P, class S, class Put>
void momenta(const body_tree<P>& f, const memory<P, S>& m, const vec3<S>& about, const Put& put) {
  const one_axis_bodies<P, S> bodies(f, m.joint_transforms);
  const auto put_axis = [nodes = f.nodes.data(), put](int i, int k, const auto& h) KTE_INLINE_LAMBDA {
    put(nodes[i].first + k, dense_wrench<S>{as<S>(h.force), as<S>(h.torque)});
  };
  engine::looped<one_axis_bodies<P, S>>{bodies}.each(m.carried.data(),
                                                     engine::momenta_of_axes{poses_from(f, m, about), put_axis});
}
/// The momentum of all bodies at `rate`, about a point, with bases at rest: the sum over all joints of X I^c S q_dot,
/// with the X and I^c of recursions/composite_body.hpp.
template <class P, class S>
dense_wrench<S> momentum(const body_tree<P>& f, const memory<P, S>& m, const vec3<S>& about) {
  const one_axis_bodies<P, S> bodies(f, m.joint_transforms);
  const auto pose_of = poses_from(f, m, about);
  dense_wrench<S> sum{};
  engine::looped<one_axis_bodies<P, S>>{bodies}.each(
      m.carried.data(), [&](const auto& b, const dense_composite<S>& carried, int i) KTE_INLINE_LAMBDA {
        const auto [linear, angular] = b.along_axes(m.rate.data() + b.first());
        engine::assign(sum, sum + transmit(pose_of(i), accelerating_wrench(carried, linear, angular)));
      });
  return sum;
}

}  // namespace kte::tree
