#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/dynamics/regressor.hpp>
#include <kte/math/dual.hpp>
#include <kte/runtime_chain/layout.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include <limits>

#include "dynamics/small_chains.hpp"
#include "robots/iiwa14.hpp"
#include "static_models/static_model.hpp"

namespace regressor_test {

// The regressor of inertial parameters: against a formula, against inverse dynamics, and by bodies of unit parameters.

using namespace kte;
using namespace kte::test;
using namespace kte::test::small_chains;

constexpr double eps = std::numeric_limits<double>::epsilon();

/// max |Y pi - tau| relative to the largest sum of |Y_k pi_k| of a row, beyond which nothing has digits.
template <class Y, class Pi, class Tau>
double gap_of_forces(const Y& y, const Pi& pi, const Tau& tau) {
  double most = 0, size = 0;
  for (Eigen::Index i = 0; i < y.rows(); ++i) {
    double sum = 0, row = 0;
    for (Eigen::Index k = 0; k < y.cols(); ++k) sum += y(i, k) * pi[k], row += std::fabs(y(i, k) * pi[k]);
    most = worse(most, std::fabs(sum - tau[i])), size = worse(size, row);
  }
  return most / size;
}
/// Motions, wrenches and Jacobians pass through at most 8 joints and links with some 6 roundings in a row each, of half
/// an eps: 24 eps for tau, 24 for Y.
constexpr double rounding = 50 * eps;

/// The bodies of a chain, and what moves them: without springs and dampers. (The inputs of motors are zero.)
model_record without_forces(model_record r) {
  std::erase_if(r.elements, [](const element_record& e) {
    return e.type.find("spring") != std::string::npos || e.type.find("damper") != std::string::npos;
  });
  return r;
}

/// Gives the body of element `e` these parameters: unit vectors of (1), or sums of two.
void put_parameters(element_record& e, const std::array<double, 10>& p) {
  const auto [m, hx, hy, hz, xx, xy, yy, xz, yz, zz] = p;
  if (e.type == "inertia_gen") {
    e.parameters = {{"mass", {m}}};
    return;
  }
  // m is 0, and nothing else counts; or 1, and the inertia is about c = h
  std::vector<double> inertia{xx - hy * hy - hz * hz, xy + hx * hy, xz + hx * hz,
                              yy - hz * hz - hx * hx, yz + hy * hz, zz - hx * hx - hy * hy};
  if (e.type == "inertia_2D") std::fill_n(inertia.begin(), 5, 0.0);
  e.parameters = {{"mass", {m}}, {"com", {hx, hy, hz}}, {"inertia", inertia}, {"as_published", {1}}};
}
/// How many inertial parameters it has.
int count_of(const element_record& e) {
  if (e.type == "inertia_gen") return 1;
  return e.type == "inertia_2D" ? 4 : e.type == "inertia_3D" ? 10 : 0;
}
std::array<double, 10> unit(int i) {
  std::array<double, 10> p{};
  p[static_cast<std::size_t>(i)] = 1;
  return p;
}

/// Every column is the inverse dynamics of a chain in which one body has only that parameter. No body has a first
/// moment without a mass: there it is the difference to the mass alone.
void check_columns(const model_record& all, unsigned seed) {
  const auto record = without_forces(all);
  const auto c = models::registered(record);
  auto s = c.make_state();
  random_numbers random(seed);
  const random_motion<double> x(c, random);
  const Eigen::MatrixXd y = torque_regressor(c, s, x.q, x.v, x.a);
  model_record nothing = record;
  for (auto& e : nothing.elements)
    if (count_of(e) > 0) put_parameters(e, {});
  int column = 0;
  for (std::size_t n = 0; n < record.elements.size(); ++n) {
    const int count = count_of(record.elements[n]);
    const auto forces_of = [&](const std::array<double, 10>& p) {
      model_record one = nothing;
      put_parameters(one.elements[n], p);
      const auto single = models::registered(one);
      auto t = single.make_state();
      return Eigen::VectorXd(inverse_dynamics(single, t, x.q, x.v, x.a));
    };
    for (int i = 0; i < count; ++i, ++column) {
      const int number = count == 4 ? std::array{0, 1, 2, 9}[static_cast<std::size_t>(i)] : i;
      auto p = unit(number);
      Eigen::VectorXd expected;
      if (number >= 1 && number <= 3) {
        p[0] = 1;
        expected = forces_of(p) - forces_of(unit(0));
      } else {
        expected = forces_of(p);
      }
      // Entries are below 30, forces that are subtracted as well.
      REQUIRE(expected.cwiseAbs().maxCoeff() < 30);
      CHECK((y.col(column) - expected).cwiseAbs().maxCoeff() < 30 * rounding);
    }
  }
  CHECK(column == y.cols());
}

/// Static against runtime, and both against inverse dynamics: `parameters` and `regressor` of the static chain.
void check(const model& x, const Eigen::VectorXd& pi,
           Eigen::MatrixXd (*regressor)(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a),
           const model_record& record, unsigned seed) {
  const auto& c = x.in_double;
  const auto &with_forces = x.runtime, alone = models::registered(without_forces(record));
  auto s = with_forces.make_state(), t = alone.make_state();
  CHECK((inertial_parameters(with_forces) - pi).cwiseAbs().maxCoeff() <= rounding * pi.cwiseAbs().maxCoeff());
  random_numbers random(seed);
  for (int round = 0; round < 20; ++round) {
    const random_motion<double> m(with_forces, random);
    const auto y = regressor(m.q, m.v, m.a);
    const Eigen::MatrixXd r = torque_regressor(with_forces, s, m.q, m.v, m.a);
    CHECK(torque_regressor(with_forces, s) == r);  // of the state, which has taken them
    CHECK(gap(y, r) < rounding);
    // Y pi is inverse dynamics without the forces of other elements.
    const Eigen::VectorXd of_bodies = inverse_dynamics(alone, t, m.q, m.v, m.a);
    CHECK(gap_of_forces(y, pi, of_bodies) < rounding);
    CHECK(gap_of_forces(r, pi, of_bodies) < rounding);
    const Eigen::VectorXd parts = c.mass_matrix(m.q) * m.a + c.coriolis_forces(m.q, m.v) + c.gravity_forces(m.q);
    CHECK(gap_of_forces(y, pi, parts) < rounding);
  }
}
template <const auto& Chain>
void check(const model& x, unsigned seed) {
  const auto regressor = [](const auto& q, const auto& v, const auto& a) -> Eigen::MatrixXd {
    return torque_regressor(Chain, q, v, a);
  };
  check(x, inertial_parameters(Chain), regressor, record_of(Chain), seed);
}

TEST_CASE("regressor of two links in the plane, by its formula") {
  // Both frames in the joints, bodies with c anywhere. At 50 digits, then in double.
  const auto check_formula = [](const auto& arm, auto scalar, double tolerance) {
    using S = decltype(scalar);
    using std::cos, std::sin;
    const S l = S(0.75), g = S(9.8125);  // of few bits
    random_numbers random(5);
    for (int round = 0; round < 10; ++round) {
      std::array<S, 2> q, v, a;
      for (auto* x : {&q, &v, &a})
        for (auto& number : *x) number = S(random(3));
      const S s1 = sin(q[0]), c1 = cos(q[0]), s2 = sin(q[1]), c2 = cos(q[1]);
      const S w1 = v[0], a1 = a[0], w = v[0] + v[1], al = a[0] + a[1];
      // The acceleration of the elbow against gravity, in axes of the first link and of the second.
      const S ex = g * s1 - l * w1 * w1, ey = g * c1 + l * a1;
      const S fx = c2 * ex + s2 * ey, fy = c2 * ey - s2 * ex;
      // The second body needs m f + (al x h + w x (w x h)) there, and this on the way l of the first link.
      Eigen::Matrix<S, 2, 8> y;
      y << S(0), g * c1, -g * s1, a1,                                                     //
          l * ey, fy + l * (c2 * al - s2 * w * w), -fx - l * (s2 * al + c2 * w * w), al,  //
          S(0), S(0), S(0), S(0), S(0), fy, -fx, al;
      CHECK(gap(arm(q, v, a), y) < tolerance);
    }
  };
  constexpr auto c = chain(revolute_joint_2D(q1, table, cart), inertia_2D(cart, planar_body(2.0, 0.3, along_x(0.1))),
                           rigid_link_2D(cart, rail, along_x(0.75)), revolute_joint_2D(q2, rail, disc),
                           inertia_2D(disc, point_mass(0.8)))
                         .gravity(along_y(-9.8125));
  const auto in_static = [&](const auto& q, const auto& v, const auto& a) { return torque_regressor(c, q, v, a); };
  check_formula(in_static, big(), 1e-47);
  check_formula(in_static, 0.0, 30 * eps);  // of some 15 roundings in a row, as has the formula
  check_formula(in_static, 0.0f, 30 * static_cast<double>(std::numeric_limits<float>::epsilon()));
  const auto model = models::element_by_element(c);
  auto s = model.make_state();
  check_formula([&](const auto& q, const auto& v, const auto& a) { return torque_regressor(model, s, q, v, a); }, 0.0,
                30 * eps);
  Eigen::Matrix<double, 8, 1> pi;
  pi << 2.0, 0.2, 0.0, 0.32, 0.8, 0.0, 0.0, 0.0;
  CHECK((inertial_parameters(c) - pi).cwiseAbs().maxCoeff() <= eps / 4);  // of m c^2
}

TEST_CASE("derivative of a regressor by dual numbers") {
  // The mass of the pendulum at l: l (g cos q + l a).
  using number = dual<double, 1>;
  std::array<number, 1> q{number(0.5)}, v{number(3.0)}, a{number(2.0)};
  q[0].derivative[0] = 1;
  const auto y = torque_regressor(models::pendulum.gravity(along_y(-8.0)), q, v, a);
  CHECK(y(0, 0).value == within_relative(0.5 * (8 * std::cos(0.5) + 1), 4 * eps));
  CHECK(y(0, 0).derivative[0] == within_relative(-4 * std::sin(0.5), 4 * eps));
}

TEST_CASE("regressor times parameters is inverse dynamics of bodies") {
  check<robots::iiwa14>(static_models::iiwa14(), 1);
  check<planar>(static_models::planar(), 2);  // with a mass on a coordinate, and a spring
  check<geared>(static_models::geared(), 3);  // coordinates that follow others, or are shared by two joints
}

TEST_CASE("regressor of trees of runtime chains") {
  for (const auto& record : {record_of(floating_with_springs), record_of(models::tree)}) {
    const auto c = models::registered(record), alone = models::registered(without_forces(record));
    auto s = c.make_state(), t = alone.make_state();
    const auto pi = inertial_parameters(c);
    random_numbers random(4);
    for (int round = 0; round < 20; ++round) {
      const auto [q, v, a] = random_motion<double>(c, random);
      const Eigen::MatrixXd y = torque_regressor(c, s, q, v, a);
      CHECK(gap_of_forces(y, pi, inverse_dynamics(alone, t, q, v, a)) < rounding);
    }
  }
}

TEST_CASE("the regressor of a floating tree does not depend on how far away it is") {
  const auto c = models::registered(without_forces(record_of(floating_with_springs)));
  auto s = c.make_state();
  random_numbers random(6);
  auto [q, v, a] = random_motion<double>(c, random);
  const Eigen::MatrixXd here = torque_regressor(c, s, q, v, a);
  int poses = 0;
  for (const auto& entry : layout(c))
    if (entry.what == kind::pose_3D) q[static_cast<std::size_t>(entry.q)] += 1e9, ++poses;
  REQUIRE(poses == 1);
  CHECK(Eigen::MatrixXd(torque_regressor(c, s, q, v, a)) == here);
}

TEST_CASE("columns of the regressor are forces of bodies of unit parameters") {
  check_columns(record_of(robots::iiwa14), 11);
  check_columns(record_of(floating), 12);
  check_columns(record_of(planar), 13);
  check_columns(record_of(models::tree), 14);
}

TEST_CASE("a change of parameters changes inverse dynamics by their columns") {
  const auto record = record_of(robots::iiwa14);
  const auto c = models::registered(record);
  auto s = c.make_state();
  random_numbers random(21);
  for (std::size_t n = 0; n < record.elements.size(); ++n) {
    if (record.elements[n].type != "inertia_3D") continue;
    auto changed = record;
    auto& p = changed.elements[n].parameters;
    p[0].values[0] += 0.5;
    for (auto& x : p[1].values) x += random(0.1);
    for (const std::size_t diagonal : {0u, 3u, 5u}) p[2].values[diagonal] += 0.5;
    p[2].values[1] += random(0.1);
    const auto other = models::registered(changed);
    auto t = other.make_state();
    const auto [q, v, a] = random_motion<double>(c, random);
    const Eigen::MatrixXd y = torque_regressor(c, s, q, v, a);
    CHECK(torque_regressor(other, t, q, v, a) == y);  // which knows no parameters
    const Eigen::VectorXd difference = inertial_parameters(other) - inertial_parameters(c);
    const Eigen::VectorXd before = inverse_dynamics(c, s, q, v, a), after = inverse_dynamics(other, t, q, v, a);
    CHECK((y * difference - (after - before)).cwiseAbs().maxCoeff() < rounding * largest(after));
    CHECK(difference.cwiseAbs().maxCoeff() >= 0.5);
  }
}

TEST_CASE("regressor of a state with bases that move and coordinates that are given") {
  constexpr auto c = chain(base_gen(q1), prismatic_joint_2D(q1, table, cart, axis::x),
                           inertia_2D(cart, planar_body(2.0, 0.3, vec3{0.1, -0.2, zero})), inertia_gen(q1, 0.7),
                           revolute_joint_2D(q2, cart, disc), inertia_2D(disc, planar_body(0.8, 0.05, along_x(0.25))),
                           inertia_2D(table, point_mass(1.0)), inertia_2D(cart, point_mass(3.0)));
  const auto put = [](auto& s, auto& base, auto& given, auto& free) {
    base.acceleration = {1.0, 5.0}, base.ang_velocity = 3.0, base.ang_acceleration = 7.0;
    given.q = 0.5, given.q_dot = -2.0, given.q_ddot = 4.0;
    free.q = 0.3, free.q_dot = 1.5, free.q_ddot = -2.5;
    return s;
  };
  auto s = make_state(c);
  put(s, s[table], s[q1], s[q2]);
  const auto y = torque_regressor(c, s);
  STATIC_REQUIRE(decltype(y)::RowsAtCompileTime == 1);
  CHECK(gap_of_forces(y, inertial_parameters(c), inverse_dynamics(c, s)) < rounding);
  CHECK(y.leftCols<5>().isZero(0));   // of the cart, and the mass on its coordinate
  CHECK(y.rightCols<8>().isZero(0));  // of the table and the cart
  CHECK(y(0, 8) == -2.5 + 7.0 + 0.0);
  const auto model = models::element_by_element(c);
  auto t = model.make_state();
  put(t, t.frame_2D("table"), t.coordinate("q1"), t.coordinate("q2"));
  CHECK(gap(torque_regressor(model, t), y) < rounding);
}

TEST_CASE("regressors that are too large for the stack") {
  STATIC_REQUIRE(detail::regressor_matrix<double, 7, 70>::ColsAtCompileTime == 70);
  STATIC_REQUIRE(detail::regressor_matrix<double, 128, 1280>::ColsAtCompileTime == Eigen::Dynamic);
}

TEST_CASE("regressor of bad arguments") {
  const auto model = models::element_by_element(robots::iiwa14);
  auto s = model.make_state();
  const std::array<double, 7> x{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7};
  CHECK_THROWS_AS(torque_regressor(model, s, x, x, std::array{1.0}), bad_argument);
  CHECK_THROWS_AS(torque_regressor(robots::iiwa14, x, x, std::vector{1.0}), bad_argument);
  for (std::size_t i = 0; i < 7; ++i) {
    auto bad = x;
    bad[i] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(torque_regressor(model, s, bad, x, x), bad_argument);
    CHECK_THROWS_AS(torque_regressor(model, s, x, bad, x), bad_argument);
    CHECK_THROWS_AS(torque_regressor(model, s, x, x, bad), bad_argument);
    CHECK_THROWS_AS(torque_regressor(robots::iiwa14, bad, x, x), bad_argument);
    CHECK_THROWS_AS(torque_regressor(robots::iiwa14, x, bad, x), bad_argument);
    CHECK_THROWS_AS(torque_regressor(robots::iiwa14, x, x, bad), bad_argument);
  }
  auto large = x;
  large[2] = 1e160;
  CHECK_THROWS_MATCHES(torque_regressor(model, s, x, large, x), bad_argument, says("v[2] of 'q3' is 1e+160"));
  CHECK_THROWS_MATCHES(torque_regressor(robots::iiwa14, x, large, x), bad_argument, says("v[2] of 'q3' is 1e+160"));
}

}  // namespace regressor_test
