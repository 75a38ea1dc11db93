#include <kte/contact/contact_geometry.hpp>
#include <kte/contact/disc_geometry.hpp>
#include <kte/contact/height_field.hpp>
#include <kte/contact/height_grid.hpp>
#include <kte/contact/surface.hpp>
#include <kte/kte.hpp>
#include <kte/testing/contact_laws.hpp>

#include <numbers>

#include "catch.hpp"
#include "elements/laws.hpp"

namespace contact_geometry_test {

using namespace kte;
using namespace kte::test;

template <kind Dim = kind::frame_3D, class Surface>
auto touching(const Surface& s, double radius, const vec3<>& offset = {}) {
  using surface_type = std::remove_cvref_t<decltype(s.template in<Dim>())>;
  return core::contact_geometry<Dim, surface_type>{s.template in<Dim>(), radius, offset};
}
template <class S, class Geometry>
void check_laws(const Geometry& g, const vec3<>& about, bool is_distance) {
  random_numbers draw(5);
  CHECK(testing::contact_rates_are_derivatives<S>(g, draw, as<S>(about), is_distance) < by_differences<S>);
  CHECK(testing::gap_rate_is_normal_velocity<S>(g, draw, as<S>(about)) < rounding<S>);
}
template <class Geometry>
void check_laws_in_both(const Geometry& g, const vec3<>& about, bool is_distance = true) {
  check_laws<double>(g, about, is_distance);
  check_laws<digits50>(g, about, is_distance);
}

const auto waves = [](const auto& x, const auto& y) {
  using std::cos;
  using std::sin;
  return 0.1 * sin(x) + 0.15 * x * y - 0.2 * cos(y);
};
const auto hill = [](const auto& x) { return 0.3 * x * x - 0.1 * x; };
const auto ellipsoid = [](const auto& p) { return 0.25 * (p.x * p.x) + p.y * p.y + p.z * p.z - 1.0; };

TEST_CASE("rates of gaps and slips are their derivatives") {
  for (const double radius : {0.0, 0.2}) {
    CAPTURE(radius);
    check_laws_in_both(touching(half_space{}, radius), {0, 0, 0.5});
    check_laws_in_both(touching(half_space(vec3{0.6, 0.0, 0.8}), radius), {0, 0, 0.5});
    check_laws_in_both(touching(ball_surface(0.7), radius), {0.4, 0.3, 0.9});
    check_laws_in_both(touching(ball_surface(0.7), radius, {0.1, 0.2, -0.3}), {0.8, 0.6, 1.2});
    check_laws_in_both(touching(bowl_surface(1.7), radius), {0.4, 0.3, 0.9});
    check_laws_in_both(touching(cylinder_surface(0.7), radius), {0.8, 0.5, 0});
    check_laws_in_both(touching(cylinder_surface(0.7, vec3{0, 1, 0}), radius), {0.2, 0, 1});
    check_laws<double>(touching(cylinder_surface(0.7, vec3{0.6, 0.0, 0.8}), radius), {0.2, 1, 0}, true);
    check_laws_in_both(touching(height_field(waves), radius), {0.3, 0.2, 0.2}, radius != 0);
    check_laws_in_both(touching<kind::frame_2D>(height_field(hill), radius), {0.3, 0.2, 0}, radius != 0);
  }
  check_laws_in_both(touching(surface(ellipsoid), 0), {1, 0.5, 0.8}, false);
  check_laws_in_both(core::disc_geometry{half_space{}.in<kind::frame_3D>(), {0, 1, 0}, 0.3}, {0, 0, 0.5});
  check_laws<double>(core::disc_geometry{half_space{}.in<kind::frame_3D>(), {0.6, 0, 0.8}, 0.3}, {0, 0, 0.5}, true);
}

TEST_CASE("gaps, normals and points of contact") {
  using numbers = detail::closing_motion<double>;
  const mat3<vec3<>> upright{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto at = [&](const vec3<>& p) { return numbers{p, upright, {1, 2, 3}, {0.5, 0.25, 0.75}, {}, {}}; };

  const auto plane = touching(half_space{}, 0.2);
  CHECK(plane.gap(at({3, 4, 0.5})) == within(0.3, 1e-15));
  CHECK(near(plane.point(at({3, 4, 0.2})), vec3<>{3, 4, 0}, 1e-15));
  CHECK(near(plane.slip(at({3, 4, 0.2})), vec3<>{1 - 0.2 * 0.25, 2 + 0.2 * 0.5, 3}, 1e-15));
  CHECK(touching<kind::frame_2D>(half_space{}, 0.2).gap(at({3, 0.5, 0})) == within(0.3, 1e-15));

  CHECK(touching(ball_surface(0.5), 0.1).gap(at({0.6, 0, 0.8})) == within(0.4, 1e-15));
  CHECK(near(touching(ball_surface(0.9), 0.1).point(at({0.6, 0, 0.8})), vec3<>{0.54, 0, 0.72}, 1e-15));
  CHECK(touching(bowl_surface(1.5), 0.1).gap(at({0.6, 0, 0.8})) == within(0.4, 1e-15));
  CHECK(near(touching(bowl_surface(1.1), 0.1).point(at({0.6, 0, 0.8})), vec3<>{0.66, 0, 0.88}, 1e-15));
  CHECK(touching(bowl_surface(1.5), 0.1).gap(at({0, 0, 0})) == within(1.4, 1e-15));
  CHECK(touching<kind::frame_2D>(cylinder_surface(0.5, vec3{1, 0, 0}), 0.1).gap(at({7, -0.9, 0})) ==
        within(0.3, 1e-15));
  CHECK(touching(cylinder_surface(0.5), 0.1).gap(at({0.6, 0.8, 7})) == within(0.4, 1e-15));

  CHECK(near(touching(ball_surface(0.9), 0.1, {0.3, 0, 0.4}).point(at({0.3, 0, 0.4})), vec3<>{0.54, 0, 0.72}, 1e-15));

  // A sphere in a parabola y = x^2 at its lowest point, and beside it: (0.5, 0.25) with the normal (-1, 1)/sqrt(2).
  const auto valley = [](const auto& x) { return x * x; };
  const auto in_valley = touching<kind::frame_2D>(height_field(valley), 0.2);
  CHECK(in_valley.gap(at({0, 0.2, 0})) == within(0, 1e-15));
  const double side = 0.2 / std::sqrt(2);
  CHECK(in_valley.gap(at({0.5 - side, 0.25 + side, 0})) == within(0, 1e-15));
  CHECK(near(in_valley.point(at({0.5 - side, 0.25 + side, 0})), vec3<>{0.5, 0.25, 0}, 1e-14));
  CHECK(touching(surface(ellipsoid), 0).gap(at({2, 0, 0})) == within(0, 1e-15));
  CHECK(touching(surface(ellipsoid), 0).gap(at({2.1, 0, 0})) == within(0.1, 0.005));

  // A disc that leans by 30 degrees: its centre is R cos 30 degrees above the ground.
  const core::disc_geometry disc{
      half_space{}.in<kind::frame_3D>(), {0, std::cos(std::numbers::pi / 6), std::sin(std::numbers::pi / 6)}, 0.3};
  const double height = 0.3 * std::cos(std::numbers::pi / 6);
  CHECK(disc.gap(at({0, 0, height})) == within(0, 1e-15));
  CHECK(near(disc.point(at({0, 0, height})), vec3<>{0, 0.3 * std::sin(std::numbers::pi / 6), 0}, 1e-15));
}

TEST_CASE("contacts without a defined point are refused") {
  detail::closing_motion<double> m{{0, 0, 0.01}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {}, {}, {}, {}};
  const core::disc_geometry flat{half_space{}.in<kind::frame_3D>(), {0, 0, 1}, 0.3};
  CHECK(flat.gap(m) == 0.01);
  CHECK(near(flat.point(m), m.position, 0.0));
  CHECK(near(flat.slip(m), m.rotation * m.velocity, 0.0));
  m.position.z = 1e-4;
  CHECK(complaint([&] { (void)flat.point(m); }) ==
        "kte: a disc lies flat on its surface, within 0.001 rad: it has no lowest point; give the body points of the "
        "rim as contacts");
  CHECK(near(flat.place(m).first, m.position, 0.0));  // that of its centre
  CHECK(near(flat.place(m).second, m.rotation * m.velocity, 0.0));
  CHECK(complaint([&] { (void)touching(surface(ellipsoid), 0.1).gap(m); }) ==
        "kte: a sphere touches a surface(f) only if f is a distance, |grad f| = 1 to 1e-6: take a point, or a "
        "height_field");
  auto deep = m;
  deep.position.z = 0.19;
  const auto narrow = [](const auto& x, const auto& y) { return 5.0 * x * x + y * y; };
  CHECK(complaint([&] { (void)touching(height_field(narrow), 0.2).gap(deep); }) ==
        "kte: no point of a height field is nearest to a sphere on it: the radius of the sphere must be below the "
        "radii of curvature of valleys");
}

TEST_CASE("a height through a grid") {
  const auto at = [](double x, double y) { return 0.25 * x - 0.5 * y + 0.125 * x * y; };
  std::vector<double> heights, waves_at;
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j < 12; ++j) {
      heights.push_back(at(-1 + 0.25 * j, 2 + 0.5 * i));
      waves_at.push_back(waves(-1 + 0.25 * j, 2 + 0.5 * i));
    }
  const height_grid::layout place{.x = -1, .y = 2, .step_x = 0.25, .step_y = 0.5, .columns = 12};
  const height_grid plane(place, heights), rough(place, waves_at);
  for (const double x : {-1.0, -0.9, 0.3, 1.7, 1.75})
    for (const double y : {2.0, 3.3, 5.9, 6.0}) CHECK(plane(x, y) == within(at(x, y), 1e-14));
  CHECK(plane(-3.0, 4.0) == within(at(-3, 4), 1e-13));  // beyond the grid along its slopes
  CHECK(plane(0.5, 8.0) == within(at(0.5, 8), 1e-13));
  CHECK(rough(0.25, 3.5) == within(waves(0.25, 3.5), 1e-14));
  CHECK(rough(0.3, 3.7) == within(waves(0.3, 3.7), 1e-3));
  random_numbers draw(8);
  CHECK(testing::contact_rates_are_derivatives<double>(touching(height_field(rough), 0), draw, {0.4, 3.6, 1.0}, false) <
        1e-6);  // of the third derivative, which jumps
  CHECK(complaint([&] {
          height_grid(place, {1, 2, 3});
        }) == "kte: a height_grid needs full rows of heights, two or more in both directions");
  auto flat = place;
  flat.step_x = 0;
  CHECK(complaint([&] { height_grid(flat, heights); }) == "kte: a height_grid needs finite and positive steps");
  heights[5] = not_a_number;
  CHECK(complaint([&] { height_grid(place, heights); }) == "kte: a height_grid needs finite heights");
}

}  // namespace contact_geometry_test
