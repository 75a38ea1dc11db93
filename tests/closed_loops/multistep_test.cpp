#include <kte/integrators/adams.hpp>
#include <kte/integrators/adams_BM.hpp>
#include <kte/integrators/bdf.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/solution.hpp>
#include <kte/models/controlled.hpp>
#include <kte/models/vector_form.hpp>

#include "catch.hpp"
#include "closed_loops/linkages.hpp"
#include "closed_loops/static_four_bar.hpp"

// Methods with a history on closed loops: kte::vector_form projects the ends of steps, and states between.

namespace multistep_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::loops;

using model = manipulator_dynamics_model<runtime_chain>;

struct run {
  vector x;
  double open = 0;  ///< at the ends of steps and between
  long long evaluations = 0;
};
template <template <class, class> class Method>
run simulated(const runtime_chain& c, const vector& q, const vector& v, double t_end, double tolerance) {
  const model m(c);
  auto s = c.make_state();
  using form = vector_form<std::reference_wrapper<const model>>;
  Method<form, vector> solver(form(std::cref(m)), 0.0, m.make_x(q, v), {.absolute = tolerance, .relative = tolerance});
  run r;
  const auto look = [&](double, const vector& x) { r.open = (std::max)(r.open, open_by(c, s, m, x)); };
  solver.integrate(t_end / 2, look);
  solver.integrate(t_end, every(t_end / 40), look);
  r.x = solver.state(), r.evaluations = solver.statistics().evaluations;
  return r;
}
/// `check(run, tolerance)` for adams and bdf.
template <class Check>
void with_both(const runtime_chain& c, const vector& q, const vector& v, double t_end,
               std::initializer_list<double> tolerances, const Check& check) {
  for (const double tolerance : tolerances) {
    INFO("tolerance " << tolerance);
    check(simulated<adams>(c, q, v, t_end, tolerance), tolerance);
    check(simulated<bdf>(c, q, v, t_end, tolerance), tolerance);
  }
}
double pendulum_off(const vector& x) { return std::hypot(x[0] - 0.986291751131875, x[1] + 0.165010853125541); }

TEST_CASE("adams and bdf: a pendulum in Cartesian coordinates (A01)") {
  with_both(pendulum(), numbers({-1, 0}), numbers({0, 0}), 10, {1e-6, 1e-9, 1e-12}, [](const run& r, double tolerance) {
    CHECK(std::hypot(r.x[0] + 0.275087462576117, r.x[1] + 0.961419205099125) < 1e3 * tolerance);
    CHECK(r.open < 5e-15);
  });
}

TEST_CASE("adams and bdf: a slider-crank of equal bars passes its dead points") {
  const double q = slider_crank_angle(0.3, 8, 5);
  with_both(slider_crank_of_equal_bars(), numbers({0.3, -0.6}), numbers({8, -16}), 5, {1e-6, 1e-9, 1e-11},
            [q](const run& r, double tolerance) {
              CHECK(std::abs(r.x[0] - q) < 3e3 * tolerance);
              CHECK(std::abs(r.x[1] + 2 * r.x[0]) < 1e-12);
              CHECK(r.open < 2e-13);
            });
}

TEST_CASE("adams and bdf: four-bars stay on their branch through singular configurations (A02)") {
  for (const int n : {1, 2}) {
    const double phi = four_bar_angle(n, 0, 1, 10);
    with_both(four_bars(n), four_bar_q(n, 0), four_bar_v(n, 1), 10, {1e-6, 1e-9}, [&](const run& r, double tolerance) {
      CHECK(std::abs(pi / 2 - r.x[0] - phi) < 1e4 * tolerance);
      for (int i = 0; i < n; ++i) CHECK(std::abs(r.x[i] + r.x[n + 1 + i]) < 1e-12);
      CHECK(r.open < 2e-13);
    });
  }
}

TEST_CASE("adams and bdf: Andrews' squeezer") {
  with_both(andrews(), andrews_start(), vector::Zero(7), 0.03, {1e-6, 1e-9}, [](const run& r, double tolerance) {
    CHECK(r.x[0] == within(15.8107711951537070971, 2e3 * tolerance));
    CHECK(r.open < 5e-14);
    CHECK(r.evaluations < (tolerance < 1e-8 ? 2500 : 900));
  });
}

TEST_CASE("adams and bdf: closed loops with rotations keep their momentum and unit quaternions") {
  const rigid_body<> body{1.5, vec3<>{0.1, 0.2, -0.1}, sym3<>{0.3, 0.01, 0, 0.4, 0.02, 0.5}};
  runtime_chain c;
  c << free_joint_3D("float", "world", "hull") << inertia_3D("hull", body);
  for (const std::string x : {"l", "r"})
    c << spherical_joint_3D(x + "1", "hull", x + "a").at(vec3<>{x == "l" ? 0.5 : -0.5, 0, 0})
      << inertia_3D(x + "a", body) << rigid_link_3D(x + "a", x + "b", vec3<>{x == "l" ? -0.5 : 0.5, 0.6, 0});
  c << coincident_points_3D("joined", "lb", "rb");
  auto s = c.make_state();
  const vector q = neutral_configuration(c), v = consistent_velocities(c, s, q, vector::LinSpaced(c.dofs(), -1, 1.5));
  const model m(c);
  prince_dormand87 fine(std::cref(m), 0.0, m.make_x(q, v), {.absolute = 1e-13, .relative = 1e-13});
  fine.integrate(2);
  with_both(c, q, v, 2, {1e-6, 1e-9}, [&](const run& r, double tolerance) {
    CHECK((r.x - fine.state()).cwiseAbs().maxCoeff() < 1e3 * tolerance);
    CHECK(r.x.segment<4>(3).norm() == within(1, 1e-14));
    CHECK(r.open < 1e-13);
  });
}

