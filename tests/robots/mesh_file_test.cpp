#include <kte/io/bytes.hpp>
#include <kte/robots/detail/mesh_file.hpp>

#include <limits>

#include "catch.hpp"
#include "io/scratch.hpp"

namespace mesh_file_test {

using namespace kte;
using detail::parse_mesh, test::says;

void append(std::string& out, std::initializer_list<float> numbers) {
  for (const float x : numbers) detail::append_bytes(out, std::bit_cast<std::uint32_t>(x));
}
void append(std::string& out, std::initializer_list<std::uint32_t> numbers) {
  for (const auto x : numbers) detail::append_bytes(out, x);
}
/// Four vertices and four faces, with normals and texture coordinates.
std::string msh(std::uint32_t vertices = 4, std::uint32_t last_index = 3, float x = 0.5f) {
  std::string out;
  append(out, {vertices, 4u, 4u, 4u});
  append(out, {0.f, 0.f, 0.f, x, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 2.f});
  for (int i = 0; i < 20; ++i) append(out, {9.f});
  append(out, {0u, 2u, 1u, 0u, 1u, 3u, 1u, 2u, 3u, 2u, 0u, last_index});
  return out;
}
std::string binary_stl(std::string title, std::uint32_t facets) {
  title.resize(80);
  append(title, {facets});
  append(title, {9.f, 9.f, 9.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 0.1f, 0.f});
  return title + std::string(2, 'x');
}
const std::string facet =
    "facet normal nan 0 1\nouter loop\nvertex 0 0 0\nvertex +1 0 0\nvertex 0 1e-1 0\nendloop\nendfacet\n";

detail::triangle_mesh obj(const std::string& text) { return parse_mesh("a.obj", text); }
detail::triangle_mesh stl(const std::string& text) { return parse_mesh("a.STL", text); }

TEST_CASE("MSH files") {
  const auto m = parse_mesh("a.msh", msh());
  CHECK(m.vertices == std::vector<vec3<>>{{0, 0, 0}, {0.5, 0, 0}, {0, 1, 0}, {0, 0, 2}});
  CHECK(m.faces == std::vector<std::array<std::uint32_t, 3>>{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  CHECK_THROWS_MATCHES(parse_mesh("a.msh", msh().substr(0, 190)), bad_file,
                       says("'a.msh', byte 0: the file has 190 bytes, but its header needs 192"));
  CHECK_THROWS_MATCHES(parse_mesh("a.msh", msh(0x7FFFFFFF)), bad_file, says("but its header needs 25769803908"));
  CHECK_THROWS_MATCHES(parse_mesh("a.msh", msh(0xFFFFFFFF)), bad_file, says("a number in the header is negative"));
  CHECK_THROWS_MATCHES(parse_mesh("a.msh", msh().substr(0, 7)), bad_file, says("the header is cut off"));
  CHECK_THROWS_MATCHES(parse_mesh("a.msh", std::string(16, '\0')), bad_file, says("the mesh has no vertices"));
  CHECK_THROWS_MATCHES(parse_mesh("a.msh", msh(4, 4)), bad_file,
                       says("byte 188: index 4 of face 3 is out of range: the mesh has 4 vertices"));
  CHECK_THROWS_MATCHES(parse_mesh("a.msh", msh(4, 0xFFFFFFFF)), bad_file, says("index -1 of face 3"));
  CHECK_THROWS_MATCHES(parse_mesh("a.msh", msh(4, 3, std::numeric_limits<float>::infinity())), bad_file,
                       says("byte 28: the vertex is not finite"));
}

TEST_CASE("STL files, binary and text") {
  const std::vector<vec3<>> corners{{0, 0, 0}, {1, 0, 0}, {0, 0.1, 0}};
  for (const auto& title : {"made by hand", "solid", "solid made by hand"}) {
    const auto m = stl(binary_stl(title, 1));
    REQUIRE(m.vertices.size() == 3);
    CHECK(m.vertices[2].y == double{0.1f});
    CHECK(m.faces == std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
    CHECK_THROWS_MATCHES(stl(binary_stl(title, 2)), bad_file,
                         says("byte 84: the file has 134 bytes, but 2 facets of binary STL need 184"));
  }
  CHECK_THROWS_MATCHES(stl(""), bad_file, says("byte 0: the title is cut off"));
  CHECK_THROWS_MATCHES(stl("hello"), bad_file, says("the title is cut off"));
  CHECK_THROWS_MATCHES(stl(std::string(84, '\0')), bad_file, says("the mesh has no facets"));

  CHECK(stl("solid\n" + facet + "endsolid").vertices == corners);
  const auto two =
      stl("\r\nSOLID facet of\r\n" + facet + facet + "endsolid facet of\nsolid b\n" + facet + "endsolid b");
  CHECK((two.vertices.size() == 9 && two.faces.back() == std::array<std::uint32_t, 3>{6, 7, 8}));
  CHECK_THROWS_MATCHES(stl("solid\n" + facet), bad_file, says("a.STL:9: the file ends in facet 1, where facet must"));
  CHECK_THROWS_MATCHES(stl("solid\n" + facet.substr(0, 56)), bad_file, says("a.STL:5: the vertex is cut off"));
  CHECK_THROWS_MATCHES(stl("solid\n" + facet + "facets"), bad_file, says("expected facet in facet 1, got 'facets'"));
  CHECK_THROWS_MATCHES(stl("solid\nendsolid\n"), bad_file, says("the mesh has no facets"));
  CHECK_THROWS_MATCHES(stl("solid\nfacet normal 0 0 1 outer loop vertex 0 nan 0"), bad_file,
                       says("a.STL:2: the vertex is not finite"));
  CHECK_THROWS_MATCHES(stl("solid\nfacet normal 0 0 1 outer loop vertex 0 0,5 0"), bad_file,
                       says("'0,5' is not a number"));
}

TEST_CASE("OBJ files") {
  const auto m =
      obj("# a pyramid\nmtllib a.mtl\no top\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0 0.5 0.5 0.5\r\nv 0 1 \\\n 0 # corner\n"
          "vt 0 0\nvn 0 0 1\nf 1 2/1 3//1 4/1/1\nf -4 \\\n-3 5\nv .5 .5 +1\n");
  CHECK(m.vertices == std::vector<vec3<>>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}});
  CHECK(m.faces == std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}, {0, 1, 4}});
  CHECK(obj("v 1 2 3").faces.empty());
  const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  CHECK_THROWS_MATCHES(obj("# nothing\n"), bad_file, says("a.obj:2: the mesh has no vertices"));
  CHECK_THROWS_MATCHES(obj("v 1 2"), bad_file, says("a.obj:1: the vertex is cut off"));
  CHECK_THROWS_MATCHES(obj("v 1 2 3 4 5"), bad_file, says("a vertex must have 3, 4 or 6 numbers"));
  CHECK_THROWS_MATCHES(obj("v 1 2 inf"), bad_file, says("the vertex is not finite"));
  CHECK_THROWS_MATCHES(obj("v 1 2 1e999"), bad_file, says("'1e999' is too large or too small for a double"));
  CHECK_THROWS_MATCHES(obj(three + "f 1 2"), bad_file, says("a.obj:4: a face must have three corners, got 2"));
  CHECK_THROWS_MATCHES(obj(three + "f 1 2 4\n\n"), bad_file, says("a.obj:4: index 4 is out of range: there are 3"));
  CHECK_THROWS_MATCHES(obj(three + "f 1 2 -4"), bad_file, says("index -4 is out of range"));
  CHECK_THROWS_MATCHES(obj(three + "f 1 2 0"), bad_file, says("index 0 is out of range"));
  CHECK_THROWS_MATCHES(obj(three + "f 1 2 4294967296"), bad_file, says("index 4294967296 is out of range"));
  CHECK_THROWS_MATCHES(obj(three + "f 1 2 3x"), bad_file, says("'3x' is not an index"));
}

TEST_CASE("meshes from files") {
  const test::scratch file(".MSH", msh());
  CHECK(detail::read_mesh(file.path).vertices.size() == 4);
  CHECK_THROWS_MATCHES(detail::read_mesh(file.path.string() + ".stl"), bad_file, says("cannot open"));
  CHECK_THROWS_MATCHES(parse_mesh("a.dae", ""), bad_file, says("'a.dae': a mesh must be an .stl, .obj or .msh file"));
}

}  // namespace mesh_file_test
