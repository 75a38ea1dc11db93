#pragma once

#include <kte/elements/free_joint.hpp>
#include <kte/static.hpp>

#include "robots/solo12.hpp"

/// The HyQ of the Italian Institute of Technology, from its published parameters: a floating trunk and four legs of
/// three revolute joints about z, placed by quarter turns. A lower leg and its foot are one body. m, kg, kg m^2.
namespace robots {

namespace hyq_names {
using solo12_names::joined;
// clang-format off
inline constexpr struct trunk_ final : kte::pose_3D_key<"trunk"> {} trunk;
inline constexpr struct ground_ final : kte::frame_3D_key<"ground"> {} ground;
inline constexpr struct body_ final : kte::frame_3D_key<"base_link"> {} body;
template <kte::fixed_string Leg>
struct leg {
  static constexpr struct haa_ final : kte::coord_key<joined<Leg, "_haa">()> {} haa{};
  static constexpr struct hfe_ final : kte::coord_key<joined<Leg, "_hfe">()> {} hfe{};
  static constexpr struct kfe_ final : kte::coord_key<joined<Leg, "_kfe">()> {} kfe{};
  static constexpr struct hip_ final : kte::frame_3D_key<joined<Leg, "_hip">()> {} hip{};
  static constexpr struct assembly_ final : kte::frame_3D_key<joined<Leg, "_hipassembly">()> {} assembly{};
  static constexpr struct thigh_ final : kte::frame_3D_key<joined<Leg, "_thigh">()> {} thigh{};
  static constexpr struct upper_ final : kte::frame_3D_key<joined<Leg, "_upperleg">()> {} upper{};
  static constexpr struct knee_ final : kte::frame_3D_key<joined<Leg, "_knee">()> {} knee{};
  static constexpr struct lower_ final : kte::frame_3D_key<joined<Leg, "_lowerleg">()> {} lower{};
  static constexpr struct foot_ final : kte::frame_3D_key<joined<Leg, "_foot">()> {} foot{}; };
inline constexpr leg<"lf"> lf;
inline constexpr leg<"lh"> lh;
inline constexpr leg<"rf"> rf;
inline constexpr leg<"rh"> rh; }  // namespace hyq_names
// clang-format on

/// A leg, its hip turned by `placement` and its thigh by `turn`; `front` and `side` are 1 or -1.
template <class Leg, class Placement, class Turn>
constexpr auto hyq_leg(const Leg& l, const Placement& placement, const Turn& turn, double front, double side) {
  using namespace kte;
  const double across = front * side;
  return chain(
      rigid_link_3D(hyq_names::body, l.hip, vec3{0.3735 * front, 0.207 * side, zero}, placement),
      revolute_joint_3D(l.haa, l.hip, l.assembly),
      inertia_3D(l.assembly, rigid_body{2.93, vec3{0.04263, zero, 0.16931 * across},
                                        sym3{0.05071, -4e-5 * across, -0.00159 * across, 0.05486, -5e-5, 0.00571}}),

      rigid_link_3D(l.assembly, l.thigh, along_x(0.08), turn), revolute_joint_3D(l.hfe, l.thigh, l.upper),
      inertia_3D(l.upper, rigid_body{2.638, vec3{0.15074, -0.02625 * front, zero},
                                     sym3{0.00368, -0.00302 * front, 0.0001 * front, 0.02719, 2e-5, 0.02811}}),

      rigid_link_3D(l.upper, l.knee, along_x(0.35)), revolute_joint_3D(l.kfe, l.knee, l.lower),
      inertia_3D(
          l.lower,
          rigid_body{0.881001, vec3{0.12540025039699162, 3.999995459710034e-5 * front, -9.999988649275086e-5 * front},
                     sym3{4.710000000115803e-4, front > 0 ? 6.100000882398509e-5 : -5.9000008823994884e-5,
                          front > 0 ? -1.1000022059970065e-5 : 9.000022059979859e-6, 0.012561048664314772,
                          -9.999999960097978e-7, 0.012331048664306373}}),

      rigid_link_3D(l.lower, l.foot, along_x(0.346), quarter_turn_x * quarter_turn_z));
}

inline constexpr auto hyq = [] {
  using namespace hyq_names;
  using namespace kte;
  constexpr auto& right = quarter_turn_y;
  constexpr auto left = quarter_turn_y * half_turn_x;
  return chain(free_joint_3D(trunk, ground, body),
               inertia_3D(body,
                          rigid_body{60.978001, vec3{0.05606913221048359, 0.02149368261514509, 0.0036081141000342074},
                                     sym3{1.5727661697612338, 0.028466186004786183, -0.20353938133009428,
                                          8.502744033678699, -0.004424323919845786, 9.196487346534783}}),
               hyq_leg(lf, left, quarter_turn_x, 1, 1), hyq_leg(lh, left, quarter_turn_x, -1, 1),
               hyq_leg(rf, right, minus_quarter_turn_x, 1, -1), hyq_leg(rh, right, minus_quarter_turn_x, -1, -1))
      .gravity(along_z(-9.81));
}();

}  // namespace robots
