#include <kte/contacts.hpp>
#include <kte/integrators/prince_dormand87.hpp>
#include <kte/kte.hpp>
#include <kte/models/element_events.hpp>
#include <kte/models/runtime_dynamics_model.hpp>

#include "catch.hpp"

namespace far_contacts_test {

using namespace kte;
using namespace kte::test;

// Far from the base, the gap of a closed contact has the rounding errors of positions.
TEST_CASE("a block slides down a slope far from the base") {
  const double sine = std::sin(0.3), cosine = std::cos(0.3), friction = 0.1;
  for (const double distance : {0.0, 1e5, 1e6}) {
    INFO(distance);
    runtime_chain c;
    c.gravity(along_y(-9.81)) << rigid_link_2D("base", "slope", vec2<>{0, 0}, rotation_by(-0.3))
                              << prismatic_joint_2D("x", "base", "a", axis::x)
                              << prismatic_joint_2D("y", "a", "block", axis::y)
                              << inertia_2D("block", planar_body(1.0, 0.1))
                              << point_contact_2D("touch", "slope", "block", half_space{}, {.friction = friction});
    manipulator_dynamics_model m(c);
    const Eigen::Vector2d down(cosine, -sine);
    const Eigen::VectorXd q = distance * down, v = down;
    prince_dormand87 solver(std::cref(m), 0.0, settled(m, 0.0, m.make_x(q, v)), {.absolute = 1e-9, .relative = 1e-12});
    solver.integrate(1.0, element_events(m));
    const double slid = (solver.state().head(2) - q).dot(down);
    CHECK(slid == within(1 + 9.81 * (sine - friction * cosine) / 2, 1e-9 + 1e-15 * distance));
  }
}

}  // namespace far_contacts_test
