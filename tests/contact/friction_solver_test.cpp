#include <kte/contact/friction_solver.hpp>

#include <Eigen/Dense>

#include "catch.hpp"
#include "contact/friction_statistics.hpp"
#include "digits50.hpp"

namespace friction_solver_test {

using namespace kte;
using test::digits50;
using test::friction_scene;
using test::friction_scenes;
using test::worst_of;

TEST_CASE("Friction: all random problems of a few points are solved, by the laws themselves") {
  for (int n = 1; n <= 4; ++n) {
    CHECK(worst_of(250, [n](auto& r) { return r.plate(n); }) < 1e-10);
    CHECK(worst_of(250, [n](auto& r) { return r.points(n); }) < 1e-10);
    CHECK(worst_of(250, [n](auto& r) { return r.legs(n, 0.8); }) < 1e-10);
  }
  CHECK(worst_of(50, [](auto& r) { return r.plate(8); }) < 1e-10);
  CHECK(worst_of(5, [](auto& r) { return r.tower(8); }) < 1e-10);
}

TEST_CASE("Friction: Newton's method and the Gauss-Seidel method agree where the solution is unique") {
  friction_scenes random(11);
  friction_solver<> solver;
  for (int i = 0; i < 50; ++i) {
    const friction_scene s = random.legs(4, 0.3);
    const auto& x = solver.solve(s.problem());
    REQUIRE(x.method == friction_method::newton);
    detail::friction_system<double> system;
    system.assign(s.problem());
    for (std::size_t k = 0; k < 4; ++k) system.mu[k] = 0.3;
    std::vector<double> lambda(12, 0.0), u(s.b.data(), s.b.data() + 12);
    for (int sweep = 0; sweep < 400; ++sweep) detail::gauss_seidel_sweep(system, lambda.data(), u.data());
    for (std::size_t r = 0; r < 12; ++r) CHECK(x.lambda[r] == within(lambda[r], 1e-11));
  }
}

TEST_CASE("Friction: enumeration finds what Newton's method finds in the plane") {
  friction_scenes random(12);
  friction_solver<> solver;
  detail::friction_newton<double> newton;
  int compared = 0;
  for (int i = 0; i < 200; ++i) {
    const friction_scene s = random.plane(1 + i % 3, 0.4, 0.3);
    detail::friction_system<double> system;
    system.assign(s.problem());
    std::vector<double> lambda(static_cast<std::size_t>(s.b.size()), 0.0);
    double residual = 1;
    newton.solve(system, lambda.data(), 0.0, 40, 1e-13, false, residual);
    const auto all = solver.solutions(s.problem());
    REQUIRE_FALSE(all.empty());
    if (residual > 1e-13) continue;
    const Eigen::VectorXd u = s.W * Eigen::Map<Eigen::VectorXd>(lambda.data(), s.b.size()) + s.b;
    double nearest = 1;
    for (const auto& x : all) {
      CHECK(test::violation(s, x.lambda) < 1e-11);
      nearest = std::min(nearest, (Eigen::Map<const Eigen::VectorXd>(x.u.data(), u.size()) - u).cwiseAbs().maxCoeff());
    }
    CHECK(nearest < 1e-11);
    ++compared;
  }
  CHECK(compared > 190);
}

TEST_CASE("Friction: double agrees with numbers of 50 digits") {
  friction_scenes random(13);
  friction_solver<> solver;
  friction_solver<digits50> exact;
  for (int i = 0; i < 3; ++i) {
    const friction_scene s = random.legs(4, 0.5);
    const Eigen::Matrix<digits50, Eigen::Dynamic, Eigen::Dynamic> W = s.W.cast<digits50>();
    const Eigen::Matrix<digits50, Eigen::Dynamic, 1> b = s.b.cast<digits50>();
    const std::vector<friction_contact<digits50>> contacts(4, {.rows = 3, .friction = digits50(0.5)});
    friction_options<digits50> options;
    options.tolerance = digits50("1e-45");
    const auto& y = exact.solve({W, b, contacts}, options);
    REQUIRE(y.solved());
    CHECK(y.residual < digits50("1e-45"));
    friction_options<> polished;
    polished.polish = true;
    const auto& x = solver.solve(s.problem(), polished);
    for (std::size_t r = 0; r < 12; ++r) CHECK(x.lambda[r] == within(static_cast<double>(y.lambda[r]), 1e-14));
  }
}

TEST_CASE("Friction: a plate that sticks has the lambda of least norm") {
  friction_scenes random(14);
  friction_solver<> solver;
  int inside_all = 0;
  for (int i = 0; i < 20; ++i) {
    friction_scene s = random.plate(8, 0.8);
    Eigen::VectorXd pressing = Eigen::VectorXd::Zero(24);  // forces whose motion b undoes
    for (int k = 0; k < 8; ++k) pressing.segment<3>(3 * k) << random.uniform(0.8, 1), random.normal() / 10, 0.1;
    s.b = -s.W * pressing;
    const Eigen::VectorXd least = -s.W.completeOrthogonalDecomposition().solve(s.b);
    bool inside = true;
    for (int k = 0; k < 8; ++k) inside &= least.segment<2>(3 * k + 1).norm() < 0.79 * least[3 * k];
    if (!inside) continue;
    ++inside_all;
    const auto& x = solver.solve(s.problem());
    REQUIRE(x.solved());
    for (Eigen::Index r = 0; r < 24; ++r) CHECK(x.lambda[static_cast<std::size_t>(r)] == within(least[r], 1e-11));
    for (const auto mode : x.modes) CHECK(mode == friction_mode::sticks);
  }
  CHECK(inside_all > 5);
}

TEST_CASE("Friction: from a start, and with storage used before") {
  friction_scenes random(15);
  friction_solver<> solver;
  const friction_scene s = random.legs(4);
  const std::vector<double> lambda = solver.solve(s.problem()).lambda;
  CHECK(solver.solve(s.problem(), {}, lambda).iterations == 0);
  CHECK(solver.solve(random.legs(2).problem()).solved());
  CHECK(solver.solve(random.tower(2).problem()).solved());
  CHECK(solver.solve(s.problem()).lambda == lambda);
}

}  // namespace friction_solver_test
