#include "contact/walkers.hpp"

#include <kte/integrators/prince_dormand87.hpp>
#include <kte/io/model_file.hpp>

#include "catch.hpp"

namespace walkers_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::walkers;

const kte::tolerances<double> tight{.absolute = 1e-12, .relative = 1e-12};

/// The legs in the order stance, swing.
struct step_of_walker {
  double half, stance, swing;
  template <class X>
  explicit step_of_walker(const X& x) {
    const bool first_stands = x[8] == 1;
    REQUIRE(first_stands != (x[12] == 1));
    half = x[first_stands ? 2 : 3], stance = x[first_stands ? 6 : 7], swing = x[first_stands ? 7 : 6];
    CHECK(x[2] + x[3] == within(0.0, 1e-14));
  }
};
template <class Model>
auto walk(const Model& model, const start_of_step& start, double time, const kte::tolerances<double>& accuracy) {
  prince_dormand87 solver(std::cref(model), 0.0, settled(model, 0.0, model.make_x(start.q, start.v)), accuracy);
  auto report = solver.integrate(time, element_events(model));
  REQUIRE(report.reason == stop_reason::end_time);
  return report;
}
template <class Model>
void check_compass(const Model& model) {
  const auto report = walk(model, compass_cycle, 15.0, tight);
  const auto strikes = strikes_of(report);
  REQUIRE(strikes.size() >= 20);
  for (const std::size_t i : {0, 1, 9, 18, 19}) {
    const step_of_walker at(strikes[i].after);
    CHECK(at.half == within(0.27102868049882, 1e-13));
    CHECK(at.stance == within(-1.09238358988360, 2e-13));
    CHECK(at.swing == within(-0.37737394890719, 2e-13));
    CHECK(strikes[i].time == within(static_cast<double>(i + 1) * 0.73434639115872, 1e-12));
  }
  CHECK(report.events[0].what == "'second foot': passes");
  CHECK(report.events[1].what == "'first foot': lifts; 'second foot': impact, sticks");
}

TEST_CASE("a compass walker keeps its cycle for 20 strides") {
  const auto c = chain_of(compass);
  check_compass(manipulator_dynamics_model(c));
  runtime_chain r;
  r << c;
  check_compass(manipulator_dynamics_model(r));
}

TEST_CASE("a compass walker beside its cycle goes back to it", "[long]") {
  const auto c = chain_of(compass);
  const manipulator_dynamics_model model(c);
  auto start = compass_cycle;
  start.v[3] += 0.02;
  const auto strikes = strikes_of(walk(model, start, 30.0, tight));
  const step_of_walker last(strikes.back().after);
  CHECK(last.half == within(0.27102868049882, 1e-12));
  CHECK(last.stance == within(-1.09238358988360, 1e-12));
}

TEST_CASE("Garcia's walker has its published cycle", "[long]") {
  // The angle after a strike and the period, for feet of a mass
  const auto cycle = [](double mass) {
    auto w = garcia;
    w.leg_mass = mass;
    const auto c = chain_of(w);
    const manipulator_dynamics_model model(c);
    // The cycle for feet without mass: its angle, and the rates theta', cos(2 theta) theta'
    const double half = 0.200310900544, rate = -0.199832473005;
    const start_of_step start(half, rate, rate * std::cos(2 * half));
    const auto strikes = strikes_of(walk(model, start, 200.0, tight));
    REQUIRE(strikes.size() > 45);
    const step_of_walker last(strikes.back().after);
    return Eigen::Vector2d(last.half, strikes.back().time - strikes[strikes.size() - 2].time);
  };
  // Feet of 1e-9 have a Delassus matrix of condition 1e9: the cubic through four larger masses
  const double mass = 1e-4;
  const std::array all{cycle(mass), cycle(2 * mass), cycle(3 * mass), cycle(4 * mass)};
  const auto at = [&](double m) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i < 4; ++i) {
      double weight = 1;
      for (std::size_t j = 0; j < 4; ++j)
        if (j != i)
          weight *= (m / mass - static_cast<double>(j + 1)) / (static_cast<double>(i) - static_cast<double>(j));
      sum += weight * all[i];
    }
    return sum;
  };
  CHECK(at(0)[0] == within(0.200310900544, 1e-11));
  CHECK(at(1e-9)[0] == within(0.200310900394, 1e-11));
  // Of Garcia's equations, from the published angle and rate
  CHECK(at(0)[1] == within(3.88246375283, 2e-10));
}

