#include <kte/dynamics.hpp>
#include <kte/elements/differential.hpp>
#include <kte/elements/external_force.hpp>
#include <kte/elements/law_follower.hpp>
#include <kte/elements/law_signal.hpp>
#include <kte/elements/mimic.hpp>
#include <kte/elements/position_control.hpp>
#include <kte/elements/position_measure.hpp>
#include <kte/elements/rotor.hpp>

#include <cmath>

#include "catch.hpp"
#include "chain/registered.hpp"
#include "elements/laws.hpp"

// What follows coordinates and signals: mimic, differential, law_follower, law_signal, position_control and _measure.

using namespace kte;
using namespace kte::test;

namespace {

template <class S>
void check_laws() {
  random_numbers draw(1);
  const auto check = [&draw](const auto& e) {
    CHECK(testing::power_is_kept<S>(e, draw) <= rounding<S>);
    CHECK(testing::motion_is_derivative<S>(e, draw) <= by_differences<S>);
  };
  check(mimic_gen("a", "b", S(-5) / S(4), S(1) / S(3)));
  check(differential_gen("a", "b", "c", S(1) / S(2), S(-3) / S(2)));
  check(law_follower_gen(
      [](const auto& q, const auto& p) {
        using std::sin;
        return q * sin(p) + q * q;
      },
      "a", "b", "c"));
}
// clang-format off
constexpr struct y_      final : coord_key<"y">         {} key_y;
constexpr struct F_      final : vector_key<"F">        {} key_F;
constexpr struct T_      final : vector_key<"T">        {} key_T;
constexpr struct ground_ final : frame_3D_key<"ground"> {} key_ground;
constexpr struct tip_    final : frame_3D_key<"tip">    {} key_tip;
// clang-format on
/// The text of the singular_mass_matrix that a chain throws; "" if it throws none.
std::string singular(const kte_map_chain& c) {
  auto s = c.make_state();
  const Eigen::VectorXd q = Eigen::VectorXd::Constant(c.dofs(), 0.3), none = Eigen::VectorXd::Zero(c.dofs());
  try {
    forward_dynamics(c, s, q, none, none);
  } catch (const singular_mass_matrix& e) {
    return e.what();
  }
  return "";
}

}  // namespace

TEST_CASE("what follows coordinates keeps power, and moves as its function", "[elements][mimic]") {
  check_laws<double>(), check_laws<digits50>();
}

TEST_CASE("gears and differentials in equations of motion", "[elements][mimic]") {
  // two shafts of 2 and 3 kg m^2, a cage of 4 at half their sum, a wheel of 5 at -2 times the first
  kte_map_chain c;
  c << inertia_gen("a", 2.0) << inertia_gen("b", 3.0) << differential_gen("a", "b", "cage", 0.5, 0.5)
    << inertia_gen("cage", 4.0) << mimic_gen("a", "wheel", -2.0, 0.25) << inertia_gen("wheel", 5.0);
  auto s = c.make_state();
  const Eigen::Vector2d q(0.1, 0.2), v(1, 2), tau(3, -1);
  const Eigen::MatrixXd m = mass_matrix(c, s, q);
  CHECK(m(0, 0) == within(2 + 1 + 20, 0));
  CHECK(m(0, 1) == within(1, 0));
  CHECK(m(1, 1) == within(3 + 1, 0));
  const Eigen::VectorXd a = forward_dynamics(c, s, q, v, tau);
  CHECK((m * a - tau).norm() < 1e-15);
  set_positions(s, q), set_velocities(s, v);
  c.doMotion(s);
  CHECK(s.coordinate("wheel").q == within(0.05, 1e-16));
  CHECK(s.coordinate("cage").q_dot == within(1.5, 0));
  CHECK(record_of(models::registered(record_of(c))) == record_of(c));
}

TEST_CASE("a motion given by signals, and measured", "[elements][mimic]") {
  kte_map_chain c;
  c << position_control_3D("p", "p'", "p''", "ground", "table") << position_control_gen("u", "v", "a", "q")
    << prismatic_joint_3D("q", "table", "cart", axis::x) << inertia_3D("cart", point_mass(2.0))
    << prismatic_joint_3D("y", "cart", "tip", axis::y) << inertia_3D("tip", point_mass(1.0))
    << position_measure_3D("tip", "seen") << position_measure_gen("y", "y seen") << driving_actuator_gen("y", "push");
  auto s = c.make_state();
  s.input("u") = 0.5, s.input("v") = 2, s.input("a") = -3, s.input("push") = 7;
  s.vector("p") = {0, 1, 0}, s.vector("p'") = {0, -1, 0}, s.vector("p''") = {0.5, 4, 0};
  const Eigen::VectorXd y = Eigen::VectorXd::Constant(1, 0.25), none = Eigen::VectorXd::Zero(1);
  const Eigen::VectorXd a = forward_dynamics(c, s, y, none, none);
  CHECK(a[0] == within(7 - 4, 1e-15));  // on a table that accelerates by 4 m/s^2
  set_positions(s, y), set_velocities(s, none), set_accelerations(s, a);
  c.doMotion(s);
  const auto& seen = s.vector("seen");
  CHECK(seen.x == within(0.5, 0));
  CHECK(seen.y == within(1.25, 0));
  CHECK(s.input("y seen") == within(0.25, 0));
  CHECK(s.frame_3D("tip").acceleration.x == within(-2.5, 0));
  CHECK(record_of(models::registered(record_of(c))) == record_of(c));
}

