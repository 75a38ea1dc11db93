#pragma once

#include <kte/manipulators/detail/arm_geometry.hpp>

namespace kte::detail {

/// Whether an arm is singular in every posture, because four axes meet in a point or two coincide: whether the columns
/// of its Jacobian
///
///   (o_i x h_i / reach, h_i) for revolute joints,  (h_i, 0) for slides          (1)
///
/// are linearly dependent, to 1e-9, in one generic posture, whose sines and cosines no real arm is designed for. By
/// elimination with complete pivoting.
constexpr bool singular_everywhere(const arm_geometry& arm, double reach) {
  struct direction {
    double cos, sin;
  };
  constexpr direction posture[arm_geometry::most] = {{20. / 29, 21. / 29}, {35. / 37, 12. / 37}, {9. / 41, 40. / 41},
                                                     {45. / 53, 28. / 53}, {11. / 61, 60. / 61}, {63. / 65, 16. / 65},
                                                     {48. / 73, 55. / 73}, {77. / 85, 36. / 85}};
  std::array<std::array<double, 6>, arm_geometry::most> column{};
  const auto n = static_cast<std::size_t>(arm.n);
  pose<mat3<vec3<>>, vec3<>> x{mat3<vec3<>>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, vec3<>{0, 0, 0}};
  for (std::size_t i = 0; i < n; ++i) {
    const vec3<> h = x.rotation * arm.axis[i], o = x.rotation * arm.point[i] + x.position, none{0, 0, 0};
    const vec3<> v = arm.slides[i] ? h : vec3<>((1 / reach) * cross(o, h)), w = arm.slides[i] ? none : h;
    column[i] = {v.x, v.y, v.z, w.x, w.y, w.z};
    if (!arm.slides[i]) {
      const auto r = as<double>(rotation_about(h, posture[i].cos, posture[i].sin));
      x = {as<double>(r * x.rotation), vec3<>(o + r * vec3<>(x.position - o))};
    }
  }
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t best = k, row = 0;
    double largest = 0;
    for (std::size_t i = k; i < n; ++i)
      for (std::size_t r = 0; r < 6; ++r)
        if (const double size = column[i][r] < 0 ? -column[i][r] : column[i][r]; size > largest)
          largest = size, best = i, row = r;
    if (!(largest > 1e-9)) return true;
    std::swap(column[k], column[best]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const double ratio = column[i][row] / column[k][row];
      for (std::size_t r = 0; r < 6; ++r) column[i][r] -= ratio * column[k][r];
      column[i][row] = 0;
    }
  }
  return false;
}

}  // namespace kte::detail
