#pragma once

#include <kte/elements/free_joint.hpp>
#include <kte/static.hpp>

/// The Solo12 of the Open Dynamic Robot Initiative, from its published parameters: a floating trunk and four legs of
/// three revolute joints about x, y and y. A lower leg and its foot are one body. m, kg, kg m^2.
namespace robots {

namespace solo12_names {
/// FL_HAA: the text of a leg and of a part of it.
template <kte::fixed_string Leg, kte::fixed_string Part>
constexpr auto joined() {
  constexpr std::size_t length = Leg.view().size();
  char text[length + sizeof(Part.text)]{};
  std::copy_n(Leg.text, length, text);
  std::copy_n(Part.text, sizeof(Part.text), text + length);
  return kte::fixed_string(text);
}
// clang-format off
inline constexpr struct trunk_ final : kte::pose_3D_key<"trunk"> {} trunk;
inline constexpr struct ground_ final : kte::frame_3D_key<"ground"> {} ground;
inline constexpr struct body_ final : kte::frame_3D_key<"base_link"> {} body;
template <kte::fixed_string Leg>
struct leg {
  static constexpr struct haa_ final : kte::coord_key<joined<Leg, "_HAA">()> {} haa{};
  static constexpr struct hfe_ final : kte::coord_key<joined<Leg, "_HFE">()> {} hfe{};
  static constexpr struct kfe_ final : kte::coord_key<joined<Leg, "_KFE">()> {} kfe{};
  static constexpr struct hip_ final : kte::frame_3D_key<joined<Leg, "_hip">()> {} hip{};
  static constexpr struct shoulder_ final : kte::frame_3D_key<joined<Leg, "_SHOULDER">()> {} shoulder{};
  static constexpr struct thigh_ final : kte::frame_3D_key<joined<Leg, "_thigh">()> {} thigh{};
  static constexpr struct upper_ final : kte::frame_3D_key<joined<Leg, "_UPPER_LEG">()> {} upper{};
  static constexpr struct knee_ final : kte::frame_3D_key<joined<Leg, "_knee">()> {} knee{};
  static constexpr struct lower_ final : kte::frame_3D_key<joined<Leg, "_LOWER_LEG">()> {} lower{};
  static constexpr struct foot_ final : kte::frame_3D_key<joined<Leg, "_FOOT">()> {} foot{}; };
inline constexpr leg<"FL"> fl;
inline constexpr leg<"FR"> fr;
inline constexpr leg<"HL"> hl;
inline constexpr leg<"HR"> hr; }  // namespace solo12_names
// clang-format on

/// A leg; `front` and `side` are 1 or -1.
template <class Leg>
constexpr auto solo12_leg(const Leg& l, double front, double side) {
  using namespace kte;
  return chain(rigid_link_3D(solo12_names::body, l.hip, vec3{0.1946 * front, 0.0875 * side, zero}),
               revolute_joint_3D(l.haa, l.hip, l.shoulder, axis::x),
               inertia_3D(l.shoulder, rigid_body{0.14853845, vec3{-0.078707 * front, 0.01 * side, zero},
                                                 sym3{3.024e-5, 4.671e-5 * side, zero, 4.1193e-4, zero, 4.1107e-4}}),

               rigid_link_3D(l.shoulder, l.thigh, along_y(0.014 * side)),
               revolute_joint_3D(l.hfe, l.thigh, l.upper, axis::y),
               inertia_3D(l.upper, rigid_body{0.14853845, vec3{1.377e-5 * side, 0.01935853 * side, -0.078707},
                                              sym3{4.1107e-4, zero, zero, 4.1193e-4, 4.671e-5 * side, 3.024e-5}}),

               rigid_link_3D(l.upper, l.knee, vec3{zero, 0.03745 * side, -0.16}),
               revolute_joint_3D(l.kfe, l.knee, l.lower, axis::y),
               inertia_3D(l.lower, rigid_body{0.03763607, vec3{zero, 0.007899211229132053 * side, -0.10224903071020168},
                                              sym3{1.488193037682854e-4, zero, zero, 1.4913921739033597e-4,
                                                   3.0991871808848403e-6 * side, 2.690086377949433e-6}}),

               rigid_link_3D(l.lower, l.foot, vec3{zero, 0.008 * side, -0.16}));
}

inline constexpr auto solo12 = [] {
  using namespace solo12_names;
  using namespace kte;
  return chain(free_joint_3D(trunk, ground, body),
               inertia_3D(body, rigid_body{1.16115091, zero3{}, diagonal(0.00578574, 0.01938108, 0.02476124)}),
               solo12_leg(fl, 1, 1), solo12_leg(fr, 1, -1), solo12_leg(hl, -1, 1), solo12_leg(hr, -1, -1))
      .gravity(along_z(-9.81));
}();

}  // namespace robots
