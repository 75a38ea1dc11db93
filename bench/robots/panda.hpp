#pragma once

#include <kte/static.hpp>

/// The Franka Emika Panda with its hand, from its published parameters: seven revolute joints about z and two fingers
/// that slide. m, kg, kg m^2. The hand is part of link 7, turned by -45 degrees.
namespace robots {

namespace panda_names {
// clang-format off
inline constexpr struct q1_ final : kte::coord_key<"q1"> {} q1;
inline constexpr struct q2_ final : kte::coord_key<"q2"> {} q2;
inline constexpr struct q3_ final : kte::coord_key<"q3"> {} q3;
inline constexpr struct q4_ final : kte::coord_key<"q4"> {} q4;
inline constexpr struct q5_ final : kte::coord_key<"q5"> {} q5;
inline constexpr struct q6_ final : kte::coord_key<"q6"> {} q6;
inline constexpr struct q7_ final : kte::coord_key<"q7"> {} q7;
inline constexpr struct left_ final : kte::coord_key<"left"> {} left;
inline constexpr struct right_ final : kte::coord_key<"right"> {} right;
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
inline constexpr struct hand_ final : kte::frame_3D_key<"hand"> {} hand;
inline constexpr struct left_finger_ final : kte::frame_3D_key<"left finger"> {} left_finger;
inline constexpr struct right_finger_ final : kte::frame_3D_key<"right finger"> {} right_finger; }  // namespace panda_names
// clang-format on

inline constexpr auto panda = [] {
  using namespace panda_names;
  using namespace kte;
  constexpr auto& x90 = quarter_turn_x;
  constexpr auto& back = minus_quarter_turn_x;
  constexpr double h = 0.7071067811865476;
  constexpr mat3 turned{vec3{h, h, zero}, vec3{-h, h, zero}, axis::z};
  constexpr rigid_body finger{0.015, zero3{}, diagonal(2.375e-6, 2.375e-6, 7.5e-7)};
  return chain(rigid_link_3D(base, mount1, along_z(0.333)), revolute_joint_3D(q1, mount1, link1),
               inertia_3D(link1, rigid_body{4.970684, vec3{0.003875, 0.002081, -0.04762},
                                            sym3{0.70337, -0.000139, 0.006772, 0.70661, 0.019169, 0.009117}}),

               rigid_link_3D(link1, mount2, zero3{}, back), revolute_joint_3D(q2, mount2, link2),
               inertia_3D(link2, rigid_body{0.646926, vec3{-0.003141, -0.02872, 0.003495},
                                            sym3{0.007962, -0.003925, 0.010254, 0.02811, 0.000704, 0.025995}}
                                     .as_published()),

               rigid_link_3D(link2, mount3, along_y(-0.316), x90), revolute_joint_3D(q3, mount3, link3),
               inertia_3D(link3, rigid_body{3.228604, vec3{0.027518, 0.039252, -0.066502},
                                            sym3{0.037242, -0.004761, -0.011396, 0.036155, -0.012805, 0.01083}}),

               rigid_link_3D(link3, mount4, along_x(0.0825), x90), revolute_joint_3D(q4, mount4, link4),
               inertia_3D(link4, rigid_body{3.587895, vec3{-0.05317, 0.104419, 0.027454},
                                            sym3{0.025853, 0.007796, -0.001332, 0.019552, 0.008641, 0.028323}}),

               rigid_link_3D(link4, mount5, vec3{-0.0825, 0.384, zero}, back), revolute_joint_3D(q5, mount5, link5),
               inertia_3D(link5, rigid_body{1.225946, vec3{-0.011953, 0.041065, -0.038437},
                                            sym3{0.035549, -0.002117, -0.004037, 0.029474, 0.000229, 0.008627}}),

               rigid_link_3D(link5, mount6, zero3{}, x90), revolute_joint_3D(q6, mount6, link6),
               inertia_3D(link6, rigid_body{1.666555, vec3{0.060149, -0.014117, -0.010517},
                                            sym3{0.001964, 0.000109, -0.001158, 0.004354, 0.000341, 0.005433}}),

               rigid_link_3D(link6, mount7, along_x(0.088), x90), revolute_joint_3D(q7, mount7, link7),
               inertia_3D(link7,
                          rigid_body{1.465522, vec3{0.0017561014923953412, 0.0013882015818676193, 0.09915644298345573},
                                     sym3{0.016396041602866757, 0.0003949639647318426, -0.0007101156156540998,
                                          0.01397340252488091, -0.0010538087685085858, 0.0066753082423586735}}),

               rigid_link_3D(link7, hand, along_z(0.1654), turned),
               prismatic_joint_3D(left, hand, left_finger, axis::y), inertia_3D(left_finger, finger),
               prismatic_joint_3D(right, hand, right_finger, axis::minus_y), inertia_3D(right_finger, finger))
      .gravity(along_z(-9.81));
}();

}  // namespace robots
