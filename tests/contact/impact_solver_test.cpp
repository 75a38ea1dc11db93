#include <kte/contact/impact.hpp>

#include "catch.hpp"
#include "contact/friction_scenes.hpp"

namespace impact_solver_test {

using namespace kte;
using test::says;

/// W of the lower tip of a rod of mass 1 and length 2 at an angle above the horizontal, rows (n, t).
Eigen::MatrixXd rod(double angle) {
  const double x = -cos(angle), y = -sin(angle), I = 1.0 / 3;
  return Eigen::Matrix2d{{1 + x * x / I, -x * y / I}, {-x * y / I, 1 + y * y / I}};
}
const std::vector<friction_contact<>> rough(double mu) { return {{.rows = 2, .friction = mu}}; }

TEST_CASE("Impact: Painleve's rod: no solution, a tangential impact, and two solutions") {
  const Eigen::MatrixXd W = rod(1);
  auto contacts = rough(2);
  friction_solver<> friction;
  contacts[0].sliding = {-1, 0};  // the tip slides at -1
  const auto acceleration = [](double omega) {
    return Eigen::VectorXd(Eigen::Vector2d(-9.81 + omega * omega * sin(1), omega * omega * cos(1)));
  };
  CHECK(W(0, 0) + 2 * W(0, 1) == within(-0.852113, 1e-6));  // W_nn - mu W_nt d
  const Eigen::VectorXd jam = acceleration(0), either = acceleration(5);
  CHECK(friction.solve({W, jam, contacts}).status == friction_status::no_solution);
  CHECK(friction.solutions({W, jam, contacts}).empty());

  REQUIRE(friction.solutions({W, either, contacts}).size() == 2);
  CHECK(friction.solve({W, either, contacts}).status == friction_status::several_solutions);
  CHECK(friction.solve({W, either, contacts}).modes[0] == friction_mode::open);
  const std::vector<double> pressed{10, 20};
  CHECK(friction.solve({W, either, contacts}, {}, pressed).modes[0] == friction_mode::slides);

  contacts[0].sliding.reset(), contacts[0].pressed = true;
  const Eigen::VectorXd before = Eigen::Vector2d(0, -1);
  impact_solver<> impact;
  const std::vector<double> e{0};
  const auto& x = impact.solve({W, before, contacts}, e);
  REQUIRE(x.solved());
  CHECK(x.impulse[0] == within(0.34098653505963, 1e-14));
  CHECK(x.impulse[1] == within(0.46894493629482, 1e-14));
  CHECK(-1 + x.impulse[1] == within(-0.53105506370518, 1e-14));
  CHECK(3 * (-cos(1) * x.impulse[0] + sin(1) * x.impulse[1]) == within(0.63110323860592, 1e-13));
  CHECK(x.u[0] == within(0, 1e-15));
}

TEST_CASE("Impact: a tangential impact in space equals that in the plane") {
  const Eigen::MatrixXd plane = rod(1);
  Eigen::MatrixXd W = Eigen::MatrixXd::Zero(3, 3);
  W.topLeftCorner<2, 2>() = plane;
  W(2, 2) = 1;
  const std::vector<friction_contact<>> contacts{{.rows = 3, .friction = 2, .pressed = true}};
  const Eigen::VectorXd before = Eigen::Vector3d(0, -1, 0);
  impact_solver<> impact;
  const std::vector<double> e{0};
  const auto& x = impact.solve({W, before, contacts}, e);
  REQUIRE(x.solved());
  CHECK(x.impulse[0] == within(0.34098653505963, 1e-14));
  CHECK(x.impulse[1] == within(0.46894493629482, 1e-14));
}

TEST_CASE("Impact: restitution that would gain energy is reduced") {
  const Eigen::MatrixXd W = rod(0.8);
  const Eigen::VectorXd before = Eigen::Vector2d(0.5, -1);
  const Eigen::VectorXd approaching = Eigen::Vector2d(-1, 0.5);
  impact_solver<> impact;
  const std::vector<double> e{0.9};

  friction_solver<> friction;  // unguarded
  const Eigen::VectorXd shifted = Eigen::Vector2d(-1.9, 0.5);
  const auto contacts = rough(0.5);
  const auto& y = friction.solve({W, shifted, contacts});
  const double gain = (y.lambda[0] * (y.u[0] - 0.9 * -1 + -1) / 2 + y.lambda[1] * (y.u[1] + 0.5) / 2);
  const double kinetic = approaching.dot(W.ldlt().solve(approaching)) / 2;
  CHECK(gain > 0);
  CHECK(kinetic > 0);

  const auto& x = impact.solve({W, approaching, contacts}, e);
  REQUIRE(x.solved());
  CHECK(x.restitution_factor == within(0.8971651092469972, 5e-16));
  CHECK(x.energy <= 0);
  CHECK(x.energy == within(0, 1e-15));
  CHECK(x.u[0] == within(0.9 * x.restitution_factor, 1e-14));
  CHECK(impact.solve({W, before, contacts}, e).impulse[0] == 0);  // separates
}

TEST_CASE("Impact: Newton's cradle, one at a time and all at once") {
  Eigen::MatrixXd W = Eigen::MatrixXd::Zero(8, 8);
  for (int i = 0; i < 4; ++i) {
    W(2 * i, 2 * i) = 2;
    if (i > 0) W(2 * i, 2 * i - 2) = W(2 * i - 2, 2 * i) = -1;
  }
  Eigen::VectorXd before = Eigen::VectorXd::Zero(8);
  before[0] = -1;
  const std::vector<friction_contact<>> contacts(4, {.rows = 2});
  const std::vector<double> e(4, 1.0);
  impact_solver<> impact;
  const auto velocities = [&](impact_law law) {
    const auto& x = impact.solve({W, before, contacts}, e, law);
    REQUIRE(x.solved());
    CHECK(x.energy == within(0, 1e-15));
    std::vector<double> v{1, 0, 0, 0, 0};
    for (std::size_t i = 0; i < 4; ++i) v[i] -= x.impulse[2 * i], v[i + 1] += x.impulse[2 * i];
    return v;
  };
  CHECK(velocities(impact_law::sequential) == std::vector<double>{0, 0, 0, 0, 1});
  const auto at_once = velocities(impact_law::at_once);
  CHECK(at_once[0] == within(-0.6, 1e-15));
  for (std::size_t i = 1; i < 5; ++i) CHECK(at_once[i] == within(0.4, 1e-15));
}

TEST_CASE("Impact: energy never grows, in either law") {
  test::friction_scenes random(21);
  impact_solver<> impact;
  int reduced = 0;
  for (int i = 0; i < 60; ++i) {
    const auto s = random.points(1 + i % 4);
    std::vector<double> e;
    for (std::size_t k = 0; k < s.contacts.size(); ++k) e.push_back(random.uniform(0.3, 1));
    for (const auto law : {impact_law::at_once, impact_law::sequential}) {
      const auto& x = impact.solve(s.problem(), e, law);
      INFO("scene " << i << ", residual " << x.residual);
      REQUIRE(x.solved());
      CHECK(x.energy <= 1e-9);
      double size = s.b.cwiseAbs().maxCoeff() / s.W.diagonal().minCoeff();  // of residuals
      for (const double p : x.impulse) size = std::max(size, std::abs(p));
      for (std::size_t k = 0; k < s.contacts.size(); ++k) {
        CHECK(x.impulse[3 * k] >= -1e-12 * size);
        CHECK(x.u[3 * k] >= -1e-9);
      }
      reduced += x.restitution_factor < 1;
    }
  }
  CHECK(reduced > 0);
}

TEST_CASE("Impact: fixed sliding directions, and sticking friction above that of sliding") {
  const Eigen::MatrixXd W = Eigen::Matrix3d::Identity();
  friction_solver<> friction;
  std::vector<friction_contact<>> contacts{{.rows = 3, .friction = 0.5, .sticking_friction = 0.8}};
  const auto tangential = [&](double pull) {
    const Eigen::VectorXd b = Eigen::Vector3d(-1, 0, pull);
    return friction.solve({W, b, contacts}).lambda[2];
  };
  CHECK(tangential(0.7) == within(-0.7, 1e-15));  // sticks
  CHECK(tangential(0.9) == within(-0.5, 1e-15));  // slides
  contacts[0].sliding = {0.6, 0.8};
  CHECK(tangential(0) == within(-0.4, 1e-15));
  CHECK(tangential(5) == within(-0.4, 1e-15));
}

TEST_CASE("Impact: invalid arguments") {
  friction_solver<> friction;
  impact_solver<> impact;
  const Eigen::MatrixXd W = rod(1);
  const Eigen::VectorXd b = Eigen::Vector2d(-1, 0), short_b = Eigen::VectorXd::Zero(1);
  const auto contacts = rough(0.5), negative = rough(-1), space = std::vector<friction_contact<>>(1);
  CHECK_THROWS_MATCHES(friction.solve({W, short_b, contacts}), bad_argument, says("sizes of W and b"));
  CHECK_THROWS_MATCHES(friction.solve({W, b, space}), bad_argument, says("sizes of W and b"));
  CHECK_THROWS_MATCHES(friction.solve({W, b, negative}), bad_argument, says("friction must be finite"));
  const std::vector<double> none, large{1.1};
  CHECK_THROWS_MATCHES(impact.solve({W, b, contacts}, none), bad_argument, says("one restitution"));
  CHECK_THROWS_MATCHES(impact.solve({W, b, contacts}, large), bad_argument, says("between 0 and 1"));
  const std::vector<friction_contact<>> ball{{.rows = 3, .friction = 0.5}};
  const Eigen::MatrixXd W3 = Eigen::Matrix3d::Identity();
  const Eigen::VectorXd b3 = Eigen::Vector3d(-1, 0, 0);
  CHECK_THROWS_MATCHES(friction.solutions({W3, b3, ball}), bad_argument, says("piecewise linear"));
}

}  // namespace impact_solver_test
