#include <kte/dynamics/bias_forces.hpp>
#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/configurations.hpp>
#include <kte/dynamics/coriolis_matrix.hpp>
#include <kte/dynamics/energy.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/dynamics/mass_matrix_inverse.hpp>
#include <kte/elements/free_joint.hpp>
#include <kte/elements/inertia.hpp>
#include <kte/elements/prismatic_joint.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/elements/rigid_link.hpp>
#include <kte/elements/screw_joint.hpp>
#include <kte/elements/universal_joint.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include <string>

#include "catch.hpp"
#include "random.hpp"

// M, M^-1 and C of chains and trees of more than 32 axes: rows collected over several bodies, wrenches in world axes,
// rows written together.

namespace mass_matrix_large_test {

using namespace kte;

/// Bodies in a row, except that every `limb` bodies a new limb begins at the first body. The first moves freely if
/// `floats`.
runtime_chain tree_of(int bodies, int limb, bool floats) {
  runtime_chain c;
  c.gravity(along_z(-9.81));
  random_numbers random(static_cast<unsigned>(bodies));
  for (int i = 0; i < bodies; ++i) {
    const std::string n = std::to_string(i), on = i == 0          ? "base"
                                                  : i % limb == 0 ? "body0"
                                                                  : "body" + std::to_string(i - 1);
    c << rigid_link_3D(on, "mount" + n, vec3{random(0.3), random(0.3), 0.2});
    if (i == 0 && floats)
      c << free_joint_3D("pose", "mount0", "body0");
    else if (i % 11 == 6)
      c << screw_joint_3D("q" + n, "mount" + n, "body" + n, axis::y, 0.1);
    else if (i % 7 == 5)
      c << universal_joint_3D("q" + n, "p" + n, "mount" + n, "body" + n, axis::x, axis::y);
    else if (i % 5 == 3)
      c << prismatic_joint_3D("q" + n, "mount" + n, "body" + n, axis::x);
    else
      c << revolute_joint_3D("q" + n, "mount" + n, "body" + n, i % 2 == 0 ? vec3<>{0, 0, 1} : vec3<>{0, 1, 0});
    c << inertia_3D("body" + n, rigid_body{1.0 + 0.5 * random(), vec3{random(0.1), random(0.1), random(0.1)},
                                           sym3{0.03, 0.002, -0.001, 0.04, 0.001, 0.05}});
  }
  return c;
}

TEST_CASE("mass matrices of many axes, their inverses and rates") {
  struct shape {
    int bodies, limb;
    bool floats;
  };
  for (const auto& [bodies, limb, floats] :
       {shape{33, 33, false}, shape{45, 45, true}, shape{50, 7, true}, shape{41, 13, false}, shape{64, 9, false}}) {
    CAPTURE(bodies, limb, floats);
    const runtime_chain c = tree_of(bodies, limb, floats);
    auto s = c.make_state();
    random_numbers random(7);
    Eigen::VectorXd q = neutral_configuration(c), x(c.dofs()), zero = Eigen::VectorXd::Zero(c.dofs());
    for (int i = 0; i < x.size(); ++i) x[i] = random();
    q = integrate(c, q, x, 1.0);
    Eigen::VectorXd v(c.dofs());
    for (int i = 0; i < x.size(); ++i) x[i] = random(), v[i] = random();
    const Eigen::MatrixXd m = mass_matrix(c, s, q), inverse = mass_matrix_inverse(c, s, q);
    CHECK(m == m.transpose());
    CHECK(inverse == inverse.transpose());
    const Eigen::VectorXd bias = inverse_dynamics(c, s, q, zero, zero), force = inverse_dynamics(c, s, q, zero, x);
    CHECK((m * x - (force - bias)).cwiseAbs().maxCoeff() < 2e-14 * m.cwiseAbs().maxCoeff() * x.cwiseAbs().maxCoeff());
    const Eigen::MatrixXd coriolis = coriolis_matrix(c, s, q, v), rate = mass_matrix_rate(c, s, q, v);
    CHECK(rate == coriolis + coriolis.transpose());
    CHECK((coriolis * v - coriolis_forces(c, s, q, v)).cwiseAbs().maxCoeff() < 2e-14 * coriolis.cwiseAbs().maxCoeff());
    // d/dt (v . M v) at constant v, by central differences: an error of h^2 and of eps/h
    const double h = 1e-4;
    const auto twice_energy = [&](double t) { return 2 * kinetic_energy(c, s, integrate(c, q, v, t), v); };
    CHECK((twice_energy(h) - twice_energy(-h)) / (2 * h) == within(v.dot(rate * v), 1e-6 * std::abs(twice_energy(0))));
    const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(m.rows(), m.cols());
    CHECK((m * inverse - one).cwiseAbs().maxCoeff() < 2e-15 * m.cwiseAbs().maxCoeff() * inverse.cwiseAbs().maxCoeff());
  }
}

}  // namespace mass_matrix_large_test
