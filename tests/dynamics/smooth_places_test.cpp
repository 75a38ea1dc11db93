#include <kte/dynamics/derivatives.hpp>
#include <kte/runtime_chain.hpp>
#include <kte/statics.hpp>

#include "catch.hpp"

/// Forces at ordinary places where their formulas have a corner or divide by zero: coinciding points, no turn, no
/// speed.
namespace smooth_places_test {

using namespace kte;

/// A mass of 1 kg on three slides, without gravity, whose frame "p" is at the base "o".
runtime_chain on_slides() {
  runtime_chain c;
  c << base_3D("o") << prismatic_joint_3D("x", "o", "a", axis::x) << prismatic_joint_3D("y", "a", "b", axis::y)
    << prismatic_joint_3D("z", "b", "p", axis::z) << inertia_3D("p", rigid_body<>{1, {}, {1, 0, 0, 1, 0, 1}});
  c.gravity({0, 0, 0});
  return c;
}
/// A body of 1 kg m^2 on a spherical joint.
runtime_chain on_ball() {
  runtime_chain c;
  c << base_3D("o") << spherical_joint_3D("r", "o", "p") << inertia_3D("p", rigid_body<>{1, {}, {1, 0, 0, 1, 0, 1}});
  c.gravity({0, 0, 0});
  return c;
}
struct slopes {
  Eigen::MatrixXd by_position, by_rate;
};
template <class Element>
slopes at_rest(runtime_chain c, const Element& e) {
  c << e;
  auto s = c.make_state();
  const auto zero = Eigen::VectorXd::Zero(c.dofs()).eval();
  const auto d = inverse_dynamics_derivatives(c, s, neutral_configuration(c), zero, zero);
  return {d.by_q, d.by_v};
}
const Eigen::Matrix3d unit = Eigen::Matrix3d::Identity(), none = Eigen::Matrix3d::Zero();

TEST_CASE("springs of rest length 0 are smooth where their ends coincide") {
  const double k = 100;
  CHECK(at_rest(on_slides(), spring_3D("o", "p", 0.0, k)).by_position == k * unit);
  CHECK(at_rest(on_slides(), spring_3D("o", "p", zero, k)).by_position == k * unit);
  CHECK(at_rest(on_slides(), spring_3D("o", "p", 0.0, k, 3.0)).by_position == k * unit);
  CHECK(at_rest(on_slides(), law_spring_3D("o", "p", [](const auto& x) { return 100.0 * x + 7.0 * x * x; }))
            .by_position == k * unit);
  const auto table =
      at_rest(on_slides(), table_spring_3D("o", "p", std::vector{0.0, 0.1, 0.2}, std::vector{0.0, 10.0, 20.0}));
  CHECK((table.by_position - k * unit).norm() <= 1e-13);
  // with another rest length the direction jumps: there is no slope
  CHECK(at_rest(on_slides(), spring_3D("o", "p", 0.5, k)).by_position.allFinite());

  auto c = on_slides();
  c << spring_3D("o", "p", 0.0, k);
  auto s = c.make_state();
  const auto modes = natural_modes(c, s, Eigen::VectorXd::Zero(3).eval());
  for (int i = 0; i < 3; ++i) CHECK(modes.frequency[i] == within(10, 1e-13));
  CHECK(static_equilibrium(c, s, Eigen::VectorXd::Constant(3, 0.3).eval()).q.norm() <= 1e-12);

  runtime_chain plane;
  plane << base_2D("o") << prismatic_joint_2D("x", "o", "a", axis::x) << prismatic_joint_2D("y", "a", "p", axis::y)
        << inertia_2D("p", point_mass(1.0));
  plane.gravity({0, 0, 0});
  CHECK(at_rest(plane, spring_2D("o", "p", 0.0, k)).by_position == k * Eigen::Matrix2d::Identity());
}

TEST_CASE("torsion springs and dampers are smooth without a turn, drag without a speed") {
  CHECK((at_rest(on_ball(), torsion_spring_3D("o", "p", 5.0)).by_position - 5 * unit).norm() <= 1e-14);
  CHECK((at_rest(on_ball(), torsion_spring_3D("o", "p", 5.0, 2.0)).by_position - 5 * unit).norm() <= 1e-14);
  CHECK((at_rest(on_ball(), torsion_damper_3D("o", "p", 5.0)).by_rate - 5 * unit).norm() <= 1e-14);
  CHECK(at_rest(on_slides(), fluid_drag_3D("p", 3.0, 2.0)).by_rate == 2 * unit);
  CHECK(at_rest(on_slides(), fluid_drag_3D("p", 3.0)).by_rate == none);
}

}  // namespace smooth_places_test
