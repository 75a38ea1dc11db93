#include <kte/contacts.hpp>
#include <kte/elements/rigid_contact.hpp>
#include <kte/simulation.hpp>
#include <kte/static.hpp>

#include "catch.hpp"
#include "closed_loops/mechanisms.hpp"

namespace resting_bodies_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::loops;

constexpr double g = 9.81;
using model_type = manipulator_dynamics_model<runtime_chain>;

/// A block of 1 kg on the ground, pushed along x and lifted by signals.
runtime_chain block() {
  runtime_chain c;
  c.gravity(vec3<>{0, -g, 0}) << base_2D("ground") << prismatic_joint_2D("x", "ground", "slide", axis::x)
                              << prismatic_joint_2D("y", "slide", "carried", axis::y)
                              << revolute_joint_2D("angle", "carried", "block")
                              << inertia_2D("block", planar_body(1.0, 0.01))
                              << box_contact_2D("block", "ground", "block", half_space{}, vec2{0.2, 0.1},
                                                {.friction = 0.5})
                              << driving_actuator_gen("x", "push") << driving_actuator_gen("y", "lift");
  return c;
}

TEST_CASE("inputs that change between two integrations move a block that rests") {
  model_type model(block());
  dormand_prince45 solver(std::cref(model), 0.0,
                          settled(model, 0.0, model.make_x(numbers({0, 0.1, 0}), numbers({0, 0, 0}))),
                          {.absolute = 1e-11, .relative = 1e-11});
  const auto go = [&](double end, double push, double lift) {
    model.setInput(numbers({push, lift}));
    return solver.integrate(end, element_events(model));
  };
  CHECK(go(0.5, 0, 0).count == 0);
  CHECK(go(1.0, 4, 0).count == 0);  // friction holds
  CHECK(solver.state()[0] == within(0, 1e-14));
  CHECK(go(1.5, 6, 0).events[0].what == "'block/corner 3': slides; 'block/corner 4': slides");
  const double a = 6 - 0.5 * g;
  CHECK(solver.state()[0] == within(a / 8, 1e-13));
  CHECK(go(2.0, 0, 15).events[0].what == "'block/corner 3': lifts; 'block/corner 4': lifts");
  CHECK(solver.state()[0] == within(a / 8 + a / 4, 1e-13));
  CHECK(solver.state()[1] == within(0.1 + (15 - g) / 8, 1e-13));
}

TEST_CASE("methods with a fixed step bring a block to rest") {
  const model_type model(block());
  const vector start = settled(model, 0.0, model.make_x(numbers({0, 0.1, 0}), numbers({1, 0, 0})));
  const double way = 1 / (2 * 0.5 * g);
  const auto check = [&](auto solver, double error) {
    solver.integrate(1.0, element_events(model));
    CHECK(solver.state()[0] == within(way, error));
    CHECK(solver.state().segment(3, 3).cwiseAbs().maxCoeff() < 1e-13);
  };
  check(implicit_midpoint(std::cref(model), 0.0, start, 1e-3), 0.5 * g * 1e-6 / 8);  // dense output is linear
  check(runge_kutta4(std::cref(model), 0.0, start, 1e-3), 1e-13);
}

}  // namespace resting_bodies_test
