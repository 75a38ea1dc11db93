#pragma once

#include <kte/static.hpp>

/// The KUKA LBR iiwa14, from its published parameters: seven revolute joints about z. m, kg, kg m^2.
/// Joint frames are turned against each other by quarter turns, which are typed constants and cost nothing.
namespace robots {

namespace iiwa14_names {
// clang-format off
inline constexpr struct q1_ final : kte::coord_key<"q1"> {} q1;
inline constexpr struct q2_ final : kte::coord_key<"q2"> {} q2;
inline constexpr struct q3_ final : kte::coord_key<"q3"> {} q3;
inline constexpr struct q4_ final : kte::coord_key<"q4"> {} q4;
inline constexpr struct q5_ final : kte::coord_key<"q5"> {} q5;
inline constexpr struct q6_ final : kte::coord_key<"q6"> {} q6;
inline constexpr struct q7_ final : kte::coord_key<"q7"> {} q7;
inline constexpr struct base_ final : kte::frame_3D_key<"base"> {} base;
inline constexpr struct mount1_ final : kte::frame_3D_key<"mount1"> {} mount1;
inline constexpr struct mount2_ final : kte::frame_3D_key<"mount2"> {} mount2;
inline constexpr struct mount3_ final : kte::frame_3D_key<"mount3"> {} mount3;
inline constexpr struct mount4_ final : kte::frame_3D_key<"mount4"> {} mount4;
inline constexpr struct mount5_ final : kte::frame_3D_key<"mount5"> {} mount5;
inline constexpr struct mount6_ final : kte::frame_3D_key<"mount6"> {} mount6;
inline constexpr struct mount7_ final : kte::frame_3D_key<"mount7"> {} mount7;
inline constexpr struct link1_ final : kte::frame_3D_key<"link1"> {} link1;
inline constexpr struct link2_ final : kte::frame_3D_key<"link2"> {} link2;
inline constexpr struct link3_ final : kte::frame_3D_key<"link3"> {} link3;
inline constexpr struct link4_ final : kte::frame_3D_key<"link4"> {} link4;
inline constexpr struct link5_ final : kte::frame_3D_key<"link5"> {} link5;
inline constexpr struct link6_ final : kte::frame_3D_key<"link6"> {} link6;
inline constexpr struct link7_ final : kte::frame_3D_key<"link7"> {} link7;
inline constexpr struct tool_ final : kte::frame_3D_key<"tool"> {} tool; }  // namespace iiwa14_names

inline constexpr auto iiwa14 = [] {
  using namespace iiwa14_names;
  using namespace kte;
  constexpr auto up = half_turn_z * quarter_turn_x;
  constexpr auto& x90 = quarter_turn_x;
  return chain(rigid_link_3D(base, mount1, along_z(0.1575)), revolute_joint_3D(q1, mount1, link1),
               inertia_3D(link1, rigid_body{5.76, vec3{zero, -0.03, 0.12}, diagonal(0.033, 0.0333, 0.0123)}),

               rigid_link_3D(link1, mount2, along_z(0.2025), up), revolute_joint_3D(q2, mount2, link2),
               inertia_3D(link2, rigid_body{6.35, vec3{0.0003, 0.059, 0.042}, diagonal(0.0305, 0.0304, 0.011)}),

               rigid_link_3D(link2, mount3, along_y(0.2045), up), revolute_joint_3D(q3, mount3, link3),
               inertia_3D(link3, rigid_body{3.5, vec3{zero, 0.03, 0.13}, diagonal(0.025, 0.0238, 0.0076)}),

               rigid_link_3D(link3, mount4, along_z(0.2155), x90), revolute_joint_3D(q4, mount4, link4),
               inertia_3D(link4, rigid_body{3.5, vec3{zero, 0.067, 0.034}, diagonal(0.017, 0.0164, 0.006)}),

               rigid_link_3D(link4, mount5, along_y(0.1845), up), revolute_joint_3D(q5, mount5, link5),
               inertia_3D(link5, rigid_body{3.5, vec3{0.0001, 0.021, 0.076}, diagonal(0.01, 0.0087, 0.00449)}),

               rigid_link_3D(link5, mount6, along_z(0.2155), x90), revolute_joint_3D(q6, mount6, link6),
               inertia_3D(link6, rigid_body{1.8, vec3{zero, 0.0006, 0.0004}, diagonal(0.0049, 0.0047, 0.0036)}),

               rigid_link_3D(link6, mount7, along_y(0.081), up), revolute_joint_3D(q7, mount7, link7),
               inertia_3D(link7, rigid_body{1.2, along_z(0.02), diagonal(0.001, 0.001, 0.001)}),

               rigid_link_3D(link7, tool, along_z(0.045)))
      .gravity(along_z(-9.81));
}();

}  // namespace robots
