#include <kte/models/runtime_models.hpp>

#include "dynamics/small_chains.hpp"
#include "robots/iiwa14.hpp"

// Models are chains with the functions that controllers ask for: against the algorithms that they call, and rates of
// change against differences.

namespace models_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::small_chains;

constexpr struct far_ final : frame_2D_key<"far"> {
} far;

template <class Chain, class Matrix>
double change_error(const Chain& c, const random_motion_of<big, Chain>& m, const auto& both, const Matrix& at) {
  double worst = 0;
  for (int i = 0; i < both.rows(); ++i)
    for (int j = 0; j < both.cols(); ++j) {
      const big d = derivative([&](const big& t) { return big(at(integrate(c, m.q, m.v, t))(i, j)); });
      worst = test::worse(worst, static_cast<double>(abs(big(both(i, j) - d)) / (1 + abs(d))));
    }
  return worst;
}

TEST_CASE("an inverse dynamics model gives forces, mass matrix and its change") {
  const inverse_dynamics_model model(floating_with_springs);
  random_numbers random(1);
  const random_motion_of<double, std::remove_const_t<decltype(floating_with_springs)>> m(floating_with_springs, random);
  CHECK(model.computeForces(m.q, m.v, m.a) == inverse_dynamics(floating_with_springs, m.q, m.v, m.a));
  CHECK(model.getMassMatrix(m.q) == mass_matrix(floating_with_springs, m.q));

  inverse_dynamics_model runtime(models::element_by_element(floating_with_springs));
  CHECK((runtime.computeForces(m.q, m.v, m.a) - model.computeForces(m.q, m.v, m.a)).norm() < 1e-12);
  CHECK((runtime.getMassMatrix(m.q) - model.getMassMatrix(m.q)).norm() < 1e-14 * model.getMassMatrix(m.q).norm());

  const random_motion_of<big, std::remove_const_t<decltype(planar)>> exact(planar, random);
  const inverse_dynamics_model flat(planar);
  const auto [mass, change] = flat.getMassMatrixAndDerivative(exact.q, exact.v);
  CHECK(mass == flat.getMassMatrix(exact.q));
  CHECK(change_error(planar, exact, change, [&](const auto& q) { return mass_matrix(planar, q); }) < by_differences);
}

TEST_CASE("a kinematics model gives poses, Jacobians and their change") {
  const auto tool = robots::iiwa14_names::tool;
  const manipulator_kinematics_model model(robots::iiwa14, tool);
  random_numbers random(2);
  const random_motion_of<double, std::remove_const_t<decltype(robots::iiwa14)>> m(robots::iiwa14, random);
  const auto p = forward_kinematics(robots::iiwa14, m.q, tool);
  CHECK(model.getDependentPoses(m.q)[0].position.x == p.position.x);
  CHECK(model.getJacobianMatrix(m.q) == jacobian(robots::iiwa14, m.q, tool, in_world_axes));
  CHECK(model.getDependentVelocities(m.q, m.v) == model.getJacobianMatrix(m.q) * m.v);
  const Eigen::VectorXd by_rate = model.getJacobianMatrix(m.q) * m.a +
                                  model.getJacobianMatrixAndDerivative(m.q, m.v).second * m.v,
                        accelerations = model.getDependentAccelerations(m.q, m.v, m.a);
  CHECK((accelerations - by_rate).norm() < 1e-14 * by_rate.norm());

  manipulator_kinematics_model runtime(models::registered(record_of(robots::iiwa14)), {std::string(tool.name)});
  CHECK((runtime.getJacobianMatrix(m.q) - model.getJacobianMatrix(m.q)).norm() < 1e-14);
  CHECK((runtime.getDependentVelocities(m.q, m.v) - model.getDependentVelocities(m.q, m.v)).norm() < 1e-13);
  CHECK((runtime.getDependentAccelerations(m.q, m.v, m.a) - accelerations).norm() < 1e-14 * by_rate.norm());
  CHECK(std::abs(runtime.getDependentPoses(m.q)[0].position.z - p.position.z) < 1e-15);
  const auto first = runtime.wiring().names[static_cast<std::size_t>(kind::gen)].front();
  CHECK_THROWS_AS(manipulator_kinematics_model(models::registered(record_of(robots::iiwa14)), {first}), unknown_name);
  CHECK_THROWS_WITH(manipulator_kinematics_model(models::registered(record_of(robots::iiwa14)), {"tol"}),
                    contains_text("nothing named 'tol'"));

  const random_motion_of<big, std::remove_const_t<decltype(planar)>> exact(planar, random);
  const manipulator_kinematics_model flat(planar, disc, cart);
  const auto [j, change] = flat.getJacobianMatrixAndDerivative(exact.q, exact.v);
  CHECK(j == flat.getJacobianMatrix(exact.q));
  CHECK(change_error(planar, exact, change, [&](const auto& q) { return flat.getJacobianMatrix(q); }) < by_differences);
}

TEST_CASE("a model is an element of larger chains") {
  const manipulator_kinematics_model slide(planar.gravity(zero3{}), disc);
  const auto larger = chain(slide, revolute_joint_2D(q2, disc, far));
  CHECK(larger.dofs == planar.dofs + 1);
  auto s = make_state(slide);  // and passes work on it
  slide.doMotion(s), slide.clearForce(s), slide.doForce(s);
  CHECK(positions(s) == Eigen::Vector4d::Zero());
  runtime_chain c;
  c << slide << base_3D("ground") << inverse_dynamics_model(models::element_by_element(geared));
  CHECK(c.dofs() == planar.dofs + geared.dofs - 1);  // they share q1
}

}  // namespace models_test
