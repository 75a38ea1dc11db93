#include <kte/contacts.hpp>
#include <kte/elements/rigid_contact.hpp>
#include <kte/simulation.hpp>
#include <kte/static.hpp>

#include "catch.hpp"
#include "closed_loops/mechanisms.hpp"
#include "contact/box_on_slope.hpp"

namespace contact_events_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::loops;

constexpr double g = 9.81;
const kte::tolerances<double> tight{.absolute = 1e-12, .relative = 1e-12};

/// A body of 1 kg in the plane that moves by x, y and an angle: frame "body".
runtime_chain planar(double inertia, const vec3<>& gravity = {0, -g, 0}) {
  runtime_chain c;
  c.gravity(gravity) << base_2D("world") << prismatic_joint_2D("x", "world", "a", axis::x)
                     << prismatic_joint_2D("y", "a", "b", axis::y) << revolute_joint_2D("angle", "b", "body")
                     << inertia_2D("body", planar_body(1.0, inertia));
  return c;
}
/// Adds a point contact at a place of the body.
void add_point(runtime_chain& c, const std::string& name, const vec2<>& place, const contact_law& law) {
  c << rigid_link_2D("body", name + " place", place)
    << point_contact_2D(name, "world", name + " place", half_space{}, law);
}
/// A rod of 2 m on its two tips.
runtime_chain rod(double mu) {
  auto c = planar(1.0 / 3);
  add_point(c, "one", {-1, 0}, {.friction = mu});
  add_point(c, "two", {1, 0}, {.friction = mu});
  return c;
}
/// A ball of radius 0.1 and 1 kg in space.
runtime_chain ball(const contact_law& law) {
  runtime_chain c;
  c.gravity(vec3<>{0, 0, -g}) << base_3D("world") << free_joint_3D("pose", "world", "ball")
                              << inertia_3D("ball",
                                            rigid_body<>{1.0, vec3<>{}, sym3<>{0.004, 0.0, 0.0, 0.004, 0.0, 0.004}})
                              << sphere_contact_3D("floor", "world", "ball", half_space{}, 0.1, law);
  return c;
}
using planar_model = manipulator_dynamics_model<runtime_chain>;

struct outcome {
  vector x;
  event_report<vector> report;
  long long evaluations;
};
/// Integrates from q and v, with consistent modes at the start, to t.
outcome run(const planar_model& model, const vector& q, const vector& v, double t,
            const kte::tolerances<double>& accuracy) {
  prince_dormand87 solver(std::cref(model), 0.0, settled(model, 0.0, model.make_x(q, v)), accuracy);
  auto report = solver.integrate(t, element_events(model));
  return {solver.state(), std::move(report), solver.statistics().evaluations};
}

TEST_CASE("a ball bounces to rest") {
  auto c = planar(0.01);
  add_point(c, "foot", {0, 0}, {.friction = 0.2, .restitution = 0.5});
  const planar_model model(c);
  const auto end = run(model, numbers({0, 1, 0}), numbers({0, 0, 0}), 3.0, tight);
  REQUIRE(end.report.reason == stop_reason::end_time);
  const auto& events = end.report.events;
  REQUIRE(events.size() > 3);
  const double first = std::sqrt(2 / g);
  CHECK(events[0].time == within(first, 1e-15));
  CHECK(events[1].time == within(2 * first, 2e-15));
  CHECK(events[0].name == "foot");
  CHECK(events[0].what == "'foot': impact, bounces");
  // t_0 (1 + e)/(1 - e), which the last impact knows before the bounces have ended
  const std::string rest = events.back().what;
  REQUIRE(rest.find("'foot': impact, rests at ") == 0);
  CHECK(std::stod(rest.substr(25)) == within(1.354570922957193, 1e-13));
  CHECK(events.back().time < 1.354570922957193);
  CHECK(end.x[1] == 0);
  CHECK(end.x[4] == 0);
  CHECK(end.x[6] == 1);  // sticks
}

TEST_CASE("a box slides up a slope, turns or rests") {
  for (const double tolerance : {1e-6, 1e-12}) {
    const planar_model smooth(in_runtime(box_on_slope(0.2))), rough(in_runtime(box_on_slope(0.4)));
    const vector q = numbers({0, 0.05, 0}), v = numbers({2, 0, 0});
    const auto back = run(smooth, q, v, 2.0, {.absolute = tolerance, .relative = tolerance});
    CHECK(back.x[0] == within(-0.86166423136809, 1e-14));
    CHECK(back.report.events[0].what == "'left foot': turns; 'right foot': turns");
    CHECK(back.evaluations < 200);
    const auto rests = run(rough, q, v, 1e4, {.absolute = tolerance, .relative = tolerance});
    CHECK(rests.x[0] == within(0.30085169864298, 5e-15));
    CHECK(rests.report.events[0].what == "'left foot': sticks; 'right foot': sticks");
    CHECK(std::abs(rests.x[3]) < 1e-30);
    const auto s = rough.state_at(1e4, rests.x);
    CHECK(s.contact("left foot").force.y + s.contact("right foot").force.y == within(g * std::cos(0.3), 1e-14));
    CHECK(s.contact("left foot").force.x + s.contact("right foot").force.x == within(g * std::sin(0.3), 1e-14));
  }
}

