#include <kte/adapters/odeint.hpp>
#include <kte/integrators/dormand_prince45.hpp>

#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/integrate/integrate_const.hpp>
#include <boost/numeric/odeint/stepper/adams_bashforth_moulton.hpp>
#include <boost/numeric/odeint/stepper/bulirsch_stoer.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include "catch.hpp"

namespace odeint_test {

using namespace kte;
namespace od = boost::numeric::odeint;

/// 0.5 m, 9.81 m/s^2
struct pendulum {
  template <class X>
  X operator()(double, const X& x) const {
    return Eigen::Vector2d(x[1], -9.81 / 0.5 * std::sin(x[0]));
  }
};
const Eigen::Vector2d horizontal(std::acos(0.0), 0);
constexpr double theta10 = 1.55012648485020447245734549;  // by elliptic functions

template <class X>
X integrated(auto stepper, double t_end, double h) {
  X x = horizontal;
  od::integrate_adaptive(stepper, odeint_system(pendulum()), x, 0.0, t_end, h);
  return x;
}

struct on_loops : pendulum {
  static constexpr bool has_loops() { return true; }
};

TEST_CASE("odeint refuses systems with closed loops") {
  CHECK_THROWS_WITH(
      odeint_system(on_loops{}),
      "kte: steppers of odeint do not keep loops closed: use a one-step method of kte, or kte::vector_form");
}

TEST_CASE("odeint: one step of Dormand and Prince is the same") {
  dormand_prince45 solver(pendulum(), 0.0, horizontal, {.absolute = 1e30, .relative = 1e30});
  solver.integrate(100);  // the next step proposed is a long one, so that each of the following is one step
  od::runge_kutta_dopri5<Eigen::Vector2d> stepper;
  Eigen::Vector2d x(1, 2);
  solver.restart(0, x, keep_step);
  const auto before = solver.statistics().steps;
  for (int i = 0; i < 10; ++i) {
    const double t = i / 16.0, h = 1 / 16.0;
    stepper.do_step(odeint_system(pendulum()), x, t, h);
    solver.integrate(t + h);
    CHECK((solver.state() - x).norm() < 2e-14);  // a few ulp of numbers up to 8, a step
  }
  CHECK(solver.statistics().steps == before + 10);
}

TEST_CASE("odeint: controlled and dense steppers, states of fixed and dynamic size") {
  const auto dopri5 = []<class X>(const X&) {
    return integrated<X>(od::make_controlled(1e-10, 1e-10, od::runge_kutta_dopri5<X>()), 10, 0.01);
  };
  const auto dense_dopri5 = []<class X>(const X&) {
    return integrated<X>(od::make_dense_output(1e-10, 1e-10, od::runge_kutta_dopri5<X>()), 10, 0.01);
  };
  const auto fehlberg78 = []<class X>(const X&) {
    return integrated<X>(od::make_controlled(1e-10, 1e-10, od::runge_kutta_fehlberg78<X>()), 10, 0.01);
  };
  const auto bulirsch_stoer = []<class X>(const X&) {
    return integrated<X>(od::bulirsch_stoer<X>(1e-10, 1e-10), 10, 0.01);
  };
  const auto adams = []<class X>(const X&) { return integrated<X>(od::adams_bashforth_moulton<8, X>(), 10, 1e-3); };
  const auto check = [](auto run) {
    CHECK(run(Eigen::Vector2d())[0] == within(theta10, 1e-7));
    CHECK(run(Eigen::VectorXd())[0] == within(theta10, 1e-7));
  };
  SECTION("Dormand-Prince") { check(dopri5); }
  SECTION("Dormand-Prince, dense") { check(dense_dopri5); }
  SECTION("Fehlberg") { check(fehlberg78); }
  SECTION("Bulirsch-Stoer") { check(bulirsch_stoer); }
  SECTION("Adams") { check(adams); }
}

TEST_CASE("odeint: samples agree with those of kte") {
  dormand_prince45 solver(pendulum(), 0.0, horizontal, {.absolute = 1e-10, .relative = 1e-10});
  std::vector<Eigen::Vector2d> ours, theirs;
  solver.integrate(2, every(0.125), [&](double, const Eigen::Vector2d& x) { ours.push_back(x); });
  Eigen::Vector2d x = horizontal;
  const auto stepper = od::make_dense_output(1e-10, 1e-10, od::runge_kutta_dopri5<Eigen::Vector2d>());
  od::integrate_const(stepper, odeint_system(pendulum()), x, 0.0, 2.0, 0.125,
                      [&](const Eigen::Vector2d& y, double) { theirs.push_back(y); });
  REQUIRE(ours.size() == theirs.size());
  for (std::size_t i = 0; i < ours.size(); ++i) CHECK((ours[i] - theirs[i]).norm() < 1e-7);
}

TEST_CASE("odeint: what has a name is referred to, what has none is kept") {
  struct counting : pendulum {
    int calls = 0;
    Eigen::Vector2d operator()(double t, const Eigen::Vector2d& x) { return ++calls, pendulum::operator()(t, x); }
  } f;
  Eigen::Vector2d x = horizontal;
  od::runge_kutta_dopri5<Eigen::Vector2d> stepper;
  stepper.do_step(odeint_system(f), x, 0.0, 0.1);
  CHECK(f.calls == 7);  // odeint evaluates the first stage of the first step, and that of the next
  auto kept = odeint_system(counting());
  stepper.do_step(kept, x, 0.1, 0.1);
  CHECK(f.calls == 7);
}

}  // namespace odeint_test
