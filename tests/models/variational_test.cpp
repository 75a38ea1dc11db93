#include <kte/elements/joint_lugre.hpp>
#include <kte/integrators/runge_kutta4.hpp>
#include <kte/models/runtime_dynamics_model.hpp>
#include <kte/models/variational.hpp>

#include <cmath>

#include "catch.hpp"
#include "data/problems/double_pendulum.hpp"
#include "data/problems/dzhanibekov.hpp"
#include "data/problems/pendulum.hpp"
#include "dynamics/small_chains.hpp"
#include "models/free_motion.hpp"

// Variational integrators, and the order of Kutta's method on the group.

namespace variational_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::free_motion;
using namespace kte::test::small_chains;
using kte::problems::double_pendulum_from_horizontal;
using kte::problems::dzhanibekov;

template <template <class, class> class Method, class Problem>
double error_with(double h) {
  auto solver = start<Method, Problem>(h);
  solver.integrate(1);
  return error_of<Problem>(solver.state(), 0);
}
template <template <class, class> class Method, class Problem>
void check_order(int order, double h) {
  CHECK(std::log2(error_with<Method, Problem>(h) / error_with<Method, Problem>(h / 2)) == within(order, 0.1));
}

template <class Chain, class X>
double energy_of(const Chain& c, const X& x) {
  const joint_vector<double, Chain::nq> q = x.template head<Chain::nq>();
  const joint_vector<double, Chain::dofs> v = x.template tail<Chain::dofs>();
  const auto e = energy(c, q, v);
  return e.kinetic + e.potential;
}

TEST_CASE("variational integrators have their orders, on numbers and on rotations") {
  check_order<variational2, double_pendulum_from_horizontal>(2, 1 / 128.0);
  check_order<variational4, double_pendulum_from_horizontal>(4, 1 / 64.0);
  check_order<variational2, dzhanibekov>(2, 1 / 512.0);
  check_order<variational4, dzhanibekov>(4, 1 / 128.0);
}

TEST_CASE("Kutta's method has its order on rotations") { check_order<runge_kutta4, dzhanibekov>(4, 1 / 128.0); }

TEST_CASE("variational integrators keep momenta to rounding, however long the step") {
  const auto free = floating_with_springs.gravity(zero3{});
  manipulator_dynamics_model model(free);
  random_numbers random(1);
  const random_motion_of<double, std::remove_const_t<decltype(free)>> m(free, random);
  for (const double h : {0.02, 0.01}) {
    variational2 solver(model, 0.0, model.make_x(m.q, m.v), h);
    const auto before = momenta(free, solver.state());
    const double e = energy_of(free, solver.state());
    double worst = 0, energy_change = 0;
    solver.integrate(4, [&](double, const auto& x) {
      worst = test::worse(worst, (momenta(free, x) - before).norm() / before.norm());
      energy_change = test::worse(energy_change, std::abs(energy_of(free, x) - e));
    });
    CHECK(worst < 1e-13);         // 400 steps, each of some 10 roundings of 1.1e-16
    CHECK(energy_change > 1e-6);  // of order h^2, unlike momenta
  }
}

TEST_CASE("variational integrators let energy oscillate and not drift") {
  auto solver = start<variational2, problems::pendulum>(0.02);
  const double e = energy_of(problems::pendulum::model, solver.state());
  double halves[]{0, 0};
  solver.integrate(1000, [&](double t, const auto& x) {
    double& most = halves[t > 500];
    most = test::worse(most, std::abs(energy_of(problems::pendulum::model, x) - e));
  });
  CHECK(halves[0] < 0.02 * 0.02 * 9.81 / 0.5);  // h^2 w^2 of the energy of 4.9 J, by a factor below 1/5
  CHECK(halves[1] <= halves[0] * (1 + 1e-3));
}

TEST_CASE("the dense output of variational integrators meets the ends and is of order 3") {
  const auto between = [](double h) {
    auto solver = start<variational4, dzhanibekov>(h);
    auto exact = start<variational4, dzhanibekov>(h / 8);
    double most = 0;
    solver.integrate(1, every(h / 4), [&](double t, const auto& x) {
      if (t > 0) exact.integrate(t);
      most = test::worse(most, (x - exact.state()).norm());
    });
    return most;
  };
  CHECK(std::log2(between(1 / 64.0) / between(1 / 128.0)) == within(3, 0.35));  // rates; positions are of order 4
}