TEST_CASE("laws that give three numbers drive frames and loads, in both kinds of chain", "[elements][mimic]") {
  // A table that is shaken by three laws, and a load by one, with typed zeros.
  const auto way = [](const auto& t) { return along_x(0.5 * t * t); };
  const auto speed = [](const auto& t) { return vec3{1.0 * t, 0 * t, 0 * t}; };
  const auto grows = [](const auto&) { return along_x(1.0); };
  const auto push = [](const auto& t) { return vec3{zero, 3.0 * t, zero}; };
  const auto none = [](const auto&) { return zero3{}; };
  kte_map_chain c;
  c << law_signal(way, "time", "p") << law_signal(speed, "time", "v") << law_signal(grows, "time", "a")
    << law_signal(push, "time", "F") << law_signal(none, "time", "T")
    << position_control_3D("p", "v", "a", "ground", "table") << prismatic_joint_3D("x", "table", "cart", axis::x)
    << prismatic_joint_3D("y", "cart", "tip", axis::y) << inertia_3D("tip", point_mass(2.0))
    << external_force_3D("tip", "F", "T");
  auto s = c.make_state();
  s.input("time") = 4;
  const Eigen::VectorXd none_of_two = Eigen::VectorXd::Zero(2);
  const Eigen::VectorXd a = forward_dynamics(c, s, none_of_two, none_of_two, none_of_two);
  CHECK(a[0] == within(-1, 1e-15));
  CHECK(a[1] == within(6, 1e-15));
  c.doMotion(s);
  CHECK(s.frame_3D("tip").position.x == 8);
  const auto fixed = chain(law_signal(push, chain_time, key_F), law_signal(none, chain_time, key_T),
                           prismatic_joint_3D(key_y, key_ground, key_tip, axis::y),
                           inertia_3D(key_tip, point_mass(2.0)), external_force_3D(key_tip, key_F, key_T));
  auto t = make_state(fixed);
  t[chain_time] = 4;
  CHECK(forward_dynamics(fixed, t)[0] == within(6, 1e-15));
}

TEST_CASE("ratios are numbers, and no file holds functions", "[elements][mimic]") {
  CHECK(complaint([] { mimic_gen("a", "b", infinity); }).find("ratio must be finite") != std::string::npos);
  CHECK(complaint([] { mimic_gen("a", "b", 1.0, not_a_number); }).find("offset must be finite") != std::string::npos);
  CHECK(complaint([] { differential_gen("a", "b", "c", 1.0, infinity); }).find("ratio2 must be finite") !=
        std::string::npos);
  kte_map_chain c;
  c << inertia_gen("q", 1.0) << law_follower_gen([](const auto& q) { return q * q; }, "q", "cam");
  CHECK_THROWS_AS(record_of(c), bad_argument);
}

TEST_CASE("a coordinate that moves no mass is named, whatever follows it", "[elements][mimic]") {
  const auto arm = [] {
    kte_map_chain c;
    c << revolute_joint_3D("q", "ground", "arm", axis::z) << rigid_link_3D("arm", "tip", along_x(0.5))
      << inertia_3D("tip", point_mass(1.0));
    return c;
  };
  const std::string none = "'leaf'";
  auto c = arm();
  c << revolute_joint_3D("leaf", "tip", "hand", axis::x) << mimic_gen("leaf", "finger", -1.0)
    << revolute_joint_3D("finger", "tip", "other", axis::x);
  CHECK(singular(c).find(none) != std::string::npos);
  c << inertia_3D("other", rigid_body{1.0, zero3{}, sym3{0.1, 0.0, 0.0, 0.1, 0.0, 0.1}});  // it moves what follows
  CHECK(singular(c) == "");
  auto law = arm();
  law << inertia_gen("leaf", 0.0) << law_follower_gen([](const auto& q) { return q * q; }, "leaf", "cam");
  CHECK(singular(law).find(none) != std::string::npos);
  auto rotors = arm();
  rotors << rotor_3D("q", "arm", axis::z, 50.0, 1e-4) << revolute_joint_3D("leaf", "tip", "hand", axis::x);
  CHECK(singular(rotors).find(none) != std::string::npos);
  rotors << rotor_3D("leaf", "tip", axis::x, 50.0, 1e-4);
  CHECK(singular(rotors) == "");
  // a massless link between two joints is no leaf
  kte_map_chain massless;
  massless << revolute_joint_2D("q1", "ground", "a") << rigid_link_2D("a", "b", along_x(0.5))
           << revolute_joint_2D("q2", "b", "c") << rigid_link_2D("c", "d", along_x(0.4))
           << inertia_2D("d", point_mass(2.0)) << mimic_gen("q2", "dial", 3.0)
           << law_follower_gen([](const auto& q) { return q * q; }, "q1", "cam");
  CHECK(singular(massless) == "");
}
