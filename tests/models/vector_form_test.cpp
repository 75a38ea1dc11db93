#include <kte/integrators/adams.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/rodas.hpp>
#include <kte/models/runtime_dynamics_model.hpp>
#include <kte/models/vector_form.hpp>

#include "dynamics/small_chains.hpp"

// Models as equations of vectors have the motion of models on the group.

namespace vector_form_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::small_chains;

TEST_CASE("the vector form of a model is the same motion, also for methods with a history") {
  const manipulator_dynamics_model model(floating_with_springs);
  manipulator_dynamics_model runtime(models::element_by_element(floating_with_springs));
  random_numbers random(1);
  const random_motion_of<double, std::remove_const_t<decltype(floating_with_springs)>> m(floating_with_springs, random);
  const auto x0 = model.make_x(m.q, m.v);
  const tolerances<double> fine{.absolute = 1e-11, .relative = 1e-11};
  dormand_prince45 on_group(std::cref(model), 0.0, x0, fine);
  adams in_space(vector_form(std::cref(model)), 0.0, x0, fine);
  adams at_run_time(vector_form(std::ref(runtime)), 0.0, Eigen::VectorXd(x0), fine);
  on_group.integrate(1), in_space.integrate(1), at_run_time.integrate(1);
  // errors of some 100 steps within the tolerance, of a motion that spreads 10-fold
  CHECK((in_space.state() - on_group.state()).norm() < 1e-8);
  CHECK((at_run_time.state() - in_space.state()).norm() < 1e-8);
  CHECK(std::abs(in_space.state().segment<4>(3).norm() - 1) < 1e-8);
}

/// J against central differences of the rates of displacements.
template <class Model, class X>
void check_jacobian(Model& model, const X& x) {
  const auto j = model.jacobian(0.0, x);
  typename Model::rate d = Model::rate::Zero(model.rates());
  const auto rate_at = [&](Eigen::Index column, double h) {
    d[column] = h;
    X moved = x;
    model.displace(x, d, moved);
    typename Model::rate r = model(0.0, moved);
    model.pull_back(d, r);
    d[column] = 0;
    return r;
  };
  const double h = 1e-5, margin = 1e-8 * j.cwiseAbs().maxCoeff();  // h^2, and rounding over h, of third derivatives
  for (Eigen::Index i = 0; i < d.size(); ++i)
    CHECK((j.col(i) - (rate_at(i, h) - rate_at(i, -h)) / (2 * h)).cwiseAbs().maxCoeff() < margin);
}

TEST_CASE("models know their Jacobian, also where there are rotations; stiff methods save its differences") {
  random_numbers random(2);
  const manipulator_dynamics_model model(floating);
  manipulator_dynamics_model runtime(models::element_by_element(floating));
  const random_motion_of<double, std::remove_const_t<decltype(floating)>> m(floating, random);
  const auto x = model.make_x(m.q, m.v);
  check_jacobian(model, x);
  check_jacobian(runtime, Eigen::VectorXd(x));
  runtime_chain puck_with_arm;
  puck_with_arm << free_joint_2D("puck", "table", "disc")
                << inertia_2D("disc", planar_body(2.0, 0.3, vec3{0.1, -0.2, zero}))
                << revolute_joint_2D("q", "disc", "arm") << inertia_2D("arm", planar_body(0.8, 0.05, along_x(0.25)));
  puck_with_arm.gravity(weight);
  manipulator_dynamics_model in_plane(puck_with_arm);
  check_jacobian(in_plane, in_plane.make_x(std::array{0.3, -0.2, 0.7, 0.4}, std::array{0.5, -1.0, 2.0, 1.5}));
  Eigen::MatrixXd j;
  CHECK_FALSE(vector_form(std::ref(runtime)).jacobian(0, Eigen::VectorXd(x), j));  // of displacements, not of numbers
  manipulator_dynamics_model sprung(models::element_by_element(floating_with_springs));
  check_jacobian(sprung, sprung.make_x(m.q, m.v));
  puck_with_arm << joint_lugre_gen(
      "q", "bristles",
      {.sigma0 = 1e3, .sigma1 = 30, .sigma2 = 0.1, .coulomb = 1, .stiction = 2, .stribeck_velocity = 0.01});
  const manipulator_dynamics_model with_bristles(puck_with_arm);
  const auto still = with_bristles.make_x(std::array{0.0, 0.0, 0.0, 0.0}, std::array{0.0, 0.0, 0.0, 0.0});
  CHECK_THROWS_AS(with_bristles.jacobian(0, still), bad_argument);

  rodas solver(std::ref(runtime), 0.0, Eigen::VectorXd(x), {.absolute = 1e-6, .relative = 1e-6});
  solver.integrate(0.1);
  const auto& s = solver.statistics();
  CHECK(s.evaluations <= 7 * (s.steps + s.rejected) + 2);  // six stages, df/dt; the first step
}

}  // namespace vector_form_test
