#pragma once

#include <kte/frames/inverse.hpp>
#include <kte/math/axis.hpp>
#include <kte/math/matrix.hpp>

#include <array>

/// An arm as the axes of its joints, for the closed forms of inverse kinematics.
namespace kte::detail {

/// The joints between a base and a tool, in order, at coordinates zero, in axes of the base: joint i rotates about the
/// line through `point[i]` along the unit vector `axis[i]`, or slides along it. Product of exponentials (Brockett,
/// Robotic Manipulators and the Product of Exponentials Formula, 1984):
///
///   pose of the tool = exp(joint 1, q_1) ... exp(joint n, q_n) tool          (1)
struct arm_geometry {
  static constexpr std::size_t most = 8;

  int n = 0;
  std::array<vec3<>, most> axis{}, point{};
  std::array<bool, most> slides{};
  std::array<int, most> in_q{}, in_v{};  ///< positions of the coordinate in q and v
  pose<mat3<vec3<>>, vec3<>> tool{mat3<vec3<>>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, vec3<>{0, 0, 0}};
  /// For a free body without joints, its pose in `placement` is the coordinate at in_q[0].
  enum class freely : unsigned char { not_at_all, in_plane, in_space } moves = freely::not_at_all;
  pose<mat3<vec3<>>, vec3<>> placement = tool;
  /// Why an element is unsupported, or null: "has a joint that ...".
  const char* refused = nullptr;

  constexpr void add(const vec3<>& h, const vec3<>& p, bool sliding, int q, int v) {
    if (n == static_cast<int>(most)) {
      refused = "has more than eight joints";
      return;
    }
    const auto i = static_cast<std::size_t>(n++);
    axis[i] = h, point[i] = p, slides[i] = sliding, in_q[i] = q, in_v[i] = v;
  }
  constexpr int turning() const {
    int count = 0;
    for (int i = 0; i < n; ++i) count += !slides[static_cast<std::size_t>(i)];
    return count;
  }
};

/// The arm from the tool to the base; its pose is the inverse.
constexpr arm_geometry reversed(const arm_geometry& a) {
  arm_geometry r = a;
  r.tool = inverse(a.tool);
  for (int k = 0; k < a.n; ++k) {
    const auto i = static_cast<std::size_t>(k), j = static_cast<std::size_t>(a.n - 1 - k);
    r.axis[j] = -(r.tool.rotation * a.axis[i]);
    r.point[j] = r.tool.rotation * a.point[i] + r.tool.position;
    r.slides[j] = a.slides[i], r.in_q[j] = a.in_q[i], r.in_v[j] = a.in_v[i];
  }
  return r;
}
/// Joints `first` to `last` alone, with the tool.
constexpr arm_geometry part_of(const arm_geometry& a, int first, int last) {
  arm_geometry r;
  r.tool = a.tool;
  for (int k = first; k <= last; ++k) {
    const auto i = static_cast<std::size_t>(k);
    r.add(a.axis[i], a.point[i], a.slides[i], a.in_q[i], a.in_v[i]);
  }
  return r;
}

/// exp(joint i, t): x -> R x + p. `turn`: cosine and sine of t.
template <class S, class Angle>
constexpr pose<mat3<vec3<S>>, vec3<S>> joint_pose(const arm_geometry& a, std::size_t i, const S& t, const Angle& turn) {
  const vec3<S> h = as<S>(a.axis[i]), o = as<S>(a.point[i]);
  if (a.slides[i]) return {as<S>(mat3<vec3<>>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), t * h};
  const mat3<vec3<S>> r = as<S>(rotation_about(h, turn.cos, turn.sin));
  return {r, vec3<S>(o - r * o)};
}

}  // namespace kte::detail
