#include <kte/io/bytes.hpp>
#include <kte/robots/description.hpp>
#include <kte/view/detail/chain_parts.hpp>

#include "../src/view/page_limits.hpp"
#include "../src/view/scene_builder.hpp"
#include "../src/view/triangles.hpp"
#include "catch.hpp"
#include "robots/folder.hpp"

namespace mesh_test {

using namespace kte;
using kte::test::contains_text, kte::test::folder;

const std::string tetra = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

/// A ball of radius 1 of n by 2 n triangles twice.
detail::triangle_mesh ball(std::uint32_t n) {
  detail::triangle_mesh m;
  const auto at = [&m](double theta, double phi) {
    m.vertices.push_back({std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
    return static_cast<std::uint32_t>(m.vertices.size() - 1);
  };
  const double step = std::acos(-1.0) / n;
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < 2 * n; ++j) {
      const auto a = at(i * step, j * step), b = at((i + 1) * step, j * step), c = at((i + 1) * step, (j + 1) * step),
                 d = at(i * step, (j + 1) * step);
      m.faces.push_back({a, b, c}), m.faces.push_back({a, c, d});
    }
  return m;
}

/// A frame "link" with one shape, of a robot in a folder.
scene with_shape(const robot_shape& shape, const folder& in, bool collision = false,
                 const std::vector<std::string>& search_path = {}) {
  detail::chain_parts parts;
  scene s;
  s.frames.emplace_back().name = "link";
  parts.file = (in.path / "urdf" / "robot.urdf").string(), parts.search_path = search_path;
  parts.shapes.push_back({&shape, "link", collision, ""});
  view::add_shapes(s, parts);
  return s;
}
robot_shape mesh_of(const std::string& name) {
  robot_shape x;
  x.is = robot_shape::form::mesh, x.mesh = name;
  return x;
}

TEST_CASE("vertices that are equal are one, and triangles without area are left out") {
  detail::triangle_mesh m;
  m.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, 0}, {0, 1, 1e-60}, {0, 0, 1}, {1e300, 0, 0}};
  m.faces = {{0, 1, 2}, {3, 4, 5}, {0, 3, 1}, {0, 1, 6}};
  const auto s = view::merged(m);
  CHECK(s.positions.size() == 4 * 3);
  CHECK(s.indices == std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3});
}

TEST_CASE("meshes are made of fewer triangles, within their bytes and near their surface") {
  const auto m = view::merged(ball(100));
  for (const std::size_t bytes : {1000000, 100000, 10000, 2000}) {
    const auto s = view::simplified(m, bytes);
    CHECK(view::text_bytes(s) <= bytes);
    CHECK(view::text_bytes(s) > bytes / 4);
    double nearest = 1;
    for (std::size_t i = 0; i < s.positions.size(); i += 3)
      nearest = std::min<double>(nearest, std::hypot(s.positions[i], s.positions[i + 1], s.positions[i + 2]));
    CHECK(nearest > (bytes > 50000 ? 0.99 : 0.7));
    for (const auto i : s.indices) CHECK(3 * i < s.positions.size());
  }
  CHECK(view::simplified(m, 10).indices.empty());
}

TEST_CASE("a page shares its bytes among meshes, and says so") {
  scene s;
  s.frames.emplace_back().name = "link", s.frames[0].track = 0, s.tracks = 1;
  for (const std::uint32_t n : {3, 60, 80}) {
    s.meshes.push_back(view::merged(ball(n)));
    s.meshes.back().name = "ball" + std::to_string(n);
    s.shapes.emplace_back().frame = 0, s.shapes.back().mesh = static_cast<int>(s.meshes.size()) - 1;
  }
  const auto whole = view::within_limits(s, {});
  CHECK((whole.notes.empty() && whole.meshes[2].indices == s.meshes[2].indices));
  const auto cut = view::within_limits(s, {.mesh_bytes = 100000});
  std::size_t sum = 0;
  for (const auto& m : cut.meshes) sum += view::text_bytes(m);
  CHECK((sum <= 100000 && sum > 40000));
  CHECK(cut.meshes[0].indices == s.meshes[0].indices);
  REQUIRE(cut.notes.size() == 2);
  CHECK_THAT(cut.notes[1], contains_text("mesh 'ball80' is drawn with ") &&
                               contains_text(" triangles, and all meshes of a page have 100000 bytes"));
  const auto none = view::within_limits(s, {.mesh_bytes = 100});
  CHECK(none.shapes.empty());
  CHECK_THAT(none.notes.at(0),
             contains_text("mesh 'ball3' is not drawn: it has " + std::to_string(s.meshes[0].indices.size() / 3)));
}

