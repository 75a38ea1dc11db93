#pragma once

#include <kte/static.hpp>

/// The Universal Robots UR5, from its published parameters: six revolute joints about z and y. m, kg, kg m^2.
namespace robots {

namespace ur5_names {
// clang-format off
inline constexpr struct q1_ final : kte::coord_key<"shoulder_pan"> {} q1;
inline constexpr struct q2_ final : kte::coord_key<"shoulder_lift"> {} q2;
inline constexpr struct q3_ final : kte::coord_key<"elbow"> {} q3;
inline constexpr struct q4_ final : kte::coord_key<"wrist_1"> {} q4;
inline constexpr struct q5_ final : kte::coord_key<"wrist_2"> {} q5;
inline constexpr struct q6_ final : kte::coord_key<"wrist_3"> {} q6;
inline constexpr struct base_ final : kte::frame_3D_key<"base"> {} base;
inline constexpr struct mount1_ final : kte::frame_3D_key<"mount1"> {} mount1;
inline constexpr struct mount2_ final : kte::frame_3D_key<"mount2"> {} mount2;
inline constexpr struct mount3_ final : kte::frame_3D_key<"mount3"> {} mount3;
inline constexpr struct mount4_ final : kte::frame_3D_key<"mount4"> {} mount4;
inline constexpr struct mount5_ final : kte::frame_3D_key<"mount5"> {} mount5;
inline constexpr struct mount6_ final : kte::frame_3D_key<"mount6"> {} mount6;
inline constexpr struct link1_ final : kte::frame_3D_key<"shoulder_link"> {} link1;
inline constexpr struct link2_ final : kte::frame_3D_key<"upper_arm_link"> {} link2;
inline constexpr struct link3_ final : kte::frame_3D_key<"forearm_link"> {} link3;
inline constexpr struct link4_ final : kte::frame_3D_key<"wrist_1_link"> {} link4;
inline constexpr struct link5_ final : kte::frame_3D_key<"wrist_2_link"> {} link5;
inline constexpr struct link6_ final : kte::frame_3D_key<"wrist_3_link"> {} link6;
inline constexpr struct tool_ final : kte::frame_3D_key<"tool"> {} tool; }  // namespace ur5_names

inline constexpr auto ur5 = [] {
  using namespace ur5_names;
  using namespace kte;
  // The published quarter turns are of 1.57079632679 rad, so their cosine is no zero.
  constexpr double c = 4.896638650109253e-12;
  constexpr mat3 pitch{vec3{c, zero, one}, axis::y, vec3{minus_one, zero, c}};
  constexpr mat3 roll{axis::x, vec3{zero, c, one}, vec3{zero, minus_one, c}};
  constexpr auto wrist = diagonal(0.111172755531, 0.111172755531, 0.21942);
  return chain(rigid_link_3D(base, mount1, along_z(0.089159)), revolute_joint_3D(q1, mount1, link1),
               inertia_3D(link1, rigid_body{3.7, zero3{}, diagonal(0.010267495893, 0.010267495893, 0.00666)}),

               rigid_link_3D(link1, mount2, along_y(0.13585), pitch), revolute_joint_3D(q2, mount2, link2, axis::y),
               inertia_3D(link2, rigid_body{8.393, along_z(0.28), diagonal(0.22689067591, 0.22689067591, 0.0151074)}),

               rigid_link_3D(link2, mount3, vec3{zero, -0.1197, 0.425}), revolute_joint_3D(q3, mount3, link3, axis::y),
               inertia_3D(link3, rigid_body{2.275, along_z(0.25), diagonal(0.049443313556, 0.049443313556, 0.004095)}),

               rigid_link_3D(link3, mount4, along_z(0.39225), pitch), revolute_joint_3D(q4, mount4, link4, axis::y),
               inertia_3D(link4, rigid_body{1.219, zero3{}, wrist}),

               rigid_link_3D(link4, mount5, along_y(0.093)), revolute_joint_3D(q5, mount5, link5),
               inertia_3D(link5, rigid_body{1.219, zero3{}, wrist}),

               rigid_link_3D(link5, mount6, along_z(0.09465)), revolute_joint_3D(q6, mount6, link6, axis::y),
               inertia_3D(link6, rigid_body{0.1879, zero3{}, diagonal(0.0171364731454, 0.0171364731454, 0.033822)}),

               rigid_link_3D(link6, tool, along_y(0.0823), roll))
      .gravity(along_z(-9.81));
}();

}  // namespace robots
