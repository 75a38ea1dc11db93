#include <kte/integrators/bdf.hpp>
#include <kte/integrators/kennedy_carpenter34.hpp>
#include <kte/integrators/rodas.hpp>
#include <kte/integrators/rosenbrock23.hpp>
#include <kte/integrators/tr_bdf2.hpp>
#include <kte/integrators/trapezoidal.hpp>
#include <kte/models/vector_form.hpp>

#include "catch.hpp"
#include "closed_loops/linkages.hpp"

// Methods for stiff systems on closed loops: stages and Jacobians are on the loops.

namespace stiff_methods_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::loops;

using model = manipulator_dynamics_model<runtime_chain>;
using on_model = std::reference_wrapper<const model>;

struct run {
  vector x;
  double open = 0;  ///< at the ends of steps and between
  long long evaluations = 0;
};
/// To t_end by a method for systems F of a model.
template <template <class, class> class Method, class F = on_model>
run simulated(const runtime_chain& c, const vector& q, const vector& v, double t_end, double tolerance) {
  const model m(c);
  auto s = c.make_state();
  Method<F, vector> solver(F(std::cref(m)), 0.0, m.make_x(q, v), {.absolute = tolerance, .relative = tolerance});
  run r;
  const auto look = [&](double, const vector& x) { r.open = (std::max)(r.open, open_by(c, s, m, x)); };
  solver.integrate(t_end / 2, look);
  solver.integrate(t_end, every(t_end / 40), look);
  r.x = solver.state(), r.evaluations = solver.statistics().evaluations;
  return r;
}
/// check(run, tolerance) for the one-step methods; those of order 2 with larger tolerances.
template <class Check>
void with_all(const runtime_chain& c, const vector& q, const vector& v, double t_end, const Check& check) {
  check(simulated<rodas>(c, q, v, t_end, 1e-7), 1e-7);
  check(simulated<kennedy_carpenter34>(c, q, v, t_end, 1e-7), 1e-7);
  check(simulated<rosenbrock23>(c, q, v, t_end, 1e-5), 1e-5);
  check(simulated<tr_bdf2>(c, q, v, t_end, 1e-5), 1e-5);
  check(simulated<trapezoidal>(c, q, v, t_end, 1e-5), 1e-5);
}

TEST_CASE("stiff methods: a pendulum in Cartesian coordinates") {
  with_all(pendulum(), numbers({-1, 0}), numbers({0, 0}), 1, [](const run& r, double tolerance) {
    CHECK(std::hypot(r.x[0] - 0.986291751131875, r.x[1] + 0.165010853125541) < 200 * tolerance);
    CHECK(r.open < 5e-15);
  });
}

TEST_CASE("stiff methods: a four-bar stays on its branch through singular configurations") {
  const double phi = four_bar_angle(1, 0, 1, 4);
  with_all(four_bars(1), four_bar_q(1, 0), four_bar_v(1, 1), 4, [&](const run& r, double tolerance) {
    CHECK(std::abs(pi / 2 - r.x[0] - phi) < 3e3 * tolerance);
    CHECK(std::abs(r.x[0] + r.x[2]) < 1e-12);
    CHECK(r.open < 1e-13);
  });
}

TEST_CASE("stiff methods pass a singular configuration at small tolerances") {
  for (const int n : {1, 2}) {
    const auto c = four_bars(n);
    const auto check = [&](const run& r) {
      CHECK(pi / 2 - r.x[0] == within(four_bar_angle(n, 1.5, 1, 0.1), 1e-12));
      CHECK(r.open < 1e-13);
    };
    check(simulated<kennedy_carpenter34>(c, four_bar_q(n, 1.5), four_bar_v(n, 1), 0.1, 1e-12));
    check(simulated<rodas>(c, four_bar_q(n, 1.5), four_bar_v(n, 1), 0.1, 1e-12));
  }
}

TEST_CASE("stiff methods: Andrews' squeezer") {
  with_all(andrews(), andrews_start(), vector::Zero(7), 0.03, [](const run& r, double tolerance) {
    CHECK(r.x[0] == within(15.8107711951537070971, 2e3 * tolerance));
    CHECK(r.open < 1e-13);
  });
}

TEST_CASE("a stiff governor with loops takes a tenth of the evaluations of an explicit method") {
  const auto c = cut_governor();
  auto s = c.make_state();
  const vector q = cut_governor_q(), v = consistent_velocities(c, s, q, cut_governor_v());
  const auto check = [](const run& r, long long most) {
    CHECK(r.x[1] == within(0.523836475569576, 1e-5));
    CHECK(r.open < 1e-14);
    CHECK(r.evaluations < most);
  };
  const auto by_explicit = simulated<prince_dormand87>(c, q, v, 0.1, 1e-6).evaluations;
  CHECK(by_explicit > 1500);
  check(simulated<bdf, vector_form<on_model>>(c, q, v, 0.1, 1e-6), by_explicit / 8);
  check(simulated<kennedy_carpenter34>(c, q, v, 0.1, 1e-6), by_explicit / 5);
  check(simulated<tr_bdf2>(c, q, v, 0.1, 1e-6), by_explicit / 8);
  check(simulated<trapezoidal>(c, q, v, 0.1, 1e-6), by_explicit / 8);
  check(simulated<rodas>(c, q, v, 0.1, 1e-6), by_explicit / 2);
}

}  // namespace stiff_methods_test
