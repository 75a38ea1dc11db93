#include "catch.hpp"
#include "closed_loops/mechanisms.hpp"

namespace assemble_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::loops;

/// A four-bar on pivots (0, 0) and (d, 0).
runtime_chain four_bar(double crank, double coupler, double rocker, double d) {
  runtime_chain c;
  c << revolute_joint_2D("q1", "base", "a") << inertia_2D("a", bar) << rigid_link_2D("a", "A", along_x(crank))
    << revolute_joint_2D("q2", "A", "b") << inertia_2D("b", bar) << rigid_link_2D("b", "B1", along_x(coupler))
    << revolute_joint_2D("q3", "base", "r").at(vec2<>{d, 0}) << inertia_2D("r", bar)
    << rigid_link_2D("r", "B2", along_x(rocker)) << coincident_points_2D("pin", "B1", "B2");
  return c;
}

TEST_CASE("a four-bar is assembled on both branches, with its crank held") {
  const auto c = four_bar(0.4, 1.1, 0.8, 1.0);
  auto s = c.make_state();
  const double q1 = 1.1;
  // Freudenstein: the rocker from the diagonal and the cosine law
  const double x = 0.4 * std::cos(q1) - 1.0, y = 0.4 * std::sin(q1), f = std::hypot(x, y);
  const double phi = std::atan2(y, x), gamma = std::acos((f * f + 0.8 * 0.8 - 1.1 * 1.1) / (2 * f * 0.8));
  for (const double branch : {1.0, -1.0}) {
    const double q3 = phi - branch * gamma;
    const vector q = assemble(c, s, numbers({q1, q3 - branch * 1.2, q3 + 0.3}), held("q1"));
    CHECK(q[0] == q1);
    CHECK(std::remainder(q[2] - q3, 2 * pi) == within(0, 1e-14));
    CHECK(kte::loops(c, s, q).gap < 1e-15);
    CHECK((detail::read_numbers<detail::vector_of::q>(s) - q).cwiseAbs().maxCoeff() == 0);
  }
}

TEST_CASE("bars that are too short do not close") {
  const auto c = four_bar(0.4, 0.2, 0.3, 1.0);
  auto s = c.make_state();
  const vector guess = numbers({0.1, 0.2, 3.0});
  try {
    (void)assemble(c, s, guess);
    FAIL("assembled");
  } catch (const cannot_assemble& e) {
    CHECK(std::string(e.what()).starts_with("kte: the loops do not close: 'pin' stays open by 0.1 m after "));
    CHECK(
        std::string(e.what()).ends_with(" steps (the nearest approach: bars too short, closures that contradict each "
                                        "other, or another guess)"));
  }
  // exactly long enough: a dead length, to the root of rounding
  const auto d = four_bar(0.4, 0.3, 0.3, 1.0);
  auto t = d.make_state();
  const vector q = assemble(d, t, guess);
  CHECK(kte::loops(d, t, q).gap < 1e-10);
  CHECK(std::abs(std::sin(q[0])) < 1e-4);
}

TEST_CASE("from a guess where no direction brings the ends nearer, the start is beside it") {
  const auto c = four_bar(0.4, 1.1, 0.8, 1.0);
  auto s = c.make_state();
  const vector flat = numbers({0, 0, 0});  // open by 0.3 m along the bars
  const vector q = assemble(c, s, flat), held_q = assemble(c, s, flat, held("q1"));
  CHECK(kte::loops(c, s, q).gap < 1e-14);
  CHECK(held_q[0] == 0);
  CHECK(kte::loops(c, s, held_q).gap < 1e-14);
  CHECK((assemble(c, s, flat) - q).cwiseAbs().maxCoeff() == 0);
  // nothing to move: the message is that of the guess
  CHECK_THROWS_WITH(
      assemble(c, s, flat, held("q1", "q2", "q3")),
      Catch::Matchers::StartsWith("kte: the loops do not close: 'pin' stays open by 0.3 m after 0 steps"));
}

TEST_CASE("a crude guess of many loops") {
  const int n = 40;
  const auto c = four_bars(n);
  auto s = c.make_state();
  vector guess = four_bar_q(n, 0.5);
  for (Eigen::Index i = 1; i < guess.size(); ++i) guess[i] += 0.3 * std::sin(7.0 * static_cast<double>(i));
  const vector q = assemble(c, s, guess, held("q0"));
  CHECK(q[0] == guess[0]);
  CHECK(kte::loops(c, s, q).gap < 1e-13);  // of points 40 m away: ten roundings
  CHECK(kte::loops(c, s, q).mobility == 1);
}

TEST_CASE("a redundant linkage is assembled to rounding") {
  const auto c = bennett();
  auto s = c.make_state();
  const vector q = assemble(c, s, numbers({0.8, 1.5, -0.8}), held("q1"));
  CHECK(kte::loops(c, s, q).gap < 1e-14);
  // Bennett: opposite hinges turn alike
  CHECK(std::remainder(q[2] + q[0], 2 * pi) == within(0, 1e-12));
}

TEST_CASE("a hinge that closes with its axes against each other is refused") {
  runtime_chain c;
  c << revolute_joint_3D("q", "base", "a", axis::x)
    << inertia_3D("a", rigid_body<>{1, vec3<>{}, sym3<>{1, 0, 0, 1, 0, 1}}) << hinge_3D("h", "base", "a", axis::z);
  auto s = c.make_state();
  CHECK(std::abs(assemble(c, s, numbers({0.5}))[0]) < 1e-15);
  try {
    (void)assemble(c, s, numbers({pi - 0.2}));
    FAIL("assembled");
  } catch (const cannot_assemble& e) {
    CHECK(std::string(e.what()) == "kte: the loops close, but 'h' with its frames half a turn apart: another guess");
  }
  CHECK_THROWS_AS(assemble(c, s, numbers({0.5}), held("nothing")), unknown_name);
}

}  // namespace assemble_test
