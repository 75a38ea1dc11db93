#pragma once

#include <kte/contract/joint_axis.hpp>
#include <kte/frames/articulated.hpp>
#include <kte/frames/motion.hpp>
#include <kte/recursions/articulated_body.hpp>
#include <kte/recursions/world_placement.hpp>
#include <kte/tree/body_node.hpp>
#include <kte/tree/direction.hpp>

#include <Eigen/Core>

#include <span>

/// What the loops work with. A call of an algorithm writes what it reads, but for the parts that are said to come from
/// outside.
namespace kte::tree {

template <class S>
using dense_wrench = wrench<vec3<S>, vec3<S>>;
template <class S>
using dense_pose = pose<mat3<vec3<S>>, vec3<S>>;
template <class S>
using dense_composite = composite<S, vec3<S>, sym3<S>>;

/// An axis of a joint in world axes, at the origin of its body: the motion that its unit rate makes.
template <class S>
using world_axis = detail::joint_axis<S>;

/// What few joints have: a rotation matrix; of `varying` the axes, in axes of the body, with derivatives
/// (`count_of_axes`).
template <class S>
struct matrix_joint {
  mat3<vec3<S>> rotation{};
  std::vector<world_axis<S>> axes{};
};
/// Where a body stands in its parent: the angle of the joint with `after` of its placement, the origin in axes of the
/// parent, and of `several` and `varying` one `matrix_joint` (apart: so the numbers of others are one cache line).
template <class S>
struct joint_transform {
  turn<S> angle;
  vec3<S> position{};
  std::vector<matrix_joint<S>> more{};

  const mat3<vec3<S>>& rotation() const { return more.front().rotation; }
  const world_axis<S>& axis(int k) const { return more.front().axes[static_cast<std::size_t>(k)]; }
};

/// Velocities and classical accelerations of a body at its origin, in its axes.
template <class S>
using body_motion = engine::body_motion<vec3<S>, vec3<S>, vec3<S>, vec3<S>>;

template <class S>
using world_place = engine::world_placement<mat3<vec3<S>>, vec3<S>, vec3<S>>;
/// Unit vectors of a body, as rows, and its origin from that of its parent, in axes of the world.
template <class S>
struct seen_body {
  mat3<direction<S>> units;
  direction<S> step;
};

template <class S>
using articulated_inertia = articulated<sym3<S>, mat3<vec3<S>>, sym3<S>>;
template <class S>
using articulated_body = engine::articulated_body<articulated_inertia<S>, dense_wrench<S>>;
template <class S>
using bias_motion = engine::bias_motion<vec3<S>, vec3<S>, vec3<S>, vec3<S>>;
using engine::axis_factors;

template <class P, class S>
struct memory {
  // From outside: where bodies are (`place`), rates, accelerations and forces of axes, their own masses, the motions of
  // bases.
  std::vector<joint_transform<S>> joint_transforms;  ///< of body nodes
  std::vector<S> rate, acceleration, force;          ///< of axes
  std::vector<P> own_mass;
  std::vector<char> is_free;           ///< of body nodes: whether the joint is free to move
  std::vector<char> plain;             ///< of body nodes: whether it is also about z, without a mass on its coordinate
  std::vector<int> way;                ///< body nodes from a frame to its base (`place_ancestors`)
  std::vector<int> turning;            ///< those of them that turn about z
  std::vector<seen_body<S>> seen;      ///< all of them
  std::vector<body_motion<S>> bodies;  ///< of slots
  std::vector<dense_wrench<S>> loads;  ///< of slots: what elements put on bodies, at their origin
  std::vector<dense_wrench<S>> wrenches;  ///< of slots: what bodies and all that they carry need

  std::vector<world_place<S>> world;  ///< of slots
  std::vector<world_axis<S>> axes;
  std::vector<dense_composite<S>> carried;       ///< of slots
  std::vector<bias_motion<S>> biases;            ///< of slots
  std::vector<articulated_body<S>> articulated;  ///< of slots on which several bodies stand
  std::vector<axis_factors<S>> factors;          ///< of axes

  explicit memory(const body_tree<P>& f)
      : joint_transforms(f.nodes.size()),
        rate(f.axes()),
        acceleration(f.axes()),
        force(f.axes()),
        own_mass(f.axes()),
        is_free(f.nodes.size()),
        plain(f.nodes.size()),
        way(f.nodes.size()),
        turning(f.nodes.size()),
        seen(f.nodes.size()),
        bodies(f.slots()),
        loads(f.slots()),
        wrenches(f.slots()),
        world(f.slots()),
        axes(f.axes()),
        carried(f.slots()),
        biases(f.slots()),
        articulated(f.slots()),
        factors(f.axes()) {
    for (std::size_t i = 0; i < joint_transforms.size(); ++i) {
      const body_node<P>& r = f.nodes[i];
      joint_transforms[i].angle = {S(r.after.cos), S(r.after.sin)};
      joint_transforms[i].position = as<S>(r.position);
      if (r.has_matrix()) joint_transforms[i].more.resize(1);
    }
  }
};

}  // namespace kte::tree
