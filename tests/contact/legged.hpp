#pragma once

#include <kte/contacts.hpp>
#include <kte/elements/rigid_contact.hpp>

/// A body with a leg: its heel touches the floor of a carriage, its foot a hill.
namespace kte::test::legged {

// clang-format off
inline constexpr struct slide_ final : coord_key<"slide"> {} slide;
inline constexpr struct knee_ final : coord_key<"knee"> {} knee;
inline constexpr struct pose_ final : pose_3D_key<"pose"> {} pose_of_body;
inline constexpr struct world_ final : frame_3D_key<"world"> {} world;
inline constexpr struct carriage_ final : frame_3D_key<"carriage"> {} carriage;
inline constexpr struct floor_ final : frame_3D_key<"floor"> {} floor_of_carriage;
inline constexpr struct hill_ final : frame_3D_key<"hill"> {} hill;
inline constexpr struct body_ final : frame_3D_key<"body"> {} body;
inline constexpr struct hip_ final : frame_3D_key<"hip"> {} hip;
inline constexpr struct shank_ final : frame_3D_key<"shank"> {} shank;
inline constexpr struct foot_ final : frame_3D_key<"foot"> {} foot;
inline constexpr struct on_floor_ final : contact_key<"on floor"> {} on_floor;
inline constexpr struct on_hill_ final : contact_key<"on hill"> {} on_hill;
// clang-format on
inline constexpr int scene_dofs = 8;
inline constexpr double radius = 0.07;
inline constexpr vec3<> heel{-0.2, 0.1, -0.15}, top_of_hill{0.3, 0.1, 0};

struct scene {
  double height = 0, size = 1;  ///< of the floor, m; radius of the hill, m
  double friction_of_floor = 0, friction_of_hill = 0;

  auto tree() const {
    return chain(prismatic_joint_3D(slide, world, carriage, axis::x), inertia_3D(carriage, point_mass(1.7)),
                 rigid_link_3D(carriage, floor_of_carriage, vec3<>{0, 0, height}),
                 rigid_link_3D(world, hill, top_of_hill - vec3<>{0, 0, size}), free_joint_3D(pose_of_body, world, body),
                 inertia_3D(body,
                            rigid_body<>{2.0, vec3<>{0.02, 0.01, 0.03}, sym3<>{0.05, 0.002, 0.001, 0.06, 0.003, 0.04}}),
                 rigid_link_3D(body, hip, vec3<>{0.2, 0, 0}), revolute_joint_3D(knee, hip, shank, axis::y),
                 inertia_3D(shank, rigid_body<>{0.4, vec3<>{0, 0, -0.1}, sym3<>{0.004, 0, 0, 0.003, 0, 0.002}}),
                 rigid_link_3D(shank, foot, vec3<>{0, 0, -0.25}))
        .gravity(along_z(-9.81));
  }
  auto touching() const {
    return chain(
               tree(),
               sphere_contact_3D(on_floor, floor_of_carriage, body, half_space{}, radius, {friction_of_floor, 0}, heel),
               sphere_contact_3D(on_hill, hill, foot, ball_surface(size), radius, {friction_of_hill, 0}))
        .gravity(along_z(-9.81));
  }
};

}  // namespace kte::test::legged
