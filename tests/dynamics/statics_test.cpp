#include <kte/dynamics/statics/problem.hpp>
#include <kte/statics.hpp>

#include <numbers>

#include "catch.hpp"
#include "chain/cantilever.hpp"
#include "chain/registered.hpp"

namespace statics_test {

using namespace kte;
using namespace kte::test;

using std::numbers::pi;

template <class V>
double off(const V& tip, const vec3<>& exact) {
  return std::hypot(tip[0] - exact.x, tip[1] - exact.y, tip[2] - exact.z);
}

/// Two springs from (-4, 0) and (4, 0) to a joint that slides along y, at rest at (0, 3), with a push down on it.
constexpr double stiffness = 100, rest = 5;
runtime_chain truss() {
  runtime_chain c;
  c << base_2D("ground") << rigid_link_2D("ground", "left", along_x(-4.0))
    << rigid_link_2D("ground", "right", along_x(4.0)) << prismatic_joint_2D("y", "ground", "top", axis::y)
    << spring_2D("left", "top", rest, stiffness) << spring_2D("right", "top", rest, stiffness);
  return c;
}
/// By which it is in equilibrium at y, and where that is largest.
double push_at(double y) { return 2 * stiffness * (rest / std::hypot(4.0, y) - 1) * y; }
const double y_of_limit = std::sqrt(std::pow(rest * 16, 2.0 / 3) - 16);

/// n masses of 1 kg in a row between walls, or free, with springs of 1 N/m and dampers of c.
runtime_chain masses(int n, bool walls, double c_of_all) {
  runtime_chain c;
  c << base_gen("wall");
  const auto name = [](int i) { return "m" + std::to_string(i); };
  for (int i = 1; i <= n; ++i) c << inertia_gen(name(i), 1.0);
  for (int i = walls ? 0 : 1; i < (walls ? n + 1 : n); ++i) {
    const auto from = i == 0 ? "wall" : name(i), to = i == n ? "wall" : name(i + 1);
    c << spring_gen(from, to, 0.0, 1.0);
    if (c_of_all > 0) c << damper_gen(from, to, c_of_all);
  }
  return c;
}

TEST_CASE("beams are bent by all of their load at once, however stiff along") {
  const planar_beam_section wire{.EA = 1e9, .EI = 1};
  auto c = cantilever(16, 1, wire);
  c << constant_force_2D("16", vec2{zero, zero}, 2 * pi);
  auto s = c.make_state();
  const auto circle = static_equilibrium(c, s, straight(c, 16, 1));
  CHECK(off(circle.q.tail(3), {0, 0, 2 * pi}) < 1e-7);  // EI/EA
  CHECK(circle.status == equilibrium_status::stable);
  CHECK(circle.stability.asymmetry < 1e-14);
  CHECK(circle.load == 1);
  CHECK(positions(s) == circle.q);

  c = cantilever(64, 1, wire);
  c << constant_force_2D("64", along_y(10.0));
  s = c.make_state();
  const auto elastica = static_equilibrium(c, s, straight(c, 64, 1));
  CHECK(off(elastica.q.tail(3), {0.445004402246248730, 0.810609024880296453, 1.4302855388038575}) < 2e-8);
  CHECK(elastica.iterations < 120);

  const double h = 12.3777e-3, w = 3.2024e-3, E = 71.7e9, G = E / 2.62, L = 0.508, P = 13.345;
  const double I_y = h * w * w * w / 12, I_z = w * h * h * h / 12, GA = G * h * w;
  c = cantilever(16, L, beam_section{E * h * w, E * I_y, E * I_z, 0.198 * G * (I_y + I_z), GA, GA});
  c << constant_force_3D("16", P * vec3{0.0, -std::cos(pi / 6), std::sin(pi / 6)});
  s = c.make_state();
  const auto princeton = static_equilibrium(c, s, straight(c, 16, L));
  CHECK(off(princeton.q.tail(7), {0.490741077741663148, -0.016989798932700564, 0.118179534218106258}) < 2e-5);
  CHECK(princeton.iterations < 40);
}

TEST_CASE("the bend of 45 degrees under 600") {
  constexpr int n = 64;
  const double a = pi / 4 / n, chord = 2 * 100 * std::sin(a / 2), EI = 1e7 / 12, GA = 1e7 / 2.4;
  runtime_chain c;
  Eigen::VectorXd q(7 * n);
  for (int i = 0; i < n; ++i) {
    const auto before = std::to_string(i), node = std::to_string(i + 1);
    const vec3 here{0.0, 0.0, 0.0};
    c << free_joint_3D("at " + node, "0", node)
      << rigid_link_3D(before, "from " + node, here, matrix(rotation_by(a / 2)))
      << rigid_link_3D(node, "to " + node, here, matrix(rotation_by(-a / 2)))
      << flexible_beam_3D("from " + node, "to " + node, chord, {1e7, EI, EI, EI, GA, GA});
    const double b = a * (i + 1);
    q.segment<7>(7 * i) << 100 * std::sin(b), 100 * (1 - std::cos(b)), 0, std::cos(b / 2), 0, 0, std::sin(b / 2);
  }
  c << constant_force_3D(std::to_string(n), along_z(600.0));
  auto s = c.make_state();
  const auto r = static_equilibrium(c, s, q);
  CHECK(off(r.q.tail(7), {47.150096240343, 15.684689478980, 53.475477998223}) < 2e-3);  // by shooting
  CHECK(r.status == equilibrium_status::stable);
  CHECK(r.iterations < 60);

  // Derivatives in as many directions as three nodes have, and symmetric also where forces are left.
  detail::static_problem f(c, s, {}, "");
  CHECK(f.pattern().colours == 18);
  const detail::sparse_matrix k = f.tangent(q, 1), twist = k - detail::sparse_matrix(k.transpose());
  CHECK(detail::largest_number(twist) < 1e-13 * detail::largest_number(k));
  const Eigen::VectorXd step = Eigen::VectorXd::LinSpaced(f.size(), -1, 1), by = 1e-6 * step;
  const Eigen::VectorXd change = k * step;
  const auto turned = [&](const Eigen::VectorXd& d) {  // forces in axes at q, which the step does not turn
    const Eigen::VectorXd to = f.displaced(q, d);
    Eigen::VectorXd tau = f.forces(to, 1);
    for (int i = 0; i < n; ++i) {
      const auto pose = [i](const Eigen::VectorXd& x) {
        return detail::quaternion_from<double>(x, 7 * static_cast<std::size_t>(i) + 3);
      };
      const vec3<> own{tau[6 * i], tau[6 * i + 1], tau[6 * i + 2]};
      const vec3<> force = conjugate(pose(q)) * (pose(to) * own);
      detail::put_vector(tau, 6 * i, force);
    }
    return tau;
  };
  const Eigen::VectorXd by_differences = (turned(by) - turned(-by)) / 2e-6;
  for (int i = 0; i < n; ++i)
    CHECK((by_differences - change).segment<3>(6 * i).norm() < 1e-7 * detail::largest_number(k));
}

TEST_CASE("derivatives by colours are those by one direction after the other") {
  runtime_chain c;
  c.gravity(along_z(-9.81));
  for (int arm = 0; arm < 3; ++arm)
    for (int i = 0; i < 4; ++i) {
      const auto name = [arm](int k) { return k == 0 ? std::string("base") : std::to_string(10 * arm + k); };
      c << revolute_joint_3D("q" + name(i + 1), name(i), "joint" + name(i + 1), axis::y)
        << rigid_link_3D("joint" + name(i + 1), name(i + 1), vec3{0.3, 0.1 * arm, 0.2})
        << inertia_3D(name(i + 1), point_mass(1.0));
    }
  c << spring_3D("3", "12", 0.1, 20.0) << spring_3D("base", "22", 0.2, 30.0)
    << follower_force_3D("24", vec3{1.0, 2.0, 3.0}) << spring_gen("q2", "q3", 0.0, 4.0);
  auto s = c.make_state();
  const Eigen::VectorXd q = Eigen::VectorXd::LinSpaced(c.nq(), -1, 1), none = Eigen::VectorXd::Zero(c.dofs());
  detail::static_problem f(c, s, {{"12", {1, 2, 3}, {4, 5, 6}}}, "");
  CHECK(f.pattern().colours == 7);
  auto loaded = c;
  loaded << follower_force_3D("12", vec3{1.0, 2.0, 3.0}, vec3{4.0, 5.0, 6.0});
  auto t = loaded.make_state();
  const auto& all = inverse_dynamics_derivatives(loaded, t, q, none, none);
  CHECK((f.forces(q, 1) - all.tau).cwiseAbs().maxCoeff() <= 1e-13);
  CHECK((Eigen::MatrixXd(f.tangent(q, 1)) - all.by_q).cwiseAbs().maxCoeff() <= 1e-13);
  // Half of the loads: tau is linear in their factor.
  const Eigen::VectorXd half = f.forces(q, 0.5), full = f.forces(q, 1), without = f.forces(q, 0);
  CHECK((half - 0.5 * (full + without)).cwiseAbs().maxCoeff() <= 1e-13);
}

TEST_CASE("what a controller writes is no load from outside") {
  auto c = truss();
  c << position_measure_gen("y", "height") << driving_actuator_gen("y", "height") << driving_actuator_gen("y", "push");
  auto s = c.make_state();
  s.input("push") = 3;
  detail::static_problem f(c, s, {}, "");
  const Eigen::VectorXd y = Eigen::VectorXd::Constant(1, 2.0);
  CHECK(f.forces(y, 0)[0] == within(-push_at(2) - 2, 1e-12));
  CHECK(f.forces(y, 1)[0] == within(-push_at(2) - 2 - 3, 1e-12));
}

TEST_CASE("a pushed beam is unstable beyond Euler's load") {
  const double critical = pi * pi / 4;  // of a cantilever; two beams err by 5e-4
  for (const double part : {0.999, 1.001}) {
    auto c = cantilever(2, 1, planar_beam_section{.EA = 1e6, .EI = 1});
    c << constant_force_2D("2", along_x(-part * critical));
    auto s = c.make_state();
    const auto r = static_equilibrium(c, s, straight(c, 2, 1));
    CHECK(r.status == (part < 1 ? equilibrium_status::stable : equilibrium_status::unstable));
    CHECK(r.stability.unstable == (part < 1 ? 0 : 1));
    CHECK((r.stability.stiffness > 0) == (part < 1));
  }
}

TEST_CASE("a shallow truss snaps through") {
  const double limit = push_at(y_of_limit);
  auto c = truss();
  c << constant_force_2D("top", along_y(-1.5 * limit));
  auto s = c.make_state();
  const auto path = equilibrium_path(c, s, std::array{3.0}, {.step = 0.05});
  double most = 0, least = 0;
  for (const auto& x : path) {
    CHECK(1.5 * limit * x.parameter == within(push_at(x.q[0]), 1e-9));
    CHECK((x.stability.unstable == 1) == (std::abs(x.q[0]) < y_of_limit));
    if (x.q[0] > 0) most = (std::max)(most, x.parameter);
    least = (std::min)(least, x.parameter);
  }
  CHECK(path.front().q[0] == within(3, 1e-10));
  CHECK(path.back().parameter == 1);
  CHECK(path.back().q[0] < -3);
  CHECK(1.5 * most == within(1, 0.01));  // the nearest point
  CHECK(1.5 * least == within(-1, 0.01));
  CHECK(positions(s) == path.back().q);

  // By an input.
  auto driven = truss();
  driven << driving_actuator_gen("y", "push");
  auto t = driven.make_state();
  const auto by_input = equilibrium_path(driven, t, std::array{3.0}, {.parameter = "push", .to = -1.5 * limit});
  CHECK(by_input.back().q[0] == within(path.back().q[0], 1e-9));
  CHECK(by_input.size() > 10);
  CHECK(equilibrium_path(driven, t, std::array{3.0}, {.parameter = "push", .to = -1.5 * limit, .points = 4}).size() ==
        4);

  // Loads alone get to the limit point.
  const auto asked = static_equilibrium(c, s, std::array{3.0}, {.must_reach = false});
  CHECK(asked.status == equilibrium_status::not_reached);
  CHECK(1.5 * asked.load == within(1, 1e-3));
  CHECK_THROWS_MATCHES(static_equilibrium(c, s, std::array{3.0}), no_solution,
                       says("no equilibrium was found under all loads, but at load factor 0.66"));
}

TEST_CASE("a path follows a bend that a step could cut") {
  // A column with a small push aside bends out at a twelfth of its load; straight on there is another, unstable path.
  auto c = cantilever(8, 1, planar_beam_section{.EA = 1e4, .EI = 1});
  c << constant_force_2D("8", vec2{-30.0, 0.02});
  auto s = c.make_state();
  const auto path = equilibrium_path(c, s, straight(c, 8, 1));
  for (const auto& x : path) CHECK(x.stability.stable());
  CHECK(path.back().q.tail(2)[0] > 0.3);
}

TEST_CASE("what loads alone hold finds its place") {
  runtime_chain c;
  c.gravity(along_z(-9.81));
  c << revolute_joint_3D("shoulder", "base", "upper", axis::y) << rigid_link_3D("upper", "mid", along_x(0.4))
    << inertia_3D("mid", point_mass(2.0)) << revolute_joint_3D("elbow", "mid", "lower", axis::y)
    << rigid_link_3D("lower", "tool", along_x(0.3)) << inertia_3D("tool", point_mass(1.0));
  auto s = c.make_state();
  const auto hanging = static_equilibrium(c, s, std::array{0.8, 0.3});
  CHECK(hanging.q[0] == within(pi / 2, 1e-9));
  CHECK(hanging.q[1] == within(0, 1e-9));
  CHECK(hanging.status == equilibrium_status::stable);
  // Pulled aside at the end, in axes of the end: both links are along the resultant of what hangs on them.
  const auto pulled = static_equilibrium(c, s, std::array{pi / 2, 0.0}, {.loads = {{"tool", {0, 0, 2}}}});
  CHECK(std::abs(inverse_dynamics(c, s, pulled.q, std::array{0.0, 0.0}, std::array{0.0, 0.0},
                                  {{"tool", {0, 0, 2}}})[0]) < 1e-8);
  CHECK(pulled.stability.asymmetry > 0.005);
}

TEST_CASE("static_equilibrium refuses by name") {
  runtime_chain c;
  c.gravity(along_z(-9.81));
  c << prismatic_joint_3D("held", "base", "first", axis::z) << spring_3D("base", "first", 0.0, 1e3)
    << inertia_3D("first", point_mass(1.0)) << prismatic_joint_3D("loose", "base", "second", axis::z)
    << inertia_3D("second", point_mass(1.0));
  auto s = c.make_state();
  set_positions(s, std::array{0.1, 0.2});
  CHECK_THROWS_MATCHES(static_equilibrium(c, s, std::array{0.5, 0.0}), no_solution, says("nothing holds 'loose'"));
  CHECK(positions(s) == Eigen::Vector2d(0.1, 0.2));
  CHECK_THROWS_MATCHES(equilibrium_path(c, s, std::array{0.5, 0.0}), no_solution, says("nothing holds 'loose'"));
  CHECK_THROWS_MATCHES(static_equilibrium(c, s, std::array{0.5, std::nan("")}), bad_argument, says("q[1] of 'loose'"));
  CHECK_THROWS_AS(static_equilibrium(c, s, std::array{0.5}), bad_argument);
  CHECK_THROWS_AS(static_equilibrium(c, s, std::array{0.5, 0.0}, {.tolerance = 0}), bad_argument);
  CHECK_THROWS_AS(static_equilibrium(c, s, std::array{0.5, 0.0}, {.loads = {{"third"}}}), unknown_name);
  CHECK_THROWS_AS(equilibrium_path(c, s, std::array{0.5, 0.0}, {.to = 0}), bad_argument);
  CHECK_THROWS_MATCHES(equilibrium_path(c, s, std::array{0.5, 0.0}, {.parameter = "held"}), bad_argument,
                       says("'held' is not a parameter"));
  CHECK_THROWS_MATCHES(natural_modes(c, s, std::array{0.0, 0.0}), bad_argument, says("not in equilibrium, 'held'"));
}

TEST_CASE("natural modes of masses between springs") {
  constexpr int n = 10;
  auto c = masses(n, true, 0);
  auto s = c.make_state();
  const Eigen::VectorXd q = Eigen::VectorXd::Zero(n);
  const auto exact = [](int k) { return 2 * std::sin(k * pi / (2 * (n + 1))); };
  auto modes = natural_modes(c, s, q);
  REQUIRE(modes.frequency.size() == n);
  for (int k = 1; k <= n; ++k) {
    CHECK(modes.frequency[k - 1] == within_relative(exact(k), 1e-13));
    CHECK(modes.damping[k - 1] == 0);
    const auto shape = modes.shape.col(k - 1);
    CHECK(std::abs(shape[0] * std::sin(2 * k * pi / (n + 1)) - shape[1] * std::sin(k * pi / (n + 1))) < 1e-13);
  }
  // In proportion to stiffness: c w/2. The fastest creep: w^2 c/2 > w.
  c = masses(n, true, 0.1);
  s = c.make_state();
  modes = natural_modes(c, s, q);
  for (int k = 1; k <= n; ++k) {
    CHECK(modes.frequency[k - 1] == within_relative(exact(k), 1e-12));
    CHECK(modes.damping[k - 1] == within_relative(0.05 * exact(k), 1e-11));
  }
  c = masses(1, true, 2.0);  // 1 kg, 2 N/m, 4 N s/m
  s = c.make_state();
  modes = natural_modes(c, s, std::array{0.0});
  REQUIRE(modes.root.size() == 2);
  CHECK(modes.root[0].real() == within_relative(-2 + std::sqrt(2.0), 1e-14));
  CHECK(modes.root[1].real() == within_relative(-2 - std::sqrt(2.0), 1e-14));
  CHECK(modes.damping[0] == 1);
  // Free, they drift.
  for (const double damping : {0.0, 0.1}) {
    c = masses(3, false, damping);
    s = c.make_state();
    modes = natural_modes(c, s, std::array{0.0, 0.0, 0.0});
    CHECK(modes.frequency[0] == 0);
    CHECK(modes.frequency[1] == within_relative(1, 1e-12));
    CHECK(modes.frequency[2] == within_relative(std::sqrt(3.0), 1e-12));
    CHECK(modes.damping[2] == within(damping * std::sqrt(3.0) / 2, 1e-12));
    CHECK(std::abs(modes.shape(2, 0) - 1.0) < 1e-12);
  }
  // Without mass in between: two springs in a row.
  runtime_chain light;
  light << base_gen("wall") << inertia_gen("a", 0.0) << inertia_gen("b", 2.0) << spring_gen("wall", "a", 0.0, 4.0)
        << spring_gen("a", "b", 0.0, 4.0);
  auto t = light.make_state();
  const auto one = natural_modes(light, t, std::array{0.0, 0.0});
  REQUIRE(one.frequency.size() == 1);
  CHECK(one.frequency[0] == within_relative(1, 1e-14));
  CHECK(std::abs(one.shape(0, 0) - 0.5) < 1e-14);
  light << damper_gen("a", "b", 1.0);
  t = light.make_state();
  CHECK_THROWS_AS(natural_modes(light, t, std::array{0.0, 0.0}), singular_mass_matrix);
}

TEST_CASE("natural modes of a pendulum, hanging and upright") {
  // clang-format off
  static constexpr struct turn_ final : coord_key<"turn"> {} turn;
  static constexpr struct base_ final : frame_2D_key<"base"> {} base;
  static constexpr struct arm_  final : frame_2D_key<"arm">  {} arm;
  static constexpr struct bob_  final : frame_2D_key<"bob">  {} bob;
  // clang-format on
  const auto c =
      chain(revolute_joint_2D(turn, base, arm), rigid_link_2D(arm, bob, along_x(0.5)), inertia_2D(bob, point_mass(2.0)))
          .gravity(along_y(-9.81));
  const auto hanging = natural_modes(c, std::array{-pi / 2});
  CHECK(hanging.frequency[0] == within_relative(std::sqrt(2 * 9.81), 1e-14));
  const auto upright = natural_modes(c, std::array{pi / 2});
  CHECK(upright.root[0].real() == within_relative(std::sqrt(2 * 9.81), 1e-14));
  CHECK(upright.damping[0] == -1);
}

}  // namespace statics_test
