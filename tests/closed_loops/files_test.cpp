#include <kte/elements/closures.hpp>
#include <kte/elements/registry.hpp>
#include <kte/io/archive_file.hpp>
#include <kte/io/model_file.hpp>
#include <kte/io/state_records.hpp>
#include <kte/kte.hpp>
#include <kte/loops.hpp>
#include <kte/robots/header.hpp>

#include "catch.hpp"
#include "io/scratch.hpp"

namespace files_test {

using namespace kte;

TEST_CASE("closures go through records, model files and archives, with their parameters") {
  const vec3<> u{0.6, 0, 0.8}, t{0, 1, 0};
  runtime_chain c;
  c << revolute_joint_3D("q1", "base", "a", axis::z) << revolute_joint_3D("q2", "a", "b", axis::x) << base_2D("ground")
    << revolute_joint_2D("p1", "ground", "d") << revolute_joint_2D("p2", "d", "e");
  c << coincident_points_2D("1", "d", "e") << coincident_points_3D("2", "a", "b") << coincident_frames_2D("3", "d", "e")
    << coincident_frames_3D("4", "a", "b") << hinge_3D("5", "a", "b", u) << universal_3D("6", "a", "b", u, t)
    << cylindrical_3D("7", "a", "b", u) << sliding_2D("8", "d", "e", vec2<>{0.6, 0.8}) << sliding_3D("9", "a", "b", u)
    << point_on_line_2D("10", "d", "e", vec2<>{0.6, 0.8}) << point_on_line_3D("11", "a", "b", u)
    << point_on_plane_3D("12", "a", "b", u) << distance_2D("13", "d", "e", 0.3) << distance_3D("14", "a", "b", 0.4)
    << coupled_coordinates("15", "q1", "q2", 2.0, -1.0, 0.1)
    << coupled_by_polynomial("16", "p1", "p2", 0.1, -0.2, 0.3, -0.4, 0.5);
  const auto record = record_of(c);
  const auto again = to_chain(record);
  CHECK(record_of(again).elements == record.elements);
  auto s = c.make_state(), other = again.make_state();
  const Eigen::Vector4d q(0.3, 0.5, -0.2, 0.7);
  const auto j = loop_jacobian(c, s, q);
  CHECK((j == loop_jacobian(again, other, q) && j.rows() == 42));

  const test::scratch_folder folder;
  for (const char* extension : {".json", ".xml", ".kte"}) {
    INFO(extension);
    const auto file = folder.path / (std::string("model") + extension),
               both = folder.path / (std::string("archive") + extension);
    save_model(file, c);
    CHECK(record_of(to_chain(load_model(file))).elements == record.elements);
    archive a;
    a.add("linkage", c).add("state", s);
    save_archive(both, a);
    const auto b = load_archive(both);
    CHECK(record_of(b.chain("linkage")).elements == record.elements);
    auto restored = b.chain("linkage").make_state();
    b.restore("state", restored);
    CHECK(restored.coordinate("p2").q == s.coordinate("p2").q);
  }

  runtime_chain code;
  code << inertia_gen("a", 1.0) << coupled_by("cam", "a", [](const auto& x) { return x; });
  CHECK_THROWS_AS(record_of(code), bad_argument);
}

inline constexpr struct q1_ final : coord_key<"q1"> {
} q1;
inline constexpr struct q2_ final : coord_key<"q2"> {
} q2;
inline constexpr struct base_ final : frame_2D_key<"base"> {
} base;
inline constexpr struct a_ final : frame_2D_key<"a"> {
} a;
inline constexpr struct b_ final : frame_2D_key<"b"> {
} b;

TEST_CASE("a static chain with closures is a runtime chain") {
  constexpr auto tree = chain(revolute_joint_2D(q1, base, a), inertia_2D(a, planar_body(1.0, 0.1)),
                              prismatic_joint_2D(q2, base, b, axis::x), inertia_2D(b, planar_body(2.0, 0.1)));
  runtime_chain c;
  c << tree << rigid_link_2D("a", "pin", along_x(1.0)) << point_on_line_2D("slot", "b", "pin", axis::y);
  auto s = c.make_state();
  const Eigen::Vector2d q(0.7, std::cos(0.7)), v(1.0, -std::sin(0.7));
  const auto r = constrained_dynamics(c, s, q, v, Eigen::Vector2d(0.5, 0));
  // 0.1 + 2 sin^2 by energy: (0.1 + 2 sin^2 q) q'' + 2 sin q cos q q'^2 = tau
  const double exact = (0.5 - 2 * std::sin(0.7) * std::cos(0.7)) / (0.1 + 2 * std::sin(0.7) * std::sin(0.7));
  CHECK(r.a[0] == test::within(exact, 1e-14));
}

TEST_CASE("states with loops go through records, and recorders have forces and residuals") {
  runtime_chain c;
  c << revolute_joint_2D("q", "base", "a") << inertia_2D("a", planar_body(1.0, 0.1))
    << rigid_link_2D("a", "tip", along_x(2.0)) << point_on_line_2D("rail", "base", "tip", axis::x);
  auto s = c.make_state();
  s.coordinate("q").q = 0.25;
  c.doMotion(s);
  s.loop("rail").force.x = 3;
  auto other = c.make_state();
  restore(record_of(s), other);
  CHECK(other.loop("rail").force.x == 3);
  CHECK(other.loop("rail").residual.x == 2 * std::sin(0.25));
}

TEST_CASE("headers of static chains refuse closures") {
  runtime_chain c;
  c << revolute_joint_2D("q", "base", "link") << coincident_points_2D("pin", "base", "link");
  CHECK_THROWS_WITH(to_header(c, "loop"), test::contains_text("coincident_points_2D: headers do not support closures"));
}

}  // namespace files_test