TEST_CASE("slipping ends where rolling begins") {
  struct wheel {
    double inertia, stop, place;
  };
  for (const auto& w :
       {wheel{0.004, 0.14562399883501, 1.44937485697643}, wheel{0.005, 0.16989466530751, 1.36164911088458}}) {
    auto c = planar(w.inertia);
    c << sphere_contact_2D("rim", "world", "body", half_space{}, 0.1, {.friction = 0.2});
    const planar_model model(c);
    const auto end = run(model, numbers({0, 0.1, 0}), numbers({1, 0, 0}), 2.0, tight);
    REQUIRE(end.report.count == 1);
    CHECK(end.report.events[0].time == within(w.stop, 1e-14));
    CHECK(end.report.events[0].what == "'rim': sticks");
    CHECK(end.x[0] == within(w.place, 2e-14));
    CHECK(end.x[3] + 0.1 * end.x[5] == within(0.0, 6e-16));  // four ulp of 0.6
    CHECK(end.x[1] == within(0.1, 1e-16));
  }
  // Any spin: 2 |u_t|/(7 mu g); the direction of sliding turns in axes of the ball
  const planar_model model(ball({.friction = 0.2}));
  const vector q = numbers({0, 0, 0.1, 1, 0, 0, 0}), v = numbers({1, 0.2, 0, 3, 2, 1});
  const double slip = std::hypot(1 - 0.2, 0.2 + 0.3);
  const auto end = run(model, q, v, 1.0, {.absolute = 1e-10, .relative = 1e-10});
  REQUIRE(end.report.count >= 1);
  // Sliding stops at half the speed v below which it is slow, v/(2 k) too early, k = 7 mu g/2 (slow_sliding.hpp).
  const double slow = 10 * std::sqrt((1e-10 + 0.1 * 1e-10) / 0.1) * 0.1;
  CHECK(end.report.events.back().time == within(2 * slip / (7 * 0.2 * g), 1.01 * slow / (7 * 0.2 * g)));
  CHECK(end.report.events.back().what == "'floor': sticks");
}

TEST_CASE("a rimless wheel goes to its limit cycle") {
  const double l = 1, m = 1, inertia = 0.1, slope = 0.15, half = pi / 8;
  auto c = planar(inertia, {g * std::sin(slope), -g * std::cos(slope), 0});
  for (int i = 0; i < 8; ++i)
    add_point(c, "s" + std::to_string(i), {l * std::sin(i * pi / 4), -l * std::cos(i * pi / 4)}, {.friction = 1.0});
  const planar_model model(c);
  const double rate = -1.5;
  const vector q = numbers({0, l * std::cos(half), -half});
  const vector v = numbers({-rate * l * std::cos(half), rate * l * std::sin(half), rate});
  const auto end = run(model, q, v, 40.0, tight);
  const double about = inertia + m * l * l, eta = (inertia + m * l * l * std::cos(pi / 4)) / about;
  const double after =
      std::sqrt(eta * eta / (1 - eta * eta) * 4 * m * g * l * std::sin(slope) * std::sin(half) / about);
  CHECK(after == within(1.5424373582917368, 1e-15));
  CHECK(-end.report.events.back().after[5] == within(after, 5e-12));
  CHECK(end.report.events.back().what.find("lifts") != std::string::npos);
}

TEST_CASE("a rod falls") {
  const vector at_rest = numbers({0, 0, 0});
  {
    const planar_model model(rod(0));
    const auto end = run(model, numbers({0, std::sin(1.4), 1.4}), at_rest, 0.8, tight);
    const auto& hit = end.report.events.front();
    CHECK(hit.time == within(0.7342896312520408, 1e-13));
    CHECK(hit.before[5] == within(-3.808003778461911, 1e-12));
    CHECK(end.x[1] == within(0.0, 1e-16));
  }
  for (const auto& [mu, angle] : {std::pair{0.2, 0.2708619970981865}, {0.3, 0.4217710658045465}}) {
    const planar_model model(rod(mu));
    const double start = pi / 2 - 1e-3;
    const auto end =
        run(model, numbers({0, std::sin(start), start}), at_rest, 3.0, {.absolute = 1e-14, .relative = 1e-14});
    const auto& slips = end.report.events.front();
    CHECK(slips.what == "'one': slides");
    CHECK(pi / 2 - slips.before[2] == within(angle, 1e-12));
  }
}

