#pragma once

#include <kte/manipulators/arm_names.hpp>
#include <kte/manipulators/link_body.hpp>
#include <kte/manipulators/manipulator.hpp>
#include <kte/static.hpp>

namespace kte {

/// Lengths of an industrial arm with an ortho-parallel base and a spherical wrist: a1, a2, b, c1, c2, c3, c4 of
/// Brandstoetter, Angerer, Hofbaur (Austrian Robotics Workshop, 2014), m; by default those of an ABB IRB 2400.
struct opw_lengths {
  double a1 = 0.1, a2 = -0.135, b = 0, c1 = 0.615, c2 = 0.705, c3 = 0.755, c4 = 0.085;
};

/// Six revolute joints: z (a1, 0, c1), y (0, 0, c2), y (a2, b, c3), z, y, z (0, 0, c4), each with the vector to the
/// next joint. The arm is upright at q = 0. Masses are not published; rods of 150, 60, 60, 10, 5, 2 kg are assumed.
[[nodiscard]] constexpr auto opw_chain(const opw_lengths& l = {}) {
  using namespace arm_names;
  const vec3 d1{l.a1, zero, l.c1};
  const vec3 d3{l.a2, l.b, l.c3};
  return chain(revolute_joint_3D(q1, base, link1), inertia_3D(link1, link_body(150, d1, 0.15)),
               revolute_joint_3D(q2, link1, link2, axis::y).at(d1),
               inertia_3D(link2, link_body(60, along_z(l.c2), 0.1)),
               revolute_joint_3D(q3, link2, link3, axis::y).at(along_z(l.c2)),
               inertia_3D(link3, link_body(60, d3, 0.1)), revolute_joint_3D(q4, link3, link4).at(d3),
               inertia_3D(link4, link_body(10, zero3{}, 0.1)), revolute_joint_3D(q5, link4, link5, axis::y),
               inertia_3D(link5, link_body(5, zero3{}, 0.05)), revolute_joint_3D(q6, link5, link6),
               inertia_3D(link6, link_body(2, along_z(l.c4), 0.05)), rigid_link_3D(link6, tool, along_z(l.c4)))
      .gravity(along_z(-9.81));
}
/// Limits from the data sheet of the IRB 2400. The third angle of the data sheet is smaller by 90 degrees: there the
/// forearm is horizontal at q = 0.
[[nodiscard]] constexpr auto opw_limits() {
  auto limits = unlimited(opw_chain());
  limits.lower = detail::in_radians<6>({-180, -100, 30, -200, -120, -400});
  limits.upper = detail::in_radians<6>({180, 110, 155, 200, 120, 400});
  limits.rate = detail::in_radians<6>({150, 150, 150, 360, 360, 450});
  return limits;
}

/// The arm with its limits.
[[nodiscard]] constexpr auto opw(const opw_lengths& lengths = {}) {
  return manipulator(opw_chain(lengths), arm_names::tool, opw_limits());
}

}  // namespace kte
