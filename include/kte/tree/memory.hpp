#pragma once

#include <kte/frames/articulated.hpp>
#include <kte/frames/motion.hpp>
#include <kte/tree/direction.hpp>
#include <kte/tree/record.hpp>

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

/// Where a body stands in its parent: the angle of the joint with `after` of its seat, the origin in axes of the
/// parent, and of `several` the rotation besides.
template <class S>
struct spot {
  turn<S> angle;
  vec3<S> position{};
  mat3<vec3<S>> rotation{};
};

/// Velocities and classical accelerations of a body at its origin, in its axes, and the wrench that it needs there.
template <class S>
struct body_motion {
  vec3<S> velocity{}, ang_velocity{}, acceleration{}, ang_acceleration{};
  dense_wrench<S> needs{};
};

/// An axis of a joint in world axes, at the origin of its body: the motion that its unit rate makes.
template <class S>
struct world_axis {
  vec3<S> linear, angular;
};
/// Axes of a body in the world; its origin seen from that of its parent, and from the world's.
template <class S>
struct world_place {
  mat3<vec3<S>> rotation;
  vec3<S> step, position;
};
/// Unit vectors of a body, as rows, and its origin from that of its parent, in axes of the world.
template <class S>
struct seen_body {
  mat3<direction<S>> units;
  direction<S> step;
};

template <class S>
using articulated_inertia = articulated<sym3<S>, mat3<vec3<S>>, sym3<S>>;
/// Articulated inertia of a body with what it takes up, and the accelerations by velocities alone.
template <class S>
struct articulated_body {
  articulated_inertia<S> inertia;  ///< where several bodies stand on it
  dense_wrench<S> load;
  vec3<S> drift, ang_drift;
};
/// What is kept of an axis on the way up: gain, what answers at once, D^-1.
template <class S>
struct axis_answer {
  dense_wrench<S> gain;
  S rate, inverse;
};

template <class P, class S>
struct memory {
  // From outside: where bodies are (`place`), rates, accelerations and forces of axes, their own masses, the motions of
  // bases.
  std::vector<spot<S>> spots;                ///< of records
  std::vector<S> rate, acceleration, force;  ///< of axes
  std::vector<P> own_mass;
  std::vector<char> yields;            ///< of records
  std::vector<int> way;                ///< records from a frame to its base (`place_ancestors`)
  std::vector<int> turning;            ///< those of them that turn about z
  std::vector<seen_body<S>> seen;      ///< all of them
  std::vector<body_motion<S>> bodies;  ///< of slots

  std::vector<world_place<S>> world;  ///< of slots
  std::vector<world_axis<S>> axes;
  std::vector<dense_composite<S>> carried;  ///< of slots
  std::vector<articulated_body<S>> articulated;
  std::vector<axis_answer<S>> answers;

  explicit memory(const forest<P>& f)
      : spots(f.records.size()),
        rate(f.axes()),
        acceleration(f.axes()),
        force(f.axes()),
        own_mass(f.axes()),
        yields(f.records.size()),
        way(f.records.size()),
        turning(f.records.size()),
        seen(f.records.size()),
        bodies(f.slots()),
        world(f.slots()),
        axes(f.axes()),
        carried(f.slots()),
        articulated(f.slots()),
        answers(f.axes()) {
    for (std::size_t i = 0; i < spots.size(); ++i) {
      const record<P>& r = f.records[i];
      spots[i].angle = {S(r.after.cos), S(r.after.sin)};
      spots[i].position = as<S>(r.position);
      yields[i] = r.yields;
    }
  }
};

}  // namespace kte::tree