TEST_CASE("Painleve's rod has a tangential impact at an event") {
  const planar_model model(rod(2));
  const double s = std::sin(1.0), co = std::cos(1.0);
  const vector q = numbers({0, s, 1.0});
  const auto start = settled(model, 0.0, model.make_x(q, numbers({-1, 0, 0})));
  CHECK(start[3] == within(-0.53105506370518, 1e-14));
  CHECK(start[4] == within(0.34098653505963, 1e-14));
  CHECK(start[5] == within(0.63110323860592, 1e-14));
  // Also at the start of an integration
  prince_dormand87 solver(std::cref(model), 0.0, model.make_x(q, numbers({-1, 0, 0})), tight);
  const auto report = solver.integrate(0.01, element_events(model));
  REQUIRE(report.count == 1);
  CHECK(report.events[0].what == "'one': tangential impact, sticks");
  CHECK(report.events[0].after[5] == start[5]);
  // Two solutions
  prince_dormand87 two(std::cref(model), 0.0, model.make_x(q, numbers({-1 - 5 * s, 5 * co, 5})), tight);
  const auto ambiguous = two.integrate(0.01, element_events(model));
  REQUIRE(ambiguous.count >= 1);
  CHECK(ambiguous.events[0].what.find("ambiguous") != std::string::npos);
}

TEST_CASE("all events of contacts say what happens") {
  const planar_model model([] {
    auto c = planar(0.01);
    add_point(c, "left", {-0.1, -0.05}, {.friction = 0.2});
    add_point(c, "right", {0.1, -0.05}, {.friction = 0.2});
    return c;
  }());
  // both land at once: one event handles both
  const auto end = run(model, numbers({0, 0.15, 0}), numbers({2, 0, 0}), 2.0, {.absolute = 1e-9, .relative = 1e-9});
  REQUIRE(end.report.count == 2);
  CHECK(end.report.events[0].what == "'left': impact, slides; 'right': impact, slides");
  CHECK(end.report.events[1].what == "'left': sticks; 'right': sticks");
}

TEST_CASE("a million steps of rolling have no slip") {
  const planar_model model(ball({.friction = 0.5}));
  const vector q = numbers({0, 0, 0.1, 1, 0, 0, 0}), v = numbers({1, 0, 0, 0, 10, 0.5});
  auto x = settled(model, 0.0, model.make_x(q, v));
  runge_kutta4 solver(std::cref(model), 0.0, x, 1e-3);
  for (int i = 0; i < 1000; ++i) solver.step(1e3);
  const auto s = model.state_at(solver.time(), solver.state());
  CHECK(std::abs(s.contact("floor").slip.x) < 1e-15);
  CHECK(std::abs(s.contact("floor").slip.y) < 1e-15);
  CHECK(std::abs(s.contact("floor").gap) < 1e-16);
}

TEST_CASE("contacts need events") {
  const planar_model model(in_runtime(box_on_slope(0.2)));
  const auto refuses = [&](const vector& x, double t, const char* text) {
    prince_dormand87 solver(std::cref(model), 0.0, x, tight);
    CHECK_THROWS_WITH(solver.integrate(t), Catch::Matchers::Contains(text));
  };
  const auto falling = model.make_x(numbers({0, 0.1, 0}), numbers({0, 0, 0}));
  refuses(falling, 2.0, "inside its surface: kte::element_events(model) finds impacts");
  auto pulled = settled(model, 0.0, model.make_x(numbers({0, 0.05, 0}), numbers({2, 0, 0})));
  pulled[6] = pulled[10] = 1, pulled[3] = 0;
  refuses(pulled, 1.0, "sticks, but its force exceeds friction: integrate with kte::element_events(model)");
  auto moving = pulled;
  moving[3] = 1;
  refuses(moving, 1.0, "is closed, but moves at 1 m/s: kte::settled gives consistent modes");
  const auto inside = model.make_x(numbers({0, 0.04, 0}), numbers({0, 0, 0}));
  CHECK_THROWS_AS(settled(model, 0.0, inside), bad_argument);
  CHECK_THROWS_WITH(settled(model, 0.0, inside), Catch::Matchers::Contains("contact 'left foot' is 0.01"));
  // A box that is lifted leaves
  const planar_model up(in_runtime(box_on_slope(0.2).gravity(vec3<>{0, 1, 0})));
  auto closed = up.make_x(numbers({0, 0.05, 0}), numbers({0, 0, 0}));
  closed[6] = closed[10] = 1;
  prince_dormand87 solver(std::cref(up), 0.0, closed, tight);
  CHECK_THROWS_WITH(solver.integrate(1.0), Catch::Matchers::Contains("pulls with"));
  prince_dormand87 with_events(std::cref(up), 0.0, closed, tight);
  const auto report = with_events.integrate(1.0, element_events(up));
  CHECK(report.events[0].what == "'left foot': lifts; 'right foot': lifts");
  CHECK(with_events.state()[1] == within(0.55, 1e-14));
}

