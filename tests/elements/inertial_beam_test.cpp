#include <kte/dynamics.hpp>
#include <kte/elements/flexible_beam.hpp>
#include <kte/elements/inertial_beam.hpp>

#include <Eigen/Eigenvalues>

#include <cmath>

#include "catch.hpp"
#include "chain/registered.hpp"
#include "elements/laws.hpp"

using namespace kte;

TEST_CASE("a beam with a consistent mass moves as a rigid bar between stiff ends") {
  // a bar of 3 kg and 0.8 m on a hinge: m L^2/3, half of its weight on the tip
  kte_map_chain c;
  c << revolute_joint_3D("q", "ground", "root", axis::y) << rigid_link_3D("root", "tip", along_x(0.8))
    << inertial_beam_3D("root", "tip", 3.0);
  c.gravity(along_z(-9.81));
  auto s = c.make_state();
  const Eigen::VectorXd q = Eigen::VectorXd::Constant(1, 0.3), v = Eigen::VectorXd::Constant(1, 2.0),
                        none = Eigen::VectorXd::Zero(1);
  CHECK(mass_matrix(c, s, q)(0, 0) == within(3 * 0.64 / 3, 1e-15));
  CHECK(inverse_dynamics(c, s, q, v, none)[0] == within(-3 * 9.81 * 0.4 * std::cos(0.3), 1e-14));
  CHECK(forward_dynamics(c, s, q, v, none)[0] == within(3 * 9.81 * 0.4 * std::cos(0.3) / 0.64, 1e-13));
  const auto e = energy(c, s, q, v);
  CHECK(e.kinetic == within(0.5 * 0.64 * 4, 1e-15));
  CHECK(e.potential == within(-3 * 9.81 * 0.4 * std::sin(0.3), 1e-14));
  CHECK_THROWS_AS(centre_of_mass(c, s, q), bad_argument);
}

TEST_CASE("the momentum of a beam is that of its mass") {
  // ends of a free bar accelerate alike: the forces on them are m a in all
  auto x = test::trial_of<double>(inertial_beam_3D("a", "b", 2.0, sym3{0.2, 0.01, 0.02, 0.3, -0.03, 0.25}), 5);
  auto &a = x.at<0>(), &b = x.at<1>();
  b.acceleration = transpose(b.rotation) * (a.rotation * a.acceleration);
  x.doForce();
  const vec3<> sum = a.rotation * a.force + b.rotation * b.force, needed = -2.0 * (a.rotation * a.acceleration);
  CHECK(test::near(sum, needed, 1e-14));
}

namespace {
/// Angular frequencies of a cantilever of n beams in the plane, lowest first: length 1, EI = 1, EA = 1e4, mass 1.
std::vector<double> frequencies(int n) {
  kte_map_chain c;
  const double l = 1.0 / n;
  std::string before = "wall";
  c << base_2D("wall");
  for (int i = 1; i <= n; ++i) {
    const std::string node = "node" + std::to_string(i);
    c << free_joint_2D(node + ".pose", "wall", node)
      << flexible_beam_2D(before, node, l, planar_beam_section{.EA = 1e4, .EI = 1.0})
      << inertial_beam_2D(before, node, l, 1e-3 * l * l * l);
    before = node;
  }
  auto s = c.make_state();
  Eigen::VectorXd q = Eigen::VectorXd::Zero(c.nq());
  for (int i = 0; i < n; ++i) q[3 * i] = l * (i + 1);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(c.dofs());
  const Eigen::MatrixXd stiffness = inverse_dynamics_derivatives(c, s, q, none, none).by_q, m = mass_matrix(c, s, q);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(stiffness, m);
  std::vector<double> w;
  for (const double x : modes.eigenvalues()) w.push_back(std::sqrt(x));
  return w;
}
}  // namespace

TEST_CASE("frequencies of a cantilever go to those of Euler and Bernoulli") {
  // cos(x) cosh(x) = -1: the squares of its roots
  const double first = 1.8751040687119611 * 1.8751040687119611, second = 4.6940911329741746 * 4.6940911329741746;
  const auto w8 = frequencies(8), w16 = frequencies(16);
  const double e8 = w8[0] / first - 1, e16 = w16[0] / first - 1;
  CHECK(std::abs(e16) < 2e-3);
  CHECK(e8 / e16 == within(4, 0.2));  // of second order
  CHECK(std::abs(w16[1] / second - 1) < 1e-2);
  CHECK((w8[1] / second - 1) / (w16[1] / second - 1) == within(4, 0.3));
}
