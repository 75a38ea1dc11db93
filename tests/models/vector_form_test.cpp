#include <kte/integrators/adams.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/models/runtime_dynamics_model.hpp>
#include <kte/models/vector_form.hpp>

#include "dynamics/small_chains.hpp"

// Models as equations of vectors: the same motion as on the group.

using namespace kte;
using namespace kte::test;

TEST_CASE("The vector form of a model is the same motion, also for methods with a history") {
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
