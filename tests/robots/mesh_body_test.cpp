#include <kte/math/principal_moments.hpp>
#include <kte/robots/detail/mesh_edges.hpp>
#include <kte/robots/detail/mesh_fit.hpp>
#include <kte/robots/detail/mesh_hull.hpp>

#include <numbers>

#include "catch.hpp"

namespace mesh_body_test {

using namespace kte;
using namespace kte::detail;
using test::says;

using faces = std::vector<std::array<std::uint32_t, 3>>;

triangle_mesh box_mesh(const vec3<>& half, const vec3<>& at) {
  triangle_mesh m;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      for (const double z : {-1.0, 1.0})
        m.vertices.push_back({at.x + half.x * x, at.y + half.y * y, at.z + half.z * z});
  m.faces = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 4, 5}, {0, 5, 1},
             {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
  return m;
}
/// A prism along z between two heights, with its top face cut into these triangles.
triangle_mesh prism(const std::vector<std::array<double, 2>>& outline, const faces& top, double low, double high) {
  triangle_mesh m;
  const auto n = static_cast<std::uint32_t>(outline.size());
  for (const double z : {low, high})
    for (const auto& [x, y] : outline) m.vertices.push_back({x, y, z});
  for (const auto& [a, b, c] : top) m.faces.push_back({a, c, b}), m.faces.push_back({a + n, b + n, c + n});
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    m.faces.push_back({i, j, j + n}), m.faces.push_back({i, j + n, i + n});
  }
  return m;
}
/// All numbers of an L and an H of steel plates; those of the H are exact in float.
triangle_mesh l_profile() {
  auto m = prism({{0.1, 0.2}, {0.5, 0.2}, {0.5, 0.3}, {0.25, 0.3}, {0.25, 0.7}, {0.1, 0.7}},
                 {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}, -0.3, 0);
  for (auto& v : m.vertices) v = {float(v.x), float(v.y), float(v.z)};
  return m;
}
triangle_mesh h_profile() {
  std::vector<std::array<double, 2>> outline{{-8, -8}, {8, -8}, {8, -6}, {2, -6}, {2, 6},   {8, 6},
                                             {8, 8},   {-8, 8}, {-8, 6}, {-2, 6}, {-2, -6}, {-8, -6}};
  for (auto& [x, y] : outline) x /= 32, y *= 5.0 / 128;
  return prism(outline,
               {{0, 1, 2},
                {0, 2, 3},
                {0, 3, 10},
                {0, 10, 11},
                {3, 4, 9},
                {3, 9, 10},
                {4, 5, 6},
                {4, 6, 7},
                {4, 7, 9},
                {7, 8, 9}},
               -0.5, 0.5);
}
/// An irregular octahedron, as points, none of them inside.
triangle_mesh octahedron() {
  return {{{1, 0, 0}, {-0.75, 0.125, 0}, {0, 0.5, 0.125}, {0.125, -0.5, 0}, {0, 0, 0.25}, {0, -0.125, -0.375}},
          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}
triangle_mesh turned_round(triangle_mesh m) {
  for (auto& f : m.faces) std::swap(f[1], f[2]);
  return m;
}

void check_near(const rigid_body<>& b, double mass, const vec3<>& com, const sym3<>& i, double relative) {
  const double length = std::sqrt(dot(com, com)) + std::sqrt(trace(i) / mass), inertia = relative * trace(i);
  CHECK(b.mass == within_relative(mass, relative));
  CHECK((b.com.x == within(com.x, relative * length) && b.com.y == within(com.y, relative * length) &&
         b.com.z == within(com.z, relative * length)));
  CHECK((b.inertia.xx == within(i.xx, inertia) && b.inertia.yy == within(i.yy, inertia) &&
         b.inertia.zz == within(i.zz, inertia)));
  CHECK((b.inertia.xy == within(i.xy, inertia) && b.inertia.xz == within(i.xz, inertia) &&
         b.inertia.yz == within(i.yz, inertia)));
}
/// Against principal moments.
void check_measured(const rigid_body<>& b, double mass, const vec3<>& com, const std::array<double, 3>& moments,
                    double relative) {
  const auto m = principal_moments(b.inertia);
  CHECK(b.mass == within_relative(mass, relative));
  CHECK(
      (b.com.x == within(com.x, relative) && b.com.y == within(com.y, relative) && b.com.z == within(com.z, relative)));
  for (std::size_t k = 0; k < 3; ++k) CHECK(m[k] == within_relative(moments[k], relative));
}

TEST_CASE("mass properties of meshes with closed forms") {
  // m/3 (b^2 + c^2) of a box, for all that is convex, near the origin and far from it
  for (const double far : {0.0, 1.0, 4096.0, 1048576.0})
    for (const auto kind : {mesh_inertia::legacy, mesh_inertia::exact, mesh_inertia::convex})
      check_near(mesh_body(box_mesh({0.125, 0.25, 0.5}, {far, -far, 2 * far}), kind, 1000), 125, {far, -far, 2 * far},
                 sym3<>{125 * 0.3125 / 3, 0, 0, 125 * 0.265625 / 3, 0, 125 * 0.078125 / 3}, 1e-14);

  for (const auto kind : {mesh_inertia::legacy, mesh_inertia::exact})  // a needle
    CHECK(moments_of(box_mesh({1e-9, 2e-9, 1}, {}), kind).amount == within_relative(1.6e-17, 1e-14));

  // a tetrahedron with edges a, b, c along the axes: V = abc/6, centre (a, b, c)/4,
  // I_xx = 3/80 m (b^2 + c^2), I_xy = m a b/80
  const triangle_mesh corner{{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}},
                             {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  check_near(mesh_body(corner, mesh_inertia::exact, 80), 80, {0.25, 0.5, 0.75}, sym3<>{39, 2, 3, 30, 6, 15}, 1e-15);
  CHECK(moments_of(corner, mesh_inertia::exact).amount == within(1, 1e-15));

  // a shell: six plates of a cube with edges 2: 10/9 m about each axis
  check_near(mesh_body(box_mesh({1, 1, 1}, {5, 0, 0}), mesh_inertia::shell, 0.75), 18, {5, 0, 0},
             sym3<>{20, 0, 0, 20, 0, 20}, 1e-15);

  // points of a ball: what its hull lacks falls with the square of their distance
  triangle_mesh ball{{{0, 0, 1}, {0, 0, -1}}, {}};
  const int n = 48;
  for (int i = 1; i < n; ++i)
    for (int j = 0; j < 2 * n; ++j) {
      const double a = i * std::numbers::pi / n, b = j * std::numbers::pi / n;
      ball.vertices.push_back({std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)});
    }
  const double whole = 4 * std::numbers::pi / 3;
  const auto b = mesh_body(ball, mesh_inertia::exact, 1);
  CHECK(b.mass < whole);
  check_near(b, whole, {0, 0, 0}, sym3<>{0.4 * whole, 0, 0, 0.4 * whole, 0, 0.4 * whole}, 5.0 / (n * n));
  CHECK(open_edge(convex_hull(ball.vertices)).empty());
}

/// An ellipsoid with half axes 1, 1.5, 0.7 of squares along its meridians, whose corners are rounded to T.
template <class T>
triangle_mesh ellipsoid(std::uint32_t n) {
  triangle_mesh m;
  const std::uint32_t around = 2 * n, south = around * (n - 1);
  const auto place = [&](double a, double b) {
    const auto cut = [](double x) { return static_cast<double>(static_cast<T>(x)); };
    m.vertices.push_back(
        {cut(std::sin(a) * std::cos(b)), cut(1.5 * std::sin(a) * std::sin(b)), cut(0.7 * std::cos(a))});
  };
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return i * around + j % around; };
  for (std::uint32_t i = 1; i < n; ++i)
    for (std::uint32_t j = 0; j < around; ++j) place(i * std::numbers::pi / n, j * std::numbers::pi / n);
  place(std::numbers::pi, 0), place(0, 0);
  for (std::uint32_t j = 0; j < around; ++j) {
    m.faces.push_back({south + 1, at(0, j), at(0, j + 1)}), m.faces.push_back({south, at(n - 2, j + 1), at(n - 2, j)});
    for (std::uint32_t i = 0; i + 2 < n; ++i) {
      m.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      m.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return m;
}
/// The twelve pentagons of five neighbours each among the corners of an icosahedron, which pass through each other: no
/// edge is concave.
triangle_mesh great_dodecahedron() {
  triangle_mesh m;
  const double g = std::numbers::phi;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-g, g}) m.vertices.insert(m.vertices.end(), {{0, x, y}, {x, y, 0}, {y, 0, x}});
  for (std::uint32_t i = 0; i < 12; ++i) {
    const auto p = m.vertices[i];
    std::vector<std::pair<double, std::uint32_t>> ring;
    const vec3<> x = cross(p, vec3<>{1, 2, 3}), y = cross(p, x);
    vec3<> centre{};
    for (std::uint32_t j = 0; j < 12; ++j)
      if (const auto& q = m.vertices[j]; dot(p, q) > 0 && dot(p, q) < 2) {
        ring.emplace_back(std::atan2(dot(y, q) / std::sqrt(dot(p, p)), dot(x, q)), j);
        centre = centre + 0.2 * q;
      }
    std::sort(ring.begin(), ring.end());
    for (std::size_t k = 0; k < 5; ++k) m.faces.push_back({12 + i, ring[k].second, ring[(k + 1) % 5].second});
    m.vertices.push_back(centre);
  }
  return m;
}

