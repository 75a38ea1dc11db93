#include <kte/control/linearize_loops.hpp>
#include <kte/elements/base.hpp>

#include "catch.hpp"
#include "closed_loops/linkages.hpp"
#include "closed_loops/static_four_bar.hpp"

// Bad input to algorithms on loops: one sentence with the names, and a state that is as before.

namespace refusals_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::loops;
using Catch::Matchers::Message;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// A five-bar: two cranks of 1 m, driven by both.
struct five_bar {
  runtime_chain c;
  five_bar() {
    for (const std::string s : {"l", "r"})
      c << revolute_joint_2D(s + "1", "base", s + "a").at(vec2<>{s == "l" ? 0.0 : 1.0, 0}) << inertia_2D(s + "a", bar)
        << rigid_link_2D(s + "a", s + "b", along_x(1.0)) << revolute_joint_2D(s + "2", s + "b", s + "c")
        << inertia_2D(s + "c", bar) << rigid_link_2D(s + "c", s + "d", along_x(1.2));
    c << coincident_points_2D("tip", "ld", "rd");
  }
};

TEST_CASE("an actuated coordinate is named once") {
  const five_bar five;
  auto s = five.c.make_state();
  const vector q = assemble(five.c, s, numbers({2.0, -1, 1.0, 1}), held("l1", "r1")), none = vector::Zero(4);
  const auto twice = Message("kte: the actuated coordinate 'l1' is named twice");
  CHECK_THROWS_MATCHES(loop_motion(five.c, s, q, actuated("l1", "l1")), bad_argument, twice);
  CHECK_THROWS_MATCHES(inverse_dynamics(five.c, s, q, none, none, actuated("l1", "l1")), bad_argument, twice);
  CHECK_THROWS_MATCHES(mass_matrix(five.c, s, q, actuated("l1", "l1")), bad_argument, twice);
  CHECK_THROWS_MATCHES(linearize(five.c, s, q, none, none, actuated("l1", "l1")), bad_argument, twice);
  CHECK(loop_motion(five.c, s, q, actuated("l1", "r1")).cols() == 2);
  using namespace with_keys;
  CHECK_THROWS_MATCHES(loop_motion(four_bar, guess, actuated(crank, crank)), bad_argument,
                       Message("kte: the actuated coordinate 'crank' is named twice"));
}

TEST_CASE("closures that close no loop are refused") {
  const auto with = [](const auto& closure) {
    auto c = parallelogram(1.0);
    c << rigid_link_2D("base", "wall", vec2<>{1, 0}) << closure;
    auto s = c.make_state();
    return kte::loops(c, s, four_bar_q(1, 0.4)).rank;
  };
  const auto refusal = [](const std::string& a, const std::string& b, const std::string& where) {
    return Message("kte: coincident_points_2D (frame1 '" + a + "', frame2 '" + b +
                   "', loop 'x') closes no loop: no joint moves its frames relative to each other: they are " + where);
  };
  CHECK_THROWS_MATCHES(with(coincident_points_2D("x", "base", "wall")), bad_argument,
                       refusal("base", "wall", "both on bases"));
  CHECK_THROWS_MATCHES(with(coincident_points_2D("x", "k", "e")), bad_argument, refusal("k", "e", "on one body"));
  const auto sum = [](const auto& a, const auto& b, const auto& c) { return a + b + c; };
  CHECK_THROWS_MATCHES(with(coupled_by("x", "q0", "q1", "q0", sum)), bad_argument,
                       says("loop 'x') couples a coordinate to itself"));
  CHECK(with(coincident_points_2D("x", "base", "e")) == 3);
  {
    using namespace with_keys;
    const auto fixed = chain(revolute_joint_2D(crank, base, a), inertia_2D(a, body),
                             rigid_link_2D(base, A, along_x(1.0)), coincident_points_2D(pin, base, A));
    CHECK_THROWS_MATCHES(
        kte::loops(fixed, Eigen::Matrix<double, 1, 1>(0.3)), bad_argument,
        Message("kte: coincident_points_2D (frame1 'base', frame2 'A', loop 'pin') closes no loop: no joint moves its "
                "frames relative to each other: they are both on bases"));
  }

  runtime_chain fixed;  // without degrees of freedom
  fixed << base_gen("q") << revolute_joint_2D("q", "base", "a") << coincident_points_2D("x", "base", "a");
  auto s = fixed.make_state();
  const vector nothing(0);
  CHECK(kte::loops(fixed, s, nothing).rank == 0);
  CHECK(assemble(fixed, s, nothing).size() == 0);
}