TEST_CASE("numbers that are not finite are refused by name") {
  const auto c = box_on_slope(0.2);
  const auto r = in_runtime(c);
  auto s = make_state(r);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Eigen::Vector3d q(0, 0.05, 0), zero_rates(0, 0, 0);
  const manipulator_dynamics_model of_chain(c);
  const planar_model of_runtime(r);
  for (int k = 0; k < 3; ++k) {
    const auto refuses = [k](const char* what, const auto& f) {
      CHECK_THROWS_MATCHES(f(), bad_argument, says(std::string(what) + "[" + std::to_string(k)));
    };
    Eigen::Vector3d x = zero_rates;
    x[k] = nan;
    refuses("tau", [&] { (void)contact_dynamics(r, s, q, zero_rates, x); });
    refuses("tau", [&] { (void)contact_dynamics(c, q, zero_rates, x); });
    refuses("v", [&] { (void)contact_dynamics(r, s, q, x, zero_rates); });
    refuses("v", [&] { (void)contact_dynamics(c, q, x, zero_rates); });
    refuses("v", [&] { (void)impact(r, s, q, x); });
    refuses("v", [&] { (void)impact(c, q, x); });
    auto at_run_time = of_runtime.make_x(q, zero_rates);
    auto at_compile_time = of_chain.make_x(q, zero_rates);
    at_run_time[3 + k] = at_compile_time[3 + k] = nan;
    const auto place = says("x[" + std::to_string(3 + k) + "] of a state with contacts is not finite");
    CHECK_THROWS_MATCHES(settled(of_runtime, 0.0, at_run_time), bad_argument, place);
    CHECK_THROWS_MATCHES(settled(of_chain, 0.0, at_compile_time), bad_argument, place);
  }
}

TEST_CASE("a static chain has the events of the same runtime chain") {
  const auto c = box_on_slope(0.2);
  const manipulator_dynamics_model model(c);
  const Eigen::Vector3d q(0, 0.15, 0), v(2, 0, 0);
  prince_dormand87 solver(std::cref(model), 0.0, model.make_x(q, v), tight);
  const auto report = solver.integrate(2.0, element_events(model));
  const planar_model of_runtime(in_runtime(c));
  prince_dormand87 same(std::cref(of_runtime), 0.0, of_runtime.make_x(q, v), tight);
  const auto other = same.integrate(2.0, element_events(of_runtime));
  REQUIRE(report.count >= 2);
  REQUIRE(report.count == other.count);
  for (std::size_t i = 0; i < report.events.size(); ++i) {
    CHECK(report.events[i].time == within(other.events[i].time, 1e-14));
    CHECK(report.events[i].what == other.events[i].what);
  }
  CHECK((solver.state() - same.state()).cwiseAbs().maxCoeff() < 1e-13);
  const auto s = model.state_at(2.0, solver.state());
  const auto& t = of_runtime.state_at(2.0, same.state());
  CHECK(s[left_foot].force.y == within(t.contact("left foot").force.y, 1e-12));
  CHECK(mode_of(s[left_foot]) == contact_mode::slides);
  // Under a control law, with its own state
  controlled pushed(
      model, [](double, const auto&, const auto&) { return std::array<double, 0>{}; },
      [](double, const auto&, const auto&) { return std::array{1.0}; }, std::array{0.0});
  prince_dormand87 under_law(std::ref(pushed), 0.0, pushed.make_x(q, v), tight);
  CHECK(under_law.integrate(2.0, element_events(pushed)).count == report.count);
  CHECK((under_law.state().head(3) - solver.state().head(3)).cwiseAbs().maxCoeff() < 1e-13);
}

TEST_CASE("bodies at rest without friction have no events") {
  runtime_chain discs;  // side by side
  discs << base_2D("world");
  for (const std::string name : {"left", "right"})
    discs << free_joint_2D(name + " pose", "world", name) << inertia_2D(name, planar_body(1.0, 0.005));
  discs << sphere_contact_2D("pair", "left", "right", ball_surface(0.1), 0.1, {.friction = 0.0});
  const vector q = numbers({0, 0, 0, 0.2, 0, 0}), v = vector::Zero(6);
  const auto end = run(planar_model(discs), q, v, 1.0, tight);
  CHECK(end.report.count == 0);
  CHECK((end.x.head(6) - q).cwiseAbs().maxCoeff() < 1e-15);
}

}  // namespace contact_events_test
