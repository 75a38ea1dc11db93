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

/// The working memory of the loops. An algorithm writes the parts that it reads, except for those marked as input.
namespace kte::tree {

template <class S>
using dense_wrench = wrench<vec3<S>, vec3<S>>;
template <class S>
using dense_pose = pose<mat3<vec3<S>>, vec3<S>>;
template <class S>
using dense_composite = composite<S, vec3<S>, sym3<S>>;

/// An axis of a joint in world axes, at the origin of its body: the motion at its unit rate.
template <class S>
using world_axis = detail::joint_axis<S>;

/// The data of rare joints: a rotation matrix; for `varying` also the axes, in the axes of the body, with derivatives
/// (`count_of_axes`).
template <class S>
struct matrix_joint {
  mat3<vec3<S>> rotation{};
  std::vector<world_axis<S>> axes{};
};
/// The pose of a body in its parent: the angle of the joint including `after` of its placement, the origin in the axes
/// of the parent, and for `several` and `varying` one `matrix_joint`. It is stored separately, so that the numbers of
/// other joints fit into one cache line.
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
/// The unit vectors of a body, as rows, and the vector from the origin of its parent to its own, in world axes.
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
  // Input: the places of bodies, rates, accelerations and forces of axes, their own masses, and the motions of bases.
  std::vector<joint_transform<S>> joint_transforms;  ///< by body node
  std::vector<S> rate, acceleration, force;          ///< by axis
  std::vector<P> own_mass;
  std::vector<char> is_free;  ///< by body node: whether the joint is free to move
  std::vector<char> plain;   ///< by body node: whether the joint is free, about z, and without a mass on its coordinate
  std::vector<int> way;      ///< body nodes from a frame to its base (`place_ancestors`)
  std::vector<int> turning;  ///< those of `way` that rotate about z
  std::vector<seen_body<S>> seen;         ///< of all body nodes
  std::vector<body_motion<S>> bodies;     ///< by slot
  std::vector<dense_wrench<S>> loads;     ///< by slot: loads of elements on bodies, at their origin
  std::vector<dense_wrench<S>> wrenches;  ///< by slot: wrenches that bodies with all that they carry need

  std::vector<world_place<S>> world;  ///< by slot
  std::vector<world_axis<S>> axes;
  std::vector<dense_composite<S>> carried;       ///< by slot
  std::vector<bias_motion<S>> biases;            ///< by slot
  std::vector<articulated_body<S>> articulated;  ///< by slot, for slots with several children
  std::vector<axis_factors<S>> factors;          ///< by axis

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
