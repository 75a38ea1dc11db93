#pragma once

#include <kte/frames/motion.hpp>

#include <array>

namespace kte::detail {

/// A joint or link as numbers: the motion of its end in its base, at coordinate zero and at rest. Its axes are constant
/// in the end (contract/transmission.hpp), which determines all configurations:
///
///   X(q) = X(0) exp(s q)          for one coordinate          (1)
///   X(q) = X(0) B^-1 q B          for a rotation or a pose    (2)
template <class P>
struct rigid_numbers {
  pose<mat3<vec3<P>>, vec3<P>> at_zero{}, tried{};  ///< tried: the pose at the test coordinate below
  std::array<vec3<P>, 6> linear{}, angular{};       ///< of the axes
};

/// Test coordinates for (1) and (2), which detect joints that do not satisfy them: rotations by 3-4-5 triangles.
inline constexpr double tried_angle = 0.64350110879328438680;  // atan 3/4
inline constexpr double tried_cosine = 0.8, tried_sine = 0.6;
inline constexpr vec3<> tried_position{0.5, -0.25, 0.75};
inline constexpr mat3<vec3<>> tried_rotation{{0.8, -0.48, 0.36}, {0.6, 0.64, -0.48}, {0.0, 0.6, 0.8}};

}  // namespace kte::detail