TEST_CASE("convex surfaces are found by their edges") {
  CHECK(is_convex(box_mesh({0.125, 0.25, 0.5}, {4096, 0, 0})));
  CHECK(is_convex(octahedron()));
  CHECK((is_convex(ellipsoid<double>(48)) && is_convex(ellipsoid<float>(48))));
  CHECK_FALSE((is_convex(l_profile()) || is_convex(h_profile()) || is_convex({})));
  const auto changed = [](std::size_t corner, double factor) {
    auto m = ellipsoid<double>(48);
    m.vertices[corner] = factor * m.vertices[corner];
    return is_convex(m);
  };
  CHECK_FALSE((changed(2000, 0.99) || changed(2000, 1.01) || changed(2000, 3)));
  CHECK((changed(2000, 1 - 1e-8) && changed(2000, 1 + 1e-8)));
  CHECK_FALSE(is_convex(turned_round(octahedron())));
  auto open = octahedron(), twice = open, apart = open;
  open.faces.pop_back();
  twice.faces.insert(twice.faces.end(), open.faces.begin(), open.faces.end());
  for (const auto& v : octahedron().vertices) apart.vertices.push_back(v + vec3<>{9, 0, 0});
  for (const auto& [a, b, c] : octahedron().faces) apart.faces.push_back({a + 6, b + 6, c + 6});
  CHECK_FALSE((is_convex(open) || is_convex(twice) || is_convex(apart)));
  const auto star = great_dodecahedron();
  CHECK((star.faces.size() == 60 && open_edge(star).empty() && !points_inwards(star)));
  CHECK_FALSE(is_convex(star));
}

