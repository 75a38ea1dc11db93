#pragma once

#include <kte/elements/rigid_contact.hpp>
#include <kte/static.hpp>

inline constexpr struct foot_ final : kte::contact_key<"foot"> {
} foot;
inline constexpr struct q_ final : kte::coord_key<"q"> {
} q;
inline constexpr struct base_ final : kte::frame_2D_key<"base"> {
} base;
inline constexpr struct end_ final : kte::frame_2D_key<"end"> {
} end;

/// A point on a slide that may touch the ground.
inline constexpr auto touching_slide =
    kte::chain(kte::prismatic_joint_2D(q, base, end, kte::axis::y), kte::inertia_2D(end, kte::point_mass(1.0)),
               kte::point_contact_2D(foot, base, end, kte::half_space{}, {0.5, 0}));
inline constexpr double at_zero[1]{};
