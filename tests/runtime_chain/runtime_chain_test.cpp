#include "catch.hpp"
#include "chain/models.hpp"
#include "random.hpp"
#include "robots/iiwa14.hpp"
#include "robots/ur5.hpp"

namespace runtime_chain_test {

using namespace models;

TEST_CASE("a chain read from its record gives the same values") {
  const auto built = by_own_elements(tree), loaded = registered(kte::record_of(built));
  auto a = built.make_state(), b = loaded.make_state();
  random_numbers random(7);
  for (int i = 0; i < 3; ++i)
    a.coordinate(i).q = b.coordinate(i).q = random(), a.coordinate(i).q_dot = b.coordinate(i).q_dot = random();
  const Eigen::VectorXd x = kte::forward_dynamics(built, a), y = kte::forward_dynamics(loaded, b);
  // Rotations by typed quarter turns and by numbers 0 and 1 give the same sums; only the axis -x is a general one here.
  CHECK((x - y).norm() <= 1e-14 * x.norm());
}

TEST_CASE("chains nest and are values") {
  using namespace kte;
  runtime_chain inner;
  inner << rigid_link_2D("joint", "tip", along_x(0.5)) << inertia_2D("tip", point_mass(1.0));
  runtime_chain outer;
  outer << revolute_joint_2D("q", "base", "joint") << inner;
  runtime_chain copy = outer;
  outer << inertia_2D("tip", point_mass(1.0));
  auto s = outer.make_state();
  CHECK(mass_matrix(outer, s)(0, 0) == 0.5);  // 2 kg at 0.5 m
  auto t = copy.make_state();
  CHECK(mass_matrix(copy, t)(0, 0) == 0.25);
  copy = outer;
  auto u = copy.make_state();
  CHECK(mass_matrix(copy, u)(0, 0) == 0.5);
  CHECK(record_of(outer).elements.size() == 4);
}

TEST_CASE("a coordinate may be named before the joint that turns by it") {
  using namespace kte;
  runtime_chain c;
  c << inertia_gen("q", 0.5) << revolute_joint_2D("q", "base", "joint") << rigid_link_2D("joint", "tip", along_x(0.5))
    << inertia_2D("tip", point_mass(1.0));
  c.gravity(along_y(-9.81));
  auto s = c.make_state();
  for (const double q : {0.3, -2.0}) {
    s.coordinate("q").q = q;
    CHECK(inverse_dynamics(c, s)[0] == within(9.81 * 0.5 * std::cos(q), 4e-15));  // four roundings of up to 5
    CHECK(mass_matrix(c, s)(0, 0) == within(0.5 + 0.25, 4e-16));
  }
}

TEST_CASE("gravity stays when chains nest") {
  using namespace kte;
  const vec3<> earth{0.0, -9.81, 0.0}, moon{0.0, -1.62, 0.0};
  const auto fixed = pendulum.gravity(along_y(-9.81));
  const auto loose = by_own_elements(fixed), loaded = registered(record_of(fixed));
  runtime_chain weight;
  weight << inertia_2D("tip", point_mass(1.0));
  const auto heavier = [&](const runtime_chain& c) {
    CHECK(c.gravity() == earth);
    CHECK(record_of(c).gravity == std::vector{0.0, -9.81, 0.0});
    const auto again = registered(record_of(c));
    CHECK(again.gravity() == earth);
    auto s = again.make_state();
    CHECK(inverse_dynamics(again, s)[0] == 2 * 9.81 * 0.5);
  };
  heavier(runtime_chain() << fixed << weight);  // a static chain in a runtime chain
  heavier(runtime_chain() << loose << weight);
  heavier(runtime_chain() << loaded << weight);
  heavier((runtime_chain() << loose).append(weight.clone()));
  heavier(runtime_chain().append(loose.clone()) << weight);
  heavier(runtime_chain() << (runtime_chain() << fixed) << weight);
  heavier(runtime_chain(loaded) << weight);

  // two that are the same; zero is none
  auto twin = weight;
  heavier(runtime_chain() << loose << twin.gravity(earth));
  heavier(runtime_chain() << loose << twin.gravity(zero3{}));
  heavier(registered(record_of(pendulum)) << twin.gravity(earth));

  // two that differ
  twin.gravity(moon);
  auto c = runtime_chain() << fixed;
  CHECK_THROWS_AS(c << twin, bad_wiring);
  CHECK_THROWS_WITH(c.append(twin.clone()), kte::test::contains_text("different gravities") &&
                                                kte::test::contains_text("(0, -9.8") &&
                                                kte::test::contains_text("(0, -1.6"));
  CHECK(record_of(c) == record_of(loose));
  heavier(c << weight);

  // what is written on the whole wins, zero too
  CHECK((runtime_chain().gravity(moon) << fixed << twin).gravity() == moon);
  CHECK((runtime_chain().gravity(zero3{}) << fixed << twin).gravity() == vec3<>{});
  CHECK((c << inertia_2D("tip", point_mass(1.0))).gravity(moon).gravity() == moon);
  CHECK((runtime_chain() << c).gravity() == moon);
}

TEST_CASE("a state belongs to the chain it was made for") {
  using namespace kte;
  runtime_chain c;
  c << revolute_joint_2D("q", "base", "joint") << inertia_2D("joint", planar_body(1.0, 0.1));
  auto old = c.make_state();
  c.doMotion(old);
  c << rigid_link_2D("joint", "tip", along_x(0.5));
  CHECK_THROWS_AS(c.doMotion(old), bad_argument);
  CHECK_THROWS_AS(mass_matrix(c, old), bad_argument);
  auto s = c.make_state();
  CHECK_NOTHROW(c.doMotion(s));
  const runtime_chain copy = c;
  CHECK_NOTHROW(copy.doMotion(s));  // a copy has the same things in the same order
  CHECK_THROWS_WITH(s.frame_2D("tpi"),
                    "kte: this chain has no 2D frame 'tpi', did you mean 'tip'? (there are 'base', 'joint', 'tip')");
  CHECK_THROWS_WITH(s.frame_3D("tip"), "kte: 'tip' is a 2D frame, not a 3D frame");
  CHECK_THROWS_AS(forward_kinematics(c, s, "nowhere"), unknown_name);
  c << base_2D("another");
  CHECK_THROWS_AS(c.doMotion(s), bad_argument);
  CHECK_NOTHROW(copy.doMotion(s));
  // The bases of a state are accelerated against the gravity with which it was made.
  auto moon = copy;
  moon.gravity(along_y(-1.62));
  CHECK_THROWS_WITH(inverse_dynamics(moon, s), kte::test::contains_text("gravity was changed"));
  auto there = moon.make_state();
  moon.gravity(along_y(-1.62));
  CHECK_NOTHROW(inverse_dynamics(moon, there));
  CHECK_NOTHROW(copy.doMotion(s));
}

TEST_CASE("mistakes in a runtime chain are named, and change nothing") {
  using namespace kte;
  using kte::test::contains_text;
  runtime_chain c;
  c << revolute_joint_3D("q", "base", "joint") << rigid_link_3D("joint", "tip", along_z(0.5));
  const auto before = record_of(c);
  SECTION("written twice") {
    CHECK_THROWS_WITH(c << rigid_link_3D("base", "tip", along_z(1)),
                      contains_text("rigid_link_3D (base 'base', end 'tip')") && contains_text("written twice"));
  }
  SECTION("read before written") {
    CHECK_THROWS_WITH(c << rigid_link_3D("tip", "base", along_z(1)),
                      contains_text("it reads 'base' before it is written"));
    CHECK_THROWS_WITH(c << rigid_link_3D("a", "a", along_z(1)), contains_text("'a'"));
  }
  SECTION("unknown") {
    CHECK_THROWS_WITH(c << inertia_3D("tpi", point_mass(1.0)),
                      contains_text("inertia_3D (frame 'tpi')") && contains_text("did you mean 'tip'?"));
  }
  SECTION("two bases") {
    runtime_chain another;
    CHECK_THROWS_WITH(another << spring_3D("a", "b", 0.5, 8.0),
                      contains_text("it reads 'b', which no element before it writes"));
    another << base_3D("b") << spring_3D("a", "b", 0.5, 8.0);
    CHECK_THROWS_WITH(another << damper_3D("b", "d", 8.0), contains_text("it reads 'd'"));
  }
  SECTION("wrong kind") {
    CHECK_THROWS_WITH(c << inertia_2D("tip", point_mass(1.0)), contains_text("'tip' is a 3D frame, not a 2D frame"));
    CHECK_THROWS_WITH(c << inertia_3D("q", point_mass(1.0)), contains_text("'q' is a coordinate, not a 3D frame"));
  }
  SECTION("no name") { CHECK_THROWS_WITH(c << inertia_3D("", point_mass(1.0)), contains_text("frame has no name")); }
  SECTION("a chain whose second element is wrong") {
    runtime_chain more;
    more << rigid_link_3D("x", "tool", along_z(0.1)) << rigid_link_3D("tool", "tip", along_z(0.1));
    CHECK_THROWS_AS(c << more, bad_wiring);
  }
  SECTION("a force on a coordinate that moves nothing") {
    c << spring_gen("q", "nothing", 0.0, 1.0);
    CHECK_THROWS_WITH(c.make_state(), contains_text("'nothing'"));
    c << inertia_gen("nothing", 1.0);
    CHECK_NOTHROW(c.make_state());
    return;
  }
  CHECK(record_of(c) == before);
  CHECK_NOTHROW(c << inertia_3D("tip", point_mass(1.0)));  // and it goes on
  CHECK_NOTHROW(c << base_3D("another") << inertia_3D("another", point_mass(1.0)));
}

}  // namespace runtime_chain_test
