#pragma once

#include <kte/kte.hpp>
#include <kte/runtime_chain/from_record.hpp>

#include "chain/registered.hpp"

/// Small chains that several tests use.
namespace models {

// clang-format off
inline constexpr struct q_      final : kte::coord_key<"q">           {} q;
inline constexpr struct base_   final : kte::frame_2D_key<"base">     {} base;
inline constexpr struct joint_  final : kte::frame_2D_key<"joint">    {} joint;
inline constexpr struct tip_    final : kte::frame_2D_key<"tip">      {} tip;
// clang-format on

/// The README's pendulum: 1 kg at 0.5 m.
inline constexpr auto pendulum =
    kte::chain(kte::revolute_joint_2D(q, base, joint), kte::rigid_link_2D(joint, tip, kte::along_x(0.5)),
               kte::inertia_2D(tip, kte::point_mass(1.0)));

// clang-format off
inline constexpr struct hip_    final : kte::coord_key<"hip">         {} hip;
inline constexpr struct knee_   final : kte::coord_key<"knee">        {} knee;
inline constexpr struct slide_  final : kte::coord_key<"slide">       {} slide;
inline constexpr struct geared_ final : kte::coord_key<"geared">      {} geared;
inline constexpr struct wall_   final : kte::coord_key<"wall">        {} wall;
inline constexpr struct motor_  final : kte::input_key<"motor">       {} motor;
inline constexpr struct ground_ final : kte::frame_3D_key<"ground">   {} ground;
inline constexpr struct trunk_  final : kte::frame_3D_key<"trunk">    {} trunk;
inline constexpr struct left_   final : kte::frame_3D_key<"left">     {} left;
inline constexpr struct thigh_  final : kte::frame_3D_key<"thigh">    {} thigh;
inline constexpr struct shank_  final : kte::frame_3D_key<"shank">    {} shank;
inline constexpr struct right_  final : kte::frame_3D_key<"right">    {} right;
inline constexpr struct hand_   final : kte::frame_3D_key<"hand">     {} hand;
// clang-format on

/// A tree with everything: joints about typed and general axes, a sliding joint, a coordinate that follows another, one
/// that is shared by two joints, springs, a damper, a motor, masses on coordinates.
inline constexpr auto tree = [] {
  using namespace kte;
  constexpr rigid_body body{1.5, vec3{0.02, -0.03, 0.1}, sym3{0.03, 0.001, -0.002, 0.025, 0.003, 0.02}};
  return chain(base_gen(wall), driving_actuator_gen(hip, motor), prismatic_joint_3D(slide, ground, trunk, axis::z),
               inertia_3D(trunk, rigid_body{4.0, vec3{0.01, 0.0, 0.05}, diagonal(0.1, 0.2, 0.15)}),
               rigid_link_3D(trunk, left, vec3{0.1, 0.2, -0.3}, quarter_turn_x),
               revolute_joint_3D(hip, left, thigh, vec3{0.6, 0.0, 0.8}), inertia_3D(thigh, body),
               rigid_link_gen(knee, geared, 0.3), revolute_joint_3D(geared, thigh, shank, axis::y),
               inertia_3D(shank, body), rigid_link_3D(trunk, right, along_y(-0.2)),
               revolute_joint_3D(knee, right, hand, axis::minus_x), inertia_3D(hand, point_mass(0.7, along_z(-0.4))),
               inertia_gen(knee, 0.05), spring_gen(wall, slide, 0.2, 300.0), damper_gen(hip, knee, 0.8),
               spring_gen(hip, geared, -0.1, 12.0, 5.0))
      .gravity(vec3{0.3, -0.4, -9.81});
}();

/// The elements of a static chain as a runtime chain, one by one: what has typed constants has numbers instead.
template <class Chain>
kte::runtime_chain element_by_element(const Chain& c) {
  return registered(record_of(c));
}
/// A runtime chain with the element types of the static chain, which are compiled in the caller.
template <class Chain>
kte::runtime_chain by_own_elements(const Chain& c) {
  kte::runtime_chain r;
  r.gravity(c.gravity());
  boost::hana::for_each(c.elements(), [&r](const auto& e) { r << kte::detail::with_texts(e); });
  return r;
}

}  // namespace models