TEST_CASE("meshes are found around the robot's file, in packages and folders to search") {
  const folder a, b;
  a.write("urdf/near.obj", tetra), a.write("meshes/above.obj", tetra), a.write("pkg/meshes/packed.obj", tetra);
  a.write("meshes/renamed.obj", tetra), b.write("far.obj", tetra);
  for (const std::string name :
       {"near.obj", "../meshes/above.obj", "meshes/above.obj", "package://pkg/meshes/packed.obj",
        "package://other_name/meshes/renamed.obj", "model://pkg/meshes/packed.obj", "far.obj"}) {
    INFO(name);
    const auto s = with_shape(mesh_of(name), a, false, {b.path.string()});
    REQUIRE(s.meshes.size() == 1);
    CHECK(s.notes.empty());
    CHECK((s.shapes.size() == 1 && s.shapes[0].type == "mesh" && s.shapes[0].mesh == 0));
    CHECK(s.meshes[0].indices.size() == 12);
  }
  CHECK(with_shape(mesh_of("file://" + (b.path / "far.obj").string()), a).meshes.size() == 1);
  CHECK_THAT(with_shape(mesh_of("lost.obj"), a).notes.at(0),
             contains_text("mesh 'lost.obj' is not drawn: it is not found"));
}

TEST_CASE("meshes are scaled and read once; mirrored ones keep their outside") {
  const folder in;
  in.write("urdf/t.obj", tetra);
  detail::chain_parts parts;
  scene s;
  s.frames.emplace_back().name = "link";
  parts.file = (in.path / "urdf" / "robot.urdf").string();
  auto once = mesh_of("t.obj"), twice = once, mirrored = once;
  twice.scale = {0.001, 0.002, 0.003}, mirrored.scale = {-1, 1, 1};
  for (const auto* x : {&once, &twice, &once, &mirrored}) parts.shapes.push_back({x, "link", false, ""});
  parts.shapes.push_back({&once, "nowhere", false, ""});
  view::add_shapes(s, parts);
  REQUIRE(s.meshes.size() == 3);
  CHECK((s.shapes.size() == 4 && s.shapes[2].mesh == 0));
  CHECK((s.meshes[1].positions[3] == 0.001f && s.meshes[1].positions[3 * 3 + 2] == 0.003f));
  CHECK(std::vector(s.meshes[2].indices.begin(), s.meshes[2].indices.begin() + 3) ==
        std::vector<std::uint32_t>{0, 1, 2});
  CHECK_THAT(s.notes.at(0),
             contains_text("visual mesh of 'nowhere' is not drawn: the chain has no frame of this name"));
}

TEST_CASE("meshes that cannot be drawn are notes by name") {
  const folder in;
  in.write("urdf/bad.obj", "v 0 0 0\nf 1 2 3\n"), in.write("urdf/cut.stl", std::string(100, 'x'));
  in.write("urdf/empty.obj", ""), in.write("urdf/points.obj", "v 0 0 0\n"),
      in.write("urdf/huge.obj", "v 1e300 0 0\nv 0 0 0\nv 0 1 0\nf 1 2 3\n");
  const auto note = [&in](const std::string& name) {
    const auto s = with_shape(mesh_of(name), in);
    CHECK((s.meshes.empty() && s.shapes.empty() && s.notes.size() == 1));
    return s.notes.at(0);
  };
  CHECK_THAT(note("body.dae"), contains_text("mesh 'body.dae' is not drawn: only .stl, .obj and .msh are read"));
  CHECK_THAT(note("bad.obj"), contains_text("index 2 is out of range"));
  CHECK_THAT(note("cut.stl"), contains_text("facets of binary STL need"));
  CHECK_THAT(note("empty.obj"), contains_text("has no vertices"));
  CHECK_THAT(note("points.obj"), contains_text("it has vertices, but no faces"));
  CHECK_THAT(note("huge.obj"), contains_text("without area, or too large for floats"));
  CHECK_THAT(note(""), contains_text("the file does not name one"));
}

