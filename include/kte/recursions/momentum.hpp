#pragma once

#include <kte/recursions/composite_body.hpp>

/// Momenta of bodies. At unit rates of axes: the columns of the centroidal momentum matrix (Orin, Goswami, Lee,
/// Autonomous Robots 35, 2013, section 3).
namespace kte::engine {

/// For a body that carries the composite inertia I^c, put(place, k, momentum) for each axis k of its joint:
///
///   X I^c s_k          (1)
///
/// X transforms a momentum, as a wrench, by pose(place) of the body, whose position is from the reference point.
template <class Pose, class Put>
struct momenta_of_axes {
  Pose pose;
  Put put;
  template <body B, class I, class Place>
  KTE_INLINE constexpr auto operator()(const B& b, const I& inertia, const Place& place) const {
    each_axis(b, [&](const auto& k, const auto& s) KTE_INLINE_LAMBDA {
      put(place, k, transmit(pose(place), accelerating_wrench(inertia, s.linear, s.angular)));
    });
    return fresh(inertia);
  }
};
template <class Pose, class Put>
momenta_of_axes(Pose, Put) -> momenta_of_axes<Pose, Put>;
/// put(momentum) by the motion of its joint alone, v_J, w_J = rate(body):
///
///   X I^c (v_J, w_J)          (2)
///
/// The sum over all bodies is the momentum with bases at rest. For static chains the momenta of the bodies at their
/// velocities take half the time (`momentum_at_base`).
template <class Pose, class Rate, class Put>
struct momenta_of_joints {
  Pose pose;
  Rate rate;
  Put put;
  template <body B, class I, class Place>
  KTE_INLINE constexpr auto operator()(const B& b, const I& inertia, const Place& place) const {
    const auto s = rate(b);
    put(transmit(pose(place), accelerating_wrench(inertia, s.linear, s.angular)));
    return fresh(inertia);
  }
};
template <class Pose, class Rate, class Put>
momenta_of_joints(Pose, Rate, Put) -> momenta_of_joints<Pose, Rate, Put>;

}  // namespace kte::engine