TEST_CASE("fixed-step methods with a history keep their order on loops") {
  const auto c = pendulum();
  const model m(c);
  const vector x0 = m.make_x(numbers({-1, 0}), numbers({0, 0}));
  auto s = c.make_state();
  const vector_form f(std::cref(m));
  const auto order = [&](const auto& make) {
    double off[2];
    for (int k = 0; k < 2; ++k) {
      auto solver = make(5e-3 / (k + 1));
      solver.integrate(1.0, every(0.0123), [&](double, const vector& x) { CHECK(open_by(c, s, m, x) < 5e-15); });
      off[k] = pendulum_off(solver.state());
    }
    return std::log2(off[0] / off[1]);
  };
  CHECK(order([&](double h) { return adams_BM3(f, 0.0, x0, h); }) > 2.7);
  CHECK(order([&](double h) { return adams_BM5(f, 0.0, x0, h); }) > 4.5);
}

TEST_CASE("histories continue from one call to the next, dense output and events are on the loops") {
  const auto c = pendulum();
  const model m(c);
  auto s = c.make_state();
  const vector x0 = m.make_x(numbers({-1, 0}), numbers({0, 0}));
  const tolerances<double> to{.absolute = 1e-9, .relative = 1e-9};
  const auto check = [&](auto solver) {
    solution all(solver);
    double lowest = 0;
    const auto bottom = event([](double, const vector& x) { return x[0]; }).reset([&](double t, vector& x) {
      CHECK(open_by(c, s, m, x) < 5e-15);
      lowest = t;
    });
    solver.integrate(1.0, events(bottom), all);
    CHECK(lowest == within(0.5920, 1e-3));  // a quarter of the period of a pendulum released level
    for (double t = 0.0; t < 1; t += 0.0173) CHECK(open_by(c, s, m, all(t)) < 5e-15);
    CHECK(pendulum_off(solver.state()) < 1e-6);
    const auto before = solver.statistics().evaluations;
    const int order = solver.order();
    solver.integrate(1.0 + 1e-3);
    CHECK(solver.order() >= order - 1);  // not from order 1 again
    CHECK(solver.statistics().evaluations - before < 20);
    solver.integrate(0.0);  // backward
    CHECK((solver.state() - x0).cwiseAbs().maxCoeff() < 1e-5);
  };
  check(adams(vector_form(std::cref(m)), 0.0, x0, to));
  check(bdf(vector_form(std::cref(m)), 0.0, x0, to));
}

TEST_CASE("static chains and control laws with adams and bdf on loops") {
  using namespace with_keys;
  const auto q = assemble(four_bar, guess, held(crank));
  const auto v = consistent_velocities(four_bar, q, Eigen::Vector3d(2, 0, 0));
  const manipulator_dynamics_model m(four_bar);
  const auto x0 = m.make_x(q, v);
  const tolerances<double> to{.absolute = 1e-9, .relative = 1e-9};
  prince_dormand87 fine(std::cref(m), 0.0, x0, {.absolute = 1e-12, .relative = 1e-12});
  fine.integrate(2);
  const auto check = [&](auto solver) {
    solver.integrate(2);
    CHECK((solver.state() - fine.state()).cwiseAbs().maxCoeff() < 1e-6);
    CHECK(kte::loops(four_bar, solver.state().template head<3>().eval()).gap < 1e-14);
  };
  check(adams(vector_form(std::cref(m)), 0.0, x0, to));
  check(bdf(vector_form(std::cref(m)), 0.0, x0, to));
  check(dormand_prince45(vector_form(std::cref(m)), 0.0, x0, to));  // one-step methods too

  runtime_chain driven = pendulum();
  driven << driving_actuator_gen("x", "push");
  const model plant(driven);
  controlled law(plant, [](double, const vector& x) { return std::array{-3 * x[0] - x[2]}; });
  const vector start = law.make_x(numbers({-1, 0}), numbers({0, 0}));
  prince_dormand87 reference(std::ref(law), 0.0, start, {.absolute = 1e-12, .relative = 1e-12});
  adams history(vector_form(std::ref(law)), 0.0, start, to);
  reference.integrate(2), history.integrate(2);
  CHECK((reference.state() - history.state()).cwiseAbs().maxCoeff() < 1e-6);
  CHECK(std::abs(history.state().head(2).norm() - 1) < 1e-15);
}

TEST_CASE("multistep methods refuse states off the loops, with the closure") {
  const auto c = four_bars(1);
  const model m(c);
  vector x = m.make_x(four_bar_q(1, 0.4), four_bar_v(1, 1));
  x[2] += 1e-3;
  adams solver(vector_form(std::cref(m)), 0.0, x);
  CHECK_THROWS_WITH(solver.integrate(1), contains_text("the state is off the loops: 'pin0' is open by"));
  bdf other(vector_form(std::cref(m)), 0.0, x);
  CHECK_THROWS_WITH(other.integrate(1), contains_text("the state is off the loops: 'pin0' is open by"));
}

}  // namespace multistep_test