TEST_CASE("shapes of a file with their sizes and colours") {
  const folder in;
  robot_shape x;
  const auto drawn = [&](robot_shape::form is) {
    x.is = is, x.size = {1, 2, 3};
    auto s = with_shape(x, in, true);
    REQUIRE(s.shapes.size() == 1);
    CHECK(s.shapes[0].collision);
    return s.shapes[0].type + " " + std::to_string(s.shapes[0].size.size()) + " " +
           std::to_string(s.shapes[0].size.at(0));
  };
  using enum robot_shape::form;
  CHECK(drawn(box) == "box 3 1.000000");
  CHECK(drawn(sphere) == "sphere 1 1.000000");
  CHECK(drawn(cylinder) == "cylinder 2 1.000000");
  CHECK(drawn(capsule) == "capsule 2 1.000000");
  CHECK(drawn(ellipsoid) == "ellipsoid 3 1.000000");
  CHECK(drawn(plane) == "plane 2 2.000000");
  x.is = none, x.name = "hills", x.line = 7;
  CHECK_THAT(with_shape(x, in).notes.at(0),
             contains_text("line 7: shape 'hills' of 'link' is not drawn: it is a height field"));
  x.is = box, x.rgba = {0.5, 2, -1, 0.25};
  CHECK(with_shape(x, in).shapes.at(0).colour == std::vector{0.5, 1.0, 0.0, 0.25});
  x.rgba = {0.5, 0.5, 0.5};
  CHECK(with_shape(x, in).shapes.at(0).colour == std::vector{0.5, 0.5, 0.5, 1.0});
  x.size.x = INFINITY;
  CHECK_THAT(with_shape(x, in).notes.at(0), contains_text("its numbers are not finite"));
}

TEST_CASE("where nothing to see can be drawn, shapes of collision are") {
  const folder in;
  detail::chain_parts parts;
  scene s;
  s.frames.emplace_back().name = "link";
  parts.file = (in.path / "robot.urdf").string();
  const auto dae = mesh_of("body.dae");
  robot_shape box;
  box.is = robot_shape::form::box, box.size = {1, 1, 1};
  parts.shapes = {{&dae, "link", false, ""}, {&box, "link", true, ""}};
  view::add_shapes(s, parts);
  REQUIRE(s.shapes.size() == 1);
  CHECK(!s.shapes[0].collision);
  CHECK_THAT(s.notes.at(1), contains_text("'link' is drawn by its collision shapes"));
}

TEST_CASE("notes have no folders of this machine") {
  const folder in;
  in.write("urdf/parts/bad.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 z\n");
  const auto note_of = [&in](const std::string& name) {
    const auto s = with_shape(mesh_of(name), in);
    REQUIRE(s.notes.size() == 1);
    CHECK(not_drawn(s) == s.notes);
    CHECK(s.notes[0].find(in.path.string()) == std::string::npos);
    return s.notes[0];
  };
  const auto file = [&in](const char* name) { return (in.path / name).string(); };
  CHECK_THAT(note_of("parts/bad.stl"), contains_text("mesh 'parts/bad.stl' is not drawn: bad.stl:4: "));
  CHECK_THAT(note_of(file("urdf/parts/bad.stl")), contains_text("mesh 'parts/bad.stl' is not drawn: bad.stl:4: "));
  CHECK_THAT(note_of("file://" + file("urdf/parts/none.stl")), contains_text("mesh 'parts/none.stl' is not drawn"));
  CHECK_THAT(note_of(file("elsewhere/none.stl")), contains_text("mesh 'none.stl' is not drawn: it is not found"));
}

}  // namespace mesh_test
