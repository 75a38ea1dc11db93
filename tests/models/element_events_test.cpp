#include <kte/elements/spring.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/models/element_events.hpp>
#include <kte/models/runtime_dynamics_model.hpp>
#include <kte/static.hpp>

#include <cmath>
#include <numbers>

#include "catch.hpp"

// A mass on a spring that saturates: free fall beyond, harmonic within. All times are known.

namespace element_events_test {

using namespace kte;

// clang-format off
constexpr struct q_      final : coord_key<"q">            {} q;
constexpr struct anchor_ final : coord_key<"anchor">       {} anchor;
constexpr struct base_   final : frame_2D_key<"base">      {} base;
constexpr struct cart_   final : frame_2D_key<"cart">      {} cart;
constexpr struct hairs_  final : internal_key<"bristles">  {} bristles;
// clang-format on

constexpr double k = 100, most = 20, mass = 1;  // N/m, N, kg: limited beyond 0.2 m
constexpr auto sprung = chain(base_gen(anchor), prismatic_joint_2D(q, base, cart, axis::x),
                              inertia_2D(cart, point_mass(mass)), spring_gen(anchor, q, 0.0, k, most));
runtime_chain sprung_at_run_time() {
  runtime_chain c;
  c << base_gen("anchor") << prismatic_joint_2D("q", "base", "cart", axis::x) << inertia_2D("cart", point_mass(mass))
    << spring_gen("anchor", "q", 0.0, k, most);
  return c;
}
/// From 0.5 m at rest: a = -20 m/s^2 down to 0.2 m, then w = 10 rad/s.
constexpr double start = 0.5, limit = most / k;
const double first = std::sqrt(2 * (start - limit) / most), speed = most * first, w = std::sqrt(k / mass);
const double second = first + 2 / w * std::atan(limit * w / speed);

TEST_CASE("springs that saturate are events of their model, found where they do") {
  const manipulator_dynamics_model model(sprung);
  const auto solve = [&](auto& m, auto x0, const auto& list) {
    dormand_prince45 solver(std::ref(m), 0.0, x0, {.absolute = 1e-12, .relative = 1e-12});
    const auto report = integrate(solver, 0.4, list);
    REQUIRE(report.events.size() == 2);
    CHECK(report.events[0].time == within_relative(first, 1e-12));
    CHECK(report.events[1].time == within_relative(second, 1e-11));
    CHECK(report.events[0].name == "spring_gen (anchor1 'anchor', anchor2 'q')");
    CHECK(report.events[1].before[0] == within_relative(-limit, 1e-10));
    // energy: the start's
    CHECK(solver.state()[1] * solver.state()[1] / 2 + most * (std::abs(solver.state()[0]) - limit / 2) ==
          within_relative(most * (start - limit / 2), 1e-10));
  };
  const auto x0 = model.make_x(std::array{start}, std::array{0.0});
  solve(model, x0, element_events(model));
  manipulator_dynamics_model runtime(sprung_at_run_time());
  solve(runtime, Eigen::VectorXd(x0), element_events(runtime));
}

TEST_CASE("friction that sticks asks for no events, so that rest is free; events of users go beside") {
  const auto frictional =
      chain(base_gen(anchor), prismatic_joint_2D(q, base, cart, axis::x), inertia_2D(cart, point_mass(mass)),
            spring_gen(anchor, q, 0.0, k, most), joint_lugre_gen(q, bristles, {50, 5, 0.1, 0.5, 0.6, 0.1}));
  const manipulator_dynamics_model model(frictional);
  const auto evaluations = [&](auto solve) {
    dormand_prince45 solver(std::cref(model), 0.0, model.make_x(std::array{0.15}, std::array{0.0}));
    solve(solver);
    return static_cast<double>(solver.statistics().evaluations);
  };
  const double without = evaluations([](auto& solver) { solver.integrate(20.0); });
  const double with = evaluations([&](auto& solver) {
    const auto middle = event([](double, const auto& x) { return x[0]; }).named("middle");
    const auto report = integrate(solver, 20.0, joined(events(middle), element_events(model)));
    REQUIRE(report.find("middle") != nullptr);
    CHECK(std::abs(report.find("middle")->before[0]) < 1e-12);
    CHECK(report.find("end") == nullptr);
    CHECK(report.count < 50);
  });
  CHECK(with <= 1.3 * without);
}

TEST_CASE("elements of a runtime chain have their own events, also where laws change together or rest") {
  auto twice = sprung_at_run_time();
  twice << spring_gen("anchor", "q", 0.0, k, most);
  manipulator_dynamics_model model(twice);
  const auto all = element_events(model);
  CHECK(std::get<0>(all.list).size() == 2);
  dormand_prince45 solver(std::ref(model), 0.0, Eigen::VectorXd(model.make_x(std::array{start}, std::array{0.0})));
  const auto report = integrate(solver, 0.25, all);  // down through the limit, up to the other
  REQUIRE(report.events.size() == 4);
  CHECK(report.events[3].event == 1);
  CHECK(report.events[3].name == "spring_gen (anchor1 'anchor', anchor2 'q')");
}

}  // namespace element_events_test