TEST_CASE("mass properties of meshes as MuJoCo has them") {
  // Measured with MuJoCo 4.0.0, from float vertices, whose rounding bounds the agreement for the L.
  check_measured(mesh_body(h_profile(), mesh_inertia::legacy, 1000), 253.90625, {0, 0, 0},
                 {28.06886037190755, 20.879109700520836, 14.442761739095053}, 1e-14);
  check_measured(mesh_body(h_profile(), mesh_inertia::exact, 1000), 136.71875, {0, 0, 0},
                 {18.34710439046223, 13.097127278645829, 8.657773335774738}, 1e-14);
  check_measured(mesh_body(h_profile(), mesh_inertia::convex, 1000), 312.5, {0, 0, 0},
                 {36.214192708333336, 32.552083333333336, 16.682942708333332}, 1e-14);
  const auto l = l_profile();
  check_measured(mesh_body(l, mesh_inertia::legacy, 1000), 34.476023755169244,
                 {0.24099875630634657, 0.3895204640955812, -0.1500000059604645},
                 {1.1105282937911867, 1.1009570261049075, 0.48071299088598657}, 1e-12);
  check_measured(mesh_body(l, mesh_inertia::exact, 1000), 30.000000968575474,
                 {0.22500000540167092, 0.3999999936670068, -0.15000000596046448},
                 {1.0270978602158165, 1.0062499932789526, 0.429152183354557}, 1e-12);
  // faces that point inwards are the same to legacy, and have no volume to exact
  CHECK(points_inwards(turned_round(l)));
  CHECK_FALSE(points_inwards(l));
  CHECK(mesh_body(turned_round(l), mesh_inertia::legacy, 1) == mesh_body(l, mesh_inertia::legacy, 1));
  CHECK_THROWS_MATCHES(moments_of(turned_round(l), mesh_inertia::exact), bad_argument, says("point inwards"));
  // a surface that is open, or with a face turned round
  auto open = l;
  open.faces.pop_back();
  check_measured(mesh_body(open, mesh_inertia::exact, 1000), 26.555337008856654,
                 {0.23778655851008282, 0.3859041425693384, -0.15534862949255276},
                 {0.9267603843038081, 0.8997676859684467, 0.4003554476192106}, 1e-12);
  check_measured(mesh_body(open, mesh_inertia::legacy, 1000), 30.280010580414427,
                 {0.2520757586950067, 0.3783168665574653, -0.15477942609416187},
                 {0.9839439867598135, 0.9600347848610021, 0.4438335005317387}, 1e-12);
  CHECK_THAT(open_edge(open), test::contains_text("has no face on one of its sides"));
  auto turned = l;
  std::swap(turned.faces.back()[1], turned.faces.back()[2]);
  CHECK(mesh_body(turned, mesh_inertia::exact, 1000).mass == within_relative(22.38770218621839, 2e-7));
  CHECK_FALSE(open_edge(turned).empty());
  CHECK(open_edge(l).empty());
  // points without faces
  const triangle_mesh points{l.vertices, {}};
  check_measured(mesh_body(points, mesh_inertia::legacy, 1000), 45.00000067055222,
                 {0.2611111134566643, 0.4111111078273369, -0.15000000596046448},
                 {1.32013885743778, 1.2927812363075237, 0.7023576848327219}, 1e-12);
  CHECK(mesh_body(points, mesh_inertia::exact, 1000) == mesh_body(l, mesh_inertia::convex, 1000));
}

