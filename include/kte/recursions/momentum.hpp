#pragma once

#include <kte/recursions/composite_body.hpp>

/// Momenta at unit rates of axes: the columns of the centroidal momentum matrix (Orin, Goswami, Lee, Autonomous Robots
/// 35, 2013, section 3).
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

}  // namespace kte::engine
