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

// Elements that follow coordinates and signals: mimic, differential, law_follower, law_signal, position_control and
// _measure.

namespace mimic_test {

using namespace kte;
using namespace kte::test;

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
std::string singular(const runtime_chain& c) {
  auto s = c.make_state();
  const Eigen::VectorXd q = Eigen::VectorXd::Constant(c.dofs(), 0.3), none = Eigen::VectorXd::Zero(c.dofs());
  try {
    (void)forward_dynamics(c, s, q, none, none);
  } catch (const singular_mass_matrix& e) {
    return e.what();
  }
  return "";
}

/// A chain in which coordinates follow others, and the chain with each as a separate degree of freedom.
struct followers {
  runtime_chain chain, all;
  std::vector<std::pair<std::string, Eigen::RowVectorXd>> rows;  ///< of J: all coordinates by the degrees of freedom
  static constexpr int dofs = 7;
  int known = 0;

  template <class E>
  followers& operator<<(const E& e) {
    chain << e, all << e;
    return *this;
  }
  void free(const std::string& q) { rows.emplace_back(q, Eigen::RowVectorXd::Unit(dofs, known++)); }
  const Eigen::RowVectorXd& row(const std::string& q) const {
    for (const auto& x : rows)
      if (x.first == q) return x.second;
    throw std::out_of_range(q);
  }
  void follow(const std::string& base, const std::string& q, double ratio) {
    chain << mimic_gen(base, q, ratio);
    rows.emplace_back(q, ratio * row(base));
  }
  void follow(const std::string& base1, const std::string& base2, const std::string& q, double ratio1, double ratio2) {
    chain << differential_gen(base1, base2, q, ratio1, ratio2);
    rows.emplace_back(q, ratio1 * row(base1) + ratio2 * row(base2));
  }
  /// A body on a joint, and a link on it.
  template <class Joint>
  void body(const Joint& joint, const std::string& end, const std::string& tip) {
    *this << joint << inertia_3D(end, rigid_body{1.5, vec3{0.1, -0.05, 0.02}, sym3{0.3, 0.01, -0.02, 0.25, 0.03, 0.2}})
          << rigid_link_3D(end, tip, vec3{0.3, 0.1, -0.2});
  }
  Eigen::MatrixXd j() const {
    Eigen::MatrixXd m(rows.size(), dofs);
    for (std::size_t i = 0; i < rows.size(); ++i) m.row(static_cast<Eigen::Index>(i)) = rows[i].second;
    return m;
  }
};

TEST_CASE("masses of coordinates that follow others are those of all coordinates, folded") {
  followers x;
  const vec3 axis{0.6, 0.0, 0.8};
  x.free("a"), x.body(revolute_joint_3D("a", "ground", "A", axis), "A", "A'");
  x.free("b"), x.body(prismatic_joint_3D("b", "A'", "B", axis), "B", "B'");
  x.follow("a", "c", -0.7), x.body(revolute_joint_3D("c", "A'", "C", axis::y), "C", "C'");
  x.follow("c", "d", 1.3), x.body(prismatic_joint_3D("d", "C'", "D", axis::x), "D", "D'");
  x.follow("b", "d", "e", 0.6, 0.9), x.body(revolute_joint_3D("e", "D'", "E", axis), "E", "E'");
  for (const char* q : {"ball x", "ball y", "ball z"}) x.free(q);
  x.body(spherical_joint_3D("ball", "B'", "F"), "F", "F'");
  x.free("f"), x.body(revolute_joint_3D("f", "F'", "G", axis), "G", "G'");
  x.follow("f", "e", "g", -0.4, 0.5), x.body(revolute_joint_3D("g", "F'", "H", axis::x), "H", "H'");
  x.follow("a", "a", "twice", 0.3, 0.9), x.body(revolute_joint_3D("twice", "G'", "I", axis::z), "I", "I'");
  x.body(revolute_joint_3D("e", "ground", "J", axis::z), "J", "J'");  // moves two joints
  x.body(spherical_joint_3D("ball", "J'", "K"), "K", "K'");
  x.follow("g", "shaft", 3.0), x << inertia_gen("shaft", 0.2) << inertia_gen("a", 0.1);
  x.free("lone"), x << inertia_gen("lone", 0.4);
  x.follow("lone", "g", "sum", 1.0, -1.0), x << inertia_gen("sum", 0.7);
  x << rotor_3D("g", "D'", axis::z, 20.0, 1e-3) << rotor_3D("b", "I", axis::x, 20.0, 1e-3);
  x.chain << position_control_gen("u", "v", "w", "given") << mimic_gen("given", "moved", 2.0);
  x.chain << revolute_joint_3D("moved", "A'", "L", axis::z);
  x.chain << inertia_3D("L", point_mass(1.0, along_x(0.3)));
  x.all << rigid_link_3D("A'", "L", vec3<>{}) << inertia_3D("L", point_mass(1.0, along_x(0.3)));
  REQUIRE(x.chain.dofs() == followers::dofs);
  const Eigen::MatrixXd j = x.j();
  REQUIRE(x.all.dofs() == j.rows());

  auto s = x.chain.make_state(), t = x.all.make_state();
  random_numbers draw(7);
  Eigen::VectorXd v(followers::dofs);
  for (auto& i : v) i = draw();
  const auto q = integrate(x.chain, neutral_configuration(x.chain), v, 1.0);
  const auto all = integrate(x.all, neutral_configuration(x.all), j * v, 1.0);
  const Eigen::MatrixXd m = mass_matrix(x.chain, s, q), dense = j.transpose() * mass_matrix(x.all, t, all) * j;
  for (int a = 0; a < followers::dofs; ++a)
    for (int b = 0; b < followers::dofs; ++b) CHECK(m(a, b) == within(dense(a, b), 4e-16 * dense.norm()));
  CHECK(m == m.transpose());
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(followers::dofs);
  const Eigen::VectorXd bias = inverse_dynamics(x.chain, s, q, v, none);
  const Eigen::VectorXd answer = forward_dynamics(x.chain, s, q, v, Eigen::VectorXd(bias + dense * v));
  CHECK((m * (answer - v)).norm() < 1e-13 * bias.norm());
}

TEST_CASE("what follows coordinates keeps power, and moves as its function") {
  check_laws<double>(), check_laws<digits50>();
}

TEST_CASE("gears and differentials in equations of motion") {
  // two shafts of 2 and 3 kg m^2, a cage of 4 at half their sum, a wheel of 5 at -2 times the first
  runtime_chain c;
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

TEST_CASE("a motion given by signals, and measured") {
  runtime_chain c;
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

TEST_CASE("laws that give three numbers drive frames and loads, in both kinds of chain") {
  // A table that is shaken by three laws, and a load by one, with typed zeros.
  const auto way = [](const auto& t) { return along_x(0.5 * t * t); };
  const auto speed = [](const auto& t) { return vec3{1.0 * t, 0 * t, 0 * t}; };
  const auto grows = [](const auto&) { return along_x(1.0); };
  const auto push = [](const auto& t) { return vec3{zero, 3.0 * t, zero}; };
  const auto none = [](const auto&) { return zero3{}; };
  runtime_chain c;
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

TEST_CASE("ratios are numbers, and no file holds functions") {
  CHECK(complaint([] { (void)mimic_gen("a", "b", infinity); }).find("ratio must be finite") != std::string::npos);
  CHECK(complaint([] { (void)mimic_gen("a", "b", 1.0, not_a_number); }).find("offset must be finite") !=
        std::string::npos);
  CHECK(complaint([] { (void)differential_gen("a", "b", "c", 1.0, infinity); }).find("ratio2 must be finite") !=
        std::string::npos);
  runtime_chain c;
  c << inertia_gen("q", 1.0) << law_follower_gen([](const auto& q) { return q * q; }, "q", "cam");
  CHECK_THROWS_AS(record_of(c), bad_argument);
}

TEST_CASE("a coordinate that moves no mass is named, whatever follows it") {
  const auto arm = [] {
    runtime_chain c;
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
  runtime_chain massless;
  massless << revolute_joint_2D("q1", "ground", "a") << rigid_link_2D("a", "b", along_x(0.5))
           << revolute_joint_2D("q2", "b", "c") << rigid_link_2D("c", "d", along_x(0.4))
           << inertia_2D("d", point_mass(2.0)) << mimic_gen("q2", "dial", 3.0)
           << law_follower_gen([](const auto& q) { return q * q; }, "q1", "cam");
  CHECK(singular(massless) == "");
}

}  // namespace mimic_test
