#include <kte/robots/detail/mesh_body.hpp>
#include <kte/robots/detail/mesh_edges.hpp>
#include <kte/robots/detail/mesh_hull.hpp>

#include <numbers>

#include "catch.hpp"

namespace mesh_hull_test {

using namespace kte;
using namespace kte::detail;

TEST_CASE("convex hulls of points that stand in lines, planes and on one another") {
  std::vector<vec3<>> points;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      for (int k = 0; k < 6; ++k)  // of decimals, turned: nearly in planes, twice
        for (int twice = 0; twice < 2; ++twice)
          points.push_back({0.1 * i * 0.8 - 0.1 * j * 0.6, 0.1 * i * 0.6 + 0.1 * j * 0.8, 0.1 * k + 0.01 * i});
  const auto hull = convex_hull(points);
  CHECK(open_edge(hull).empty());
  for (const auto& f : hull.faces)
    for (const auto& p : points) REQUIRE(orientation(points[f[0]], points[f[1]], points[f[2]], p) <= 0);
  CHECK(moments_of(hull, mesh_inertia::exact).amount == within_relative(0.125, 1e-14));
  // Prisms with many corners, upright and turned: the facets made for them are few times those that are left.
  for (const double tilt : {0.0, 0.6}) {
    std::vector<vec3<>> corners;
    for (int i = 0; i < 1000; ++i)
      for (const double z : {0.0, 1.0}) {
        const double a = i * std::numbers::pi / 500, x = std::cos(a), y = std::sin(a), c = std::sqrt(1 - tilt * tilt);
        corners.push_back({c * x - tilt * z, y, tilt * x + c * z});
      }
    hull_builder builder(corners);
    const triangle_mesh prism{corners, builder.build()};
    CHECK(prism.faces.size() == 3996);
    CHECK(builder.made() < 4 * prism.faces.size());
    CHECK(open_edge(prism).empty());
    CHECK(moments_of(prism, mesh_inertia::exact).amount ==
          within_relative(500 * std::sin(std::numbers::pi / 500), 5e-13));
    for (const auto& f : prism.faces)
      for (std::size_t i = 0; i < corners.size(); i += 37)
        if (orientation(corners[f[0]], corners[f[1]], corners[f[2]], corners[i]) > 0)
          FAIL("corner " << i << " is outside");
  }
  // below the rounding of the determinant: 1 + e stands 2^-52 beyond 1
  const double e = 0x1p-52;
  CHECK(orientation({0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {0.3, 0.3, 1 + e}) > 0);
  CHECK(orientation({0.1, 0.1, 0.1}, {0.3, 0.3, 0.3}, {0.7, 0.2, 0.9}, {0.2, 0.2, 0.2}) == 0);
}

}  // namespace mesh_hull_test
