#pragma once

#include <kte/elements/rigid_contact.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>
#include <kte/static.hpp>

#include <cmath>

namespace kte::test {

// clang-format off
inline constexpr struct slope_ final : frame_2D_key<"world"> {} slope;
inline constexpr struct box_   final : frame_2D_key<"box">   {} box;
inline constexpr struct left_  final : frame_2D_key<"left">  {} left_corner;
inline constexpr struct right_ final : frame_2D_key<"right"> {} right_corner;
inline constexpr struct pose_  final : pose_2D_key<"pose">   {} pose_of_box;
inline constexpr struct left_foot_  final : contact_key<"left foot">  {} left_foot;
inline constexpr struct right_foot_ final : contact_key<"right foot"> {} right_foot;
// clang-format on

/// A box of 1 kg on two corners, on a slope of 0.3 in whose axes it moves.
inline auto box_on_slope(double friction) {
  const contact_law law{.friction = friction};
  return chain(base_2D(slope), free_joint_2D(pose_of_box, slope, box),
               rigid_link_2D(box, left_corner, vec2{-0.1, -0.05}), rigid_link_2D(box, right_corner, vec2{0.1, -0.05}),
               inertia_2D(box, planar_body(1.0, 0.01)),
               point_contact_2D(left_foot, slope, left_corner, half_space{}, law),
               point_contact_2D(right_foot, slope, right_corner, half_space{}, law))
      .gravity(vec3{-9.81 * std::sin(0.3), -9.81 * std::cos(0.3), zero});
}
/// A static chain as a runtime chain.
runtime_chain in_runtime(const auto& c) {
  runtime_chain r;
  r << c;
  return r;
}

}  // namespace kte::test
