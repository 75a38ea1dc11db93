#include <kte/elements/inertia.hpp>
#include <kte/elements/rigid_link.hpp>
#include <kte/elements/spherical_joint.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/runge_kutta4.hpp>
#include <kte/models/runtime_dynamics_model.hpp>

#include "catch.hpp"

// Explicit methods keep right-hand sides of states of dynamic size behind virtual functions.

namespace erased_system_test {

using vector = Eigen::VectorXd;

/// Counts its calls, and is copied with its count.
struct oscillator {
  int calls = 0;
  vector operator()(double, const vector& x) { return ++calls, vector(Eigen::Vector2d(x[1], -x[0])); }
};

TEST_CASE("one type of solver serves all right-hand sides of states of dynamic size") {
  const vector x0 = Eigen::Vector2d(1, 0);
  kte::dormand_prince45 first(oscillator{}, 0.0, x0);
  kte::dormand_prince45 second([](double, const auto& x) { return (-x).eval(); }, 0.0, x0);
  static_assert(std::is_same_v<decltype(first), decltype(second)>);
  first = second;
  first.integrate(1.0), second.integrate(1.0);
  CHECK(first.state() == second.state());
}

TEST_CASE("a solver moves by its right-hand side as if it knew its type") {
  const vector x0 = Eigen::Vector2d(1, 0);
  kte::dormand_prince45 erased(oscillator{}, 0.0, x0);
  kte::dormand_prince45<oscillator, vector> known(oscillator{}, 0.0, x0);
  std::vector<vector> by_erased, by_known;
  erased.integrate(3.0, kte::every(0.25), [&](double, const vector& x) { by_erased.push_back(x); });
  known.integrate(3.0, kte::every(0.25), [&](double, const vector& x) { by_known.push_back(x); });
  CHECK(by_erased == by_known);
  CHECK(erased.statistics().evaluations == known.statistics().evaluations);
}

TEST_CASE("a copy of a solver has its own right-hand side, unless that is shared") {
  const vector x0 = Eigen::Vector2d(1, 0);
  oscillator shared;
  kte::runge_kutta4 by_reference(std::ref(shared), 0.0, x0, 0.1);
  auto copy = by_reference;
  by_reference.integrate(0.1), copy.integrate(0.1);
  CHECK(shared.calls == 8);

  kte::runge_kutta4 by_value([k = 0](double, const vector& x) mutable { return vector(x * ++k); }, 0.0, x0, 0.1);
  auto other = by_value;
  by_value.integrate(0.1), other.integrate(0.1);
  CHECK(by_value.state() == other.state());
}

TEST_CASE("what a right-hand side throws comes through") {
  kte::dormand_prince45 solver(
      [](double t, const vector& x) {
        if (t > 0.5) throw std::runtime_error("no further");
        return x;
      },
      0.0, vector(Eigen::Vector2d(1, 0)));
  CHECK_THROWS_AS(solver.integrate(1.0), std::runtime_error);
}

TEST_CASE("a runtime chain with rotations moves on the group behind virtual functions") {
  kte::runtime_chain top;
  top.gravity(kte::along_z(-9.81)) << kte::spherical_joint_3D("turn", "base", "body")
                                   << kte::inertia_3D("body", kte::rigid_body{1.0, kte::along_z(0.1),
                                                                              kte::sym3{0.02, 0, 0, 0.02, 0, 0.01}});
  const kte::manipulator_dynamics_model model(top);
  const vector start = model.make_x(Eigen::Vector4d(0.8, 0.6, 0, 0), Eigen::Vector3d(0, 0, 40));
  const kte::manipulator_dynamics_model again(top);
  kte::runge_kutta4 erased(std::cref(model), 0.0, start, 1e-3);
  kte::runge_kutta4<std::reference_wrapper<std::remove_reference_t<decltype(again)>>, vector> known(std::cref(again),
                                                                                                    0.0, start, 1e-3);
  erased.integrate(0.5), known.integrate(0.5);
  CHECK(erased.state() == known.state());
  CHECK(std::abs(erased.state().head<4>().norm() - 1) < 4e-16);
}

}  // namespace erased_system_test
