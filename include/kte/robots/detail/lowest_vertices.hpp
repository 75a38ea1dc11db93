#pragma once

#include <kte/math/vec.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace kte::detail {

/// At most four of the points that are lowest along a unit normal n, to within a thousandth of the size of all: the
/// lowest one a, the farthest one b from it, and on both sides those farthest from the line between them,
///
///   n.((b - a) x (p - a)) largest and smallest          (1)
inline std::vector<vec3<>> lowest_vertices(const std::vector<vec3<>>& points, const vec3<>& normal) {
  if (points.empty()) return {};
  vec3<> least = points[0], most = points[0];
  auto lowest = points.begin();
  for (auto p = points.begin(); p != points.end(); ++p) {
    least = {(std::min)(least.x, p->x), (std::min)(least.y, p->y), (std::min)(least.z, p->z)};
    most = {(std::max)(most.x, p->x), (std::max)(most.y, p->y), (std::max)(most.z, p->z)};
    if (dot(normal, *p) < dot(normal, *lowest)) lowest = p;
  }
  const vec3<> size = most - least;
  const double tolerance = 1e-3 * std::sqrt(dot(size, size));
  std::vector<vec3<>> low;
  for (const auto& p : points)
    if (dot(normal, p) <= dot(normal, *lowest) + tolerance) low.push_back(p);
  const auto farthest = [&low](const auto& measure) {
    return *std::max_element(low.begin(), low.end(),
                             [&](const auto& p, const auto& q) { return measure(p) < measure(q); });
  };
  const vec3<> a = *lowest, b = farthest([&a](const vec3<>&p) { return dot(p - a, p - a); });
  const double length = std::sqrt(dot(b - a, b - a));
  std::vector<vec3<>> chosen{a};
  if (!(length > tolerance)) return chosen;
  chosen.push_back(b);
  for (const double side : {1.0, -1.0}) {
    const auto measure = [&](const vec3<>& p) { return side * dot(normal, cross(b - a, p - a)); };  // (1)
    const vec3<> c = farthest(measure);
    if (measure(c) > tolerance * length) chosen.push_back(c);
  }
  return chosen;
}

}  // namespace kte::detail