TEST_CASE("variational integrators go backward, restart, and say where a step is too long") {
  auto solver = start<variational4, double_pendulum_from_horizontal>(0.01);
  const auto x0 = solver.state();
  solver.integrate(1);
  solver.integrate(0);
  // 200 steps of five parts, some 10 roundings of numbers up to 5 each, that grow 100-fold
  CHECK((solver.state() - x0).norm() < 1e-9);
  solver.restart(3, x0);
  solver.integrate(4);
  CHECK(error_of<double_pendulum_from_horizontal>(solver.state(), 0) < 1e-5);
  auto long_steps = start<variational2, dzhanibekov>(0.5);
  CHECK_THROWS_WITH(long_steps.integrate(10), contains_text("a step of 0.5 does not converge: it is too long"));
}

TEST_CASE("variational integrators of runtime chains step as those of static ones") {
  // A free body and its arm; and what of internal states is refused, by name.
  const auto free = floating_with_springs.gravity(zero3{});
  const manipulator_dynamics_model model(free);
  const manipulator_dynamics_model runtime(models::element_by_element(free));
  random_numbers random(2);
  const random_motion_of<double, std::remove_const_t<decltype(free)>> m(free, random);
  variational4 solver(std::cref(model), 0.0, model.make_x(m.q, m.v), 0.01);
  variational4 same(std::cref(runtime), 0.0, runtime.make_x(m.q, m.v), 0.01);
  solver.integrate(0.1), same.integrate(0.1);
  CHECK((same.state() - solver.state()).norm() < 1e-12 * solver.state().norm());
  CHECK((same.interpolate(0.095) - solver.interpolate(0.095)).norm() < 1e-12 * solver.state().norm());
  runtime_chain rubs;
  rubs << inertia_gen("x", 1.0)
       << joint_lugre_gen("x", "bristles",
                          {.sigma0 = 1, .sigma1 = 0, .sigma2 = 0, .coulomb = 1, .stiction = 1, .stribeck_velocity = 1});
  const manipulator_dynamics_model kept(rubs);
  CHECK_THROWS_MATCHES(variational2(std::cref(kept), 0.0, kept.make_x(std::array{0.0}, std::array{0.0}), 0.1),
                       bad_argument, says("do not support internal states of elements, as that of joint_lugre_gen"));
}

// From v of the part before, by M alone, a step took 42 evaluations; from those of the last steps and with a matrix
// that is learned 18. Where the guess is far off, as in long steps, the first way is gone.
TEST_CASE("the iteration of variational integrators starts from the last steps and learns") {
  auto short_steps = start<variational4, dzhanibekov>(1 / 128.0);
  short_steps.integrate(2);
  CHECK(short_steps.statistics().evaluations < 22 * short_steps.statistics().steps);
  auto long_steps = start<variational4, double_pendulum_from_horizontal>(0.1);
  long_steps.integrate(10);
  CHECK(long_steps.statistics().steps == 100);
}

TEST_CASE("variational integrators name the coordinate that moves no mass, and when") {
  const auto check = [](const auto& c, const std::string& name) {
    const manipulator_dynamics_model model(c);
    const std::array two{0.1, 0.2};
    const auto x0 = model.make_x(two, two);
    const auto try_with = [&](auto& solver) {
      try {
        solver.integrate(3);
        CHECK(false);
      } catch (const integration_failure& e) {
        CHECK(e.cause == "the mass matrix is singular: '" + name + "' moves no mass independently of the others");
        CHECK_THAT(e.what(), contains_text("kte: integration stopped at t = 2: ") && contains_text(e.cause));
        CHECK(e.time == 2);
      }
      CHECK(solver.state() == x0);
    };
    variational2 second(std::cref(model), 2.0, x0, 0.01);
    variational4 fourth(std::cref(model), 2.0, x0, 0.01);
    try_with(second), try_with(fourth);
  };
  // On the axis of its joint; and not at all.
  check(chain(revolute_joint_3D(q1, ground, body), inertia_3D(body, brick), revolute_joint_3D(q2, body, hand, axis::x),
              inertia_3D(hand, point_mass(1.0, along_x(0.5)))),
        "q2");
  check(chain(revolute_joint_3D(q1, ground, body), prismatic_joint_3D(q2, ground, hand, axis::x),
              inertia_3D(hand, brick)),
        "q1");
}

}  // namespace variational_test