TEST_CASE("meshes that are no bodies are refused") {
  using enum mesh_inertia;
  const triangle_mesh flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}};
  CHECK_THROWS_MATCHES(moments_of(flat, exact), bad_argument, says("the mesh has no volume"));
  CHECK_THROWS_MATCHES(moments_of(flat, legacy), bad_argument, says("the mesh has no volume"));
  CHECK_THROWS_MATCHES(moments_of(flat, convex), bad_argument, says("its vertices are in one plane"));
  CHECK(mesh_body(flat, shell, 12).inertia == sym3<>{1, 0, 0, 1, 0, 2});
  CHECK_THROWS_MATCHES(moments_of({flat.vertices, {{0, 0, 1}}}, shell), bad_argument, says("have no area"));
  CHECK_THROWS_MATCHES(moments_of({{}, {}}, exact), bad_argument, says("its vertices are in one plane"));
  CHECK_THROWS_MATCHES(moments_of({flat.vertices, {{0, 1, 4}}}, exact), bad_argument,
                       says("index 4 of face 0 is out of range: the mesh has 4 vertices"));
  CHECK_THROWS_MATCHES(moments_of({{{0, 0, 0}, {NAN, 0, 0}}, {}}, convex), bad_argument, says("vertex 1 of the mesh"));
  const auto huge = box_mesh({1e120, 1e120, 1e120}, {});
  CHECK_THROWS_MATCHES(moments_of(huge, exact), bad_argument, says("too large"));
  CHECK_THROWS_MATCHES(mesh_body(octahedron(), exact, -1), bad_argument, says("density"));
}