TEST_CASE("numbers of assemblies, and all coordinates held") {
  const auto c = parallelogram(1.0);
  auto s = c.make_state();
  const vector q = four_bar_q(1, 0.4);
  CHECK_THROWS_MATCHES(assemblies(c, s, 0, q, held("q0")), bad_argument,
                       Message("kte: assemblies: the number of starts must be positive, got 0"));
  const auto all = held("q0", "q1", "c0");
  CHECK(assemblies(c, s, 3, q, all).size() == 1);
  CHECK(assemblies(c, s, 3, numbers({0.1, 0.2, 0.4}), all).empty());
  CHECK(assemblies(c, s, 10, q, held("q0")).size() == 2);
  CHECK(positions(s) == q);
}

TEST_CASE("velocities and accelerations that are not finite, or too large") {
  using namespace with_keys;
  const Eigen::Vector3d q = assemble(four_bar, guess, held(crank)), none(0, 0, 0), bad(0, not_a_number, 0);
  const Eigen::Vector3d large(1.7e308, -1.7e308, 1.7e308);
  CHECK_THROWS_MATCHES(consistent_velocities(four_bar, q, bad), bad_argument,
                       Message("kte: a velocity is not finite: v[1] of 'coupler' is nan"));
  CHECK_THROWS_MATCHES(inverse_dynamics(four_bar, q, bad, none, actuated(crank)), bad_argument,
                       Message("kte: a velocity is not finite: v[1] of 'coupler' is nan"));
  CHECK_THROWS_MATCHES(inverse_dynamics(four_bar, q, none, bad, actuated(crank)), bad_argument,
                       Message("kte: an acceleration is not finite: a[1] of 'coupler' is nan"));
  CHECK_THROWS_AS(consistent_velocities(four_bar, q, large), bad_argument);
  const auto c = runtime_chain() << four_bar;
  auto s = c.make_state();
  s.coordinate("crank").q_dot = 3;
  CHECK_THROWS_AS(consistent_velocities(c, s, q, large), bad_argument);
  CHECK(s.coordinate("crank").q_dot == 3);
}

TEST_CASE("a closure whose function has no value or no derivative is named") {
  const auto at = [](const auto& law, const vector& q, const auto& call) {
    auto c = parallelogram(1.0);
    c << coupled_by("cam", "q0", "q1", law);
    auto s = c.make_state();
    call(c, s, q);
  };
  const auto root = [](const auto& a, const auto& b) {
    using std::sqrt;
    return sqrt(a) - b;
  };
  const vector none = vector::Zero(3), below = numbers({-1, -1, 1}), at_zero = numbers({0, 0, 0});
  const auto each = [&](const vector& q, const std::string& what) {
    const auto message = Message("kte: closure 'cam': " + what + " is not finite at this configuration");
    CHECK_THROWS_MATCHES(at(root, q, [](auto& c, auto& s, auto& x) { (void)kte::loops(c, s, x); }), bad_argument,
                         message);
    CHECK_THROWS_MATCHES(at(root, q, [](auto& c, auto& s, auto& x) { (void)loop_jacobian(c, s, x); }), bad_argument,
                         message);
    CHECK_THROWS_AS(at(root, q, [&](auto& c, auto& s, auto& x) { (void)constrained_dynamics(c, s, x, none, none); }),
                    bad_argument);
  };
  each(below, "its residual");
  each(at_zero, "a derivative of its residual");
}

}  // namespace refusals_test
