#pragma once

#include <kte/kte.hpp>
#include <kte/loops.hpp>

/// A four-bar as a static chain.
namespace kte::test::loops::with_keys {

inline constexpr struct base_ final : frame_2D_key<"base"> {
} base;
inline constexpr struct crank_ final : coord_key<"crank"> {
} crank;
inline constexpr struct coupler_ final : coord_key<"coupler"> {
} coupler;
inline constexpr struct rocker_ final : coord_key<"rocker"> {
} rocker;
inline constexpr struct a_ final : frame_2D_key<"a"> {
} a;
inline constexpr struct A_ final : frame_2D_key<"A"> {
} A;
inline constexpr struct b_ final : frame_2D_key<"b"> {
} b;
inline constexpr struct B1_ final : frame_2D_key<"B1"> {
} B1;
inline constexpr struct r_ final : frame_2D_key<"r"> {
} r;
inline constexpr struct B2_ final : frame_2D_key<"B2"> {
} B2;
inline constexpr struct pin_ final : loop_key<"pin"> {
} pin;

inline constexpr auto body = planar_body(1.0, 0.02, along_x(0.3));
inline constexpr auto four_bar =
    chain(revolute_joint_2D(crank, base, a), inertia_2D(a, body), rigid_link_2D(a, A, along_x(0.4)),
          revolute_joint_2D(coupler, A, b), inertia_2D(b, body), rigid_link_2D(b, B1, along_x(1.1)),
          revolute_joint_2D(rocker, base, r).at(vec2<>{1, 0}), inertia_2D(r, body), rigid_link_2D(r, B2, along_x(0.8)),
          coincident_points_2D(pin, B1, B2))
        .gravity(along_y(-9.81));
inline const Eigen::Vector3d guess(1.1, -0.5, 1.5);

}  // namespace kte::test::loops::with_keys