TEST_CASE("gates of contacts work in time stepping", "[long]") {
  const auto c = chain_of(compass);
  const manipulator_dynamics_model model(c);
  const auto x0 = model.make_x(compass_cycle.q, compass_cycle.v);
  prince_dormand87 exact(std::cref(model), 0.0, settled(model, 0.0, x0), tight);
  exact.integrate(2.5, element_events(model));
  double last = 1;
  for (const double h : {1e-3, 1e-4}) {
    moreau_jean solver(std::cref(model), 0.0, x0, h);
    solver.integrate(2.5);
    const double error = (solver.state() - exact.state()).head<4>().cwiseAbs().maxCoeff();
    CHECK(error < 100 * h);
    CHECK(error < last / 3);
    last = error;
  }
  runtime_chain r;
  r << c;
  const manipulator_dynamics_model same(r);
  moreau_jean solver(std::cref(same), 0.0, same.make_x(compass_cycle.q, compass_cycle.v), 1e-4);
  solver.integrate(2.5);
  CHECK((solver.state() - exact.state()).head<4>().cwiseAbs().maxCoeff() == within(last, 1e-9));
}

TEST_CASE("a start inside a surface is refused only if the gate is open") {
  const auto c = chain_of(compass);
  const manipulator_dynamics_model model(c);
  prince_dormand87 before(std::cref(model), 0.0, settled(model, 0.0, model.make_x(compass_cycle.q, compass_cycle.v)),
                          tight);
  before.integrate(0.25, element_events(model));  // the second foot is inside, behind the hip
  const Eigen::Vector4d q = before.state().head<4>(), v = before.state().segment<4>(4);
  REQUIRE(before.state()[12] == -2);
  const auto at_first = model.make_x(q, v);
  const auto x = settled(model, 0.25, at_first);
  CHECK(x[12] == -2);
  CHECK(mode_of(model.state_at(0.25, x)[second_foot]) == contact_mode::open);
  CHECK(model.getJointStates(model.state_at(0.25, x)) == x);
  prince_dormand87 after(std::cref(model), 0.25, at_first, tight);
  const auto report = after.integrate(1.0, element_events(model));
  CHECK(report.events[0].what.find("'second foot': passes") != std::string::npos);
  before.integrate(1.0, element_events(model));
  CHECK((after.state() - before.state()).cwiseAbs().maxCoeff() < 1e-10);
  moreau_jean stepped(std::cref(model), 0.25, at_first, 1e-3);
  stepped.integrate(1.0);
  CHECK(std::abs(stepped.state()[0] - before.state()[0]) < 0.1);
  // In front of the hip
  Eigen::Vector4d forward = q;
  forward[3] = 0.05;
  const auto inside = model.make_x(forward, v);
  CHECK_THROWS_WITH(settled(model, 0.0, inside), Catch::Matchers::Contains("contact 'second foot' is"));
  CHECK_THROWS_WITH(moreau_jean(std::cref(model), 0.0, inside, 1e-3),
                    Catch::Matchers::Contains("contact 'second foot' starts"));
}

TEST_CASE("a chain with gates of contacts is not saved") {
  runtime_chain r;
  r << chain_of(compass);
  CHECK_THROWS_WITH(record_of(r), Catch::Matchers::Contains("contact 'first foot'") &&
                                      Catch::Matchers::Contains("holds a function of its program"));
}

TEST_CASE("gates of runtime chains name frames by text") {
  runtime_chain c;
  c.gravity(vec3<>{0, -9.81, 0}) << base_2D("ground") << free_joint_2D("pose", "ground", "ball")
                                 << inertia_2D("ball", planar_body(1.0, 0.01));
  const auto from = [&](double x) {
    auto whole = c;
    whole << point_contact_2D("foot", "ground", "ball", half_space{}, {.restitution = 0.5}).only_if([](const auto& s) {
      return s.frame_2D("ball").position.x > 0;
    });
    const manipulator_dynamics_model model(whole);
    prince_dormand87 solver(std::cref(model), 0.0, model.make_x(Eigen::Vector3d(x, 1, 0), Eigen::Vector3d(1, 0, 0)),
                            tight);
    return solver.integrate(0.5, element_events(model)).events.front().what;
  };
  CHECK(from(0.0) == "'foot': impact, bounces");
  CHECK(from(-1.0) == "'foot': passes");
}

}  // namespace walkers_test
