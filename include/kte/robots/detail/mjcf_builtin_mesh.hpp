#pragma once

#include <kte/robots/detail/triangle_mesh.hpp>
#include <kte/robots/detail/xml_item.hpp>

#include <map>
#include <numbers>

/// Meshes that MJCF makes from parameters (builtin), of unit size. Convex ones are points, which stand for their hull.
namespace kte::detail {

/// A point on the unit sphere.
inline vec3<> on_sphere(const vec3<>& p) { return (1 / std::sqrt(dot(p, p))) * p; }

/// The points of an icosahedron whose faces are divided into four `times` times.
inline std::vector<vec3<>> icosphere(int times) {
  const double g = std::numbers::phi;
  std::vector<vec3<>> points;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-g, g})
      for (const auto& p : {vec3<>{x, y, 0}, vec3<>{0, x, y}, vec3<>{y, 0, x}}) points.push_back(on_sphere(p));
  // the distance of neighbours falls with each division; by its square, all pairs below 1.5 times it are edges
  double edge = 4 / (1 + g * g);
  for (int k = 0; k < times; ++k, edge /= 3.5) {
    const auto n = points.size();
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const vec3<> d = points[i] - points[j];
        if (dot(d, d) < 1.5 * edge) points.push_back(on_sphere(points[i] + points[j]));
      }
  }
  return points;
}
/// The points of the upper half of an octahedron, with edges divided into n, on the unit sphere, and the centre.
inline std::vector<vec3<>> half_sphere(int n) {
  std::vector<vec3<>> points{{0, 0, 0}};
  for (int x = -n; x <= n; ++x)
    for (int y = -(n - std::abs(x)); y <= n - std::abs(x); ++y)
      points.push_back(on_sphere({double(x), double(y), double(n - std::abs(x) - std::abs(y))}));
  return points;
}
/// Two polygons of n points at z = -1 and 1, with radii 1 and r.
inline std::vector<vec3<>> cone(int n, double r) {
  std::vector<vec3<>> points;
  for (int i = 0; i < n; ++i) {
    const double a = 2 * std::numbers::pi * i / n, c = std::cos(a), s = std::sin(a);
    points.push_back({c, s, -1}), points.push_back({r * c, r * s, 1});
  }
  return points;
}
/// |x|^e with the sign of x.
inline double signed_power(double x, double e) {
  return std::abs(x) < 1e-12 ? 0 : std::copysign(std::pow(std::abs(x), e), x);
}
/// The point at the angles u, around z, and v of a superellipsoid, or of a supertorus with the radius r of its tube:
///   (c_v c_u, c_v s_u, s_v),   ((1 + r c_v) c_u, (1 + r c_v) s_u, r s_v)     (1)
/// with c and s the cosine and sine raised to e for u, and to f for v, with their signs.
inline vec3<> superquadric(double u, double v, double e, double f, double r = 0) {
  const double c = signed_power(std::cos(v), f), s = signed_power(std::sin(v), f);
  const double across = r > 0 ? 1 + r * c : c;
  return {across * signed_power(std::cos(u), e), across * signed_power(std::sin(u), e), r > 0 ? r * s : s};  // (1)
}
/// The triangles of a grid of points, in `rows` and `columns`, which is closed along columns, and along rows too if it
/// has as many rows of faces.
inline void close_grid(triangle_mesh& m, int rows, int columns, int rows_of_faces) {
  const auto at = [&](int i, int j) { return std::uint32_t((i % rows) * columns + j % columns); };
  for (int i = 0; i < rows_of_faces; ++i)
    for (int j = 0; j < columns; ++j) {
      m.faces.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      m.faces.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
}
inline triangle_mesh supersphere(int n, double e, double f) {
  triangle_mesh m;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j < n; ++j)
      m.vertices.push_back(
          superquadric((2.0 * j / n - 1) * std::numbers::pi, (1.0 * i / n - 0.5) * std::numbers::pi, e, f));
  close_grid(m, n + 1, n, n);
  return m;
}
inline triangle_mesh supertorus(int n, double r, double e, double f) {
  triangle_mesh m;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      m.vertices.push_back(superquadric(2 * std::numbers::pi * j / n, 2 * std::numbers::pi * i / n, e, f, r));
  close_grid(m, n, n, n);
  return m;
}

/// The mesh of an asset with `builtin` and `params`: sphere (divisions), hemisphere (divisions), cone (sides, upper
/// radius), supersphere (sides, exponents around z and along z), supertorus (sides, radius of the tube, exponents
/// around the ring and the tube). Plates and wedges are surfaces without a volume, and are refused.
inline triangle_mesh mjcf_builtin_mesh(const xml_item& a) {
  struct range {
    std::size_t numbers;
    double least, most;  ///< of the first, a whole number
  };
  static const std::map<std::string, range, std::less<>> known{{"sphere", {1, 0, 4}},
                                                               {"hemisphere", {1, 0, 10}},
                                                               {"cone", {2, 3, 1000}},
                                                               {"supersphere", {3, 3, 300}},
                                                               {"supertorus", {4, 3, 300}}};
  const auto kind = a.text("builtin");
  const auto it = known.find(kind);
  if (it == known.end())
    a.fail("the mass of the builtin mesh '" + excerpt(kind) +
           "' is not read: it is none of sphere, hemisphere, cone, supersphere, supertorus");
  const auto p = a.list("params");
  const auto& [numbers, least, most] = it->second;
  if (p.size() != numbers)
    a.fail("params of a " + kind + " must have " + std::to_string(numbers) + (numbers == 1 ? " number" : " numbers") +
           ", got " + std::to_string(p.size()));
  a.whole(p[0], "the first number of params", least, most);
  for (std::size_t i = 1; i < p.size(); ++i)
    if (!(p[i] >= 0) || (kind != "cone" && p[i] == 0))
      a.fail("number " + std::to_string(i + 1) + " of params must be positive, got " + number(p[i]));
  const int n = static_cast<int>(p[0]);
  if (kind == "sphere") return {icosphere(n), {}};
  if (kind == "hemisphere") return {half_sphere(n + 1), {}};
  if (kind == "cone") return {cone(n, p[1]), {}};
  return kind == "supersphere" ? supersphere(n, p[1], p[2]) : supertorus(n, p[1], p[3], p[2]);
}

}  // namespace kte::detail