TEST_CASE("shapes fitted to meshes as MuJoCo fits them") {
  using form = robot_shape::form;
  // measured with MuJoCo 4.0.0 for the L
  struct fit {
    form is;
    bool aabb;
    vec3<> half;
    vec3<> at;
  };
  const vec3<> mass{0.24099875630634657, 0.3895204640955812, -0.1500000059604645},
      box{0.21672288877120563, 0.4053617340244362, -0.15000000596046445};
  const auto l = l_profile();
  for (const auto& [is, aabb, half, at] :
       {fit{form::sphere, false, {0.1878804053814973, 0, 0}, mass},
        fit{form::sphere, true, {0.3148281267512846, 0, 0}, box},
        fit{form::capsule, false, {0.14461337076034098, 0.20210778924363948, 0}, mass},
        fit{form::capsule, true, {0.1998950668337161, 0.11493305991756847, 0}, box},
        fit{form::cylinder, false, {0.14461337076034098, 0.27441447462380997, 0}, mass},
        fit{form::cylinder, true, {0.1998950668337161, 0.3148281267512846, 0}, box},
        fit{form::box, false, {0.1431735610254121, 0.14605318049526986, 0.27441447462380997}, mass},
        fit{form::ellipsoid, true, {0.1998950668337161, 0.15000000596046467, 0.3148281267512846}, box}}) {
    const auto g = fit_mesh(l, mesh_inertia::legacy, is, aabb);
    CHECK(
        (g.half.x == within(half.x, 1e-13) && g.half.y == within(half.y, 1e-13) && g.half.z == within(half.z, 1e-13)));
    const auto off = g.pose.position - at;
    CHECK(std::sqrt(dot(off, off)) == within(0, 1e-13));
    // R is a rotation, and takes the principal axes to those of the mesh
    const auto m = moments_of(l, mesh_inertia::legacy);
    const auto own = congruence(transpose(g.pose.rotation), m.inertia);
    CHECK((own.xx >= own.yy && own.yy >= own.zz));
    CHECK((own.xy == within(0, 1e-16) && own.xz == within(0, 1e-16) && own.yz == within(0, 1e-16)));
    const auto unit = g.pose.rotation * transpose(g.pose.rotation);
    CHECK((unit.x.x == within(1, 1e-15) && unit.x.y == within(0, 1e-15) && unit.y.z == within(0, 1e-15)));
    CHECK(dot(cross(g.pose.rotation.x, g.pose.rotation.y), g.pose.rotation.z) == within(1, 1e-15));
  }
  // a box is its own fit, and a cube keeps its axes
  const auto g = fit_mesh(box_mesh({0.5, 0.25, 0.125}, {1, 2, 3}), mesh_inertia::exact, form::box, true);
  CHECK((g.half == vec3<>{0.125, 0.25, 0.5} && g.pose.position == vec3<>{1, 2, 3}));
  CHECK(fit_mesh(box_mesh({0.1, 0.1, 0.1}, {0.3, 0.7, 0.9}), mesh_inertia::exact, form::box, true).half.x ==
        within(0.1, 1e-15));
  CHECK_THROWS_MATCHES(fit_mesh(l, mesh_inertia::exact, form::plane, false), bad_argument, says("can be fitted with"));
}

TEST_CASE("meshes are placed as MuJoCo places assets") {
  const mat3<vec3<>> turn{{1, 0, 0}, {0, 0.28, -0.96}, {0, 0.96, 0.28}};
  const auto placed = placed_mesh({{{1, 2, 3}}, {{0, 1, 2}}}, {0, 1, 1}, turn, {2, -1, 10});
  CHECK(placed.vertices[0].x == 2);
  CHECK(placed.vertices[0].y == within(-(0.28 + 1.92), 1e-15));
  CHECK(placed.vertices[0].z == within(10 * (-0.96 + 0.56), 1e-14));
  CHECK(placed.faces[0] == std::array<std::uint32_t, 3>{0, 2, 1});  // a mirror image
  const robot_pose none;
  CHECK(placed_mesh({{}, {{0, 1, 2}}}, {}, none.rotation, {-1, -1, 1}).faces[0] ==
        std::array<std::uint32_t, 3>{0, 1, 2});
  CHECK(mesh_body(placed_mesh(l_profile(), {}, none.rotation, {-1, 1, 1}), mesh_inertia::exact, 1000).mass ==
        within_relative(29.999999459832885, 1e-7));
}

}  // namespace mesh_body_test
