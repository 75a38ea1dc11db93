#pragma once

#include <kte/contract/key.hpp>

/// Names of coordinates and frames that the models of this folder share: `q1` ... `q7` are the joints from the base on,
/// `link1` ... `link7` the frames that they move, `tool` is the last frame. Planar arms use `planar_arm_names`.
namespace kte::arm_names {

// clang-format off
/// Coordinates of the predefined arms.
inline constexpr struct q1_ final : coord_key<"q1"> {} q1;
inline constexpr struct q2_ final : coord_key<"q2"> {} q2;
inline constexpr struct q3_ final : coord_key<"q3"> {} q3;
inline constexpr struct q4_ final : coord_key<"q4"> {} q4;
inline constexpr struct q5_ final : coord_key<"q5"> {} q5;
inline constexpr struct q6_ final : coord_key<"q6"> {} q6;
inline constexpr struct q7_ final : coord_key<"q7"> {} q7;
inline constexpr struct track_ final : coord_key<"track"> {} track;
inline constexpr struct floating_ final : pose_3D_key<"pose"> {} floating;

/// Frames of the predefined arms.
inline constexpr struct base_ final : frame_3D_key<"base"> {} base;
inline constexpr struct cart_ final : frame_3D_key<"cart"> {} cart;
inline constexpr struct link1_ final : frame_3D_key<"link1"> {} link1;
inline constexpr struct link2_ final : frame_3D_key<"link2"> {} link2;
inline constexpr struct link3_ final : frame_3D_key<"link3"> {} link3;
inline constexpr struct link4_ final : frame_3D_key<"link4"> {} link4;
inline constexpr struct link5_ final : frame_3D_key<"link5"> {} link5;
inline constexpr struct link6_ final : frame_3D_key<"link6"> {} link6;
inline constexpr struct link7_ final : frame_3D_key<"link7"> {} link7;
inline constexpr struct body_ final : frame_3D_key<"body"> {} body;
inline constexpr struct tool_ final : frame_3D_key<"tool"> {} tool;
// clang-format on

}  // namespace kte::arm_names

namespace kte::planar_arm_names {

// clang-format off
using arm_names::q1, arm_names::q2, arm_names::q3;
/// Coordinate and frames of the predefined planar arms.
inline constexpr struct floating_ final : pose_2D_key<"pose"> {} floating;
inline constexpr struct base_ final : frame_2D_key<"base"> {} base;
inline constexpr struct link1_ final : frame_2D_key<"link1"> {} link1;
inline constexpr struct link2_ final : frame_2D_key<"link2"> {} link2;
inline constexpr struct link3_ final : frame_2D_key<"link3"> {} link3;
inline constexpr struct body_ final : frame_2D_key<"body"> {} body;
inline constexpr struct tool_ final : frame_2D_key<"tool"> {} tool;
// clang-format on

}  // namespace kte::planar_arm_names
