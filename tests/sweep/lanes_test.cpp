#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/lanes.hpp>
#include <kte/elements/joint_limit.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/prince_dormand87.hpp>
#include <kte/integrators/runge_kutta4.hpp>
#include <kte/math/pack.hpp>
#include <kte/models/element_events.hpp>
#include <kte/static_chain/lanes.hpp>
#include <kte/sweep.hpp>
#include <kte/sweep/final_state.hpp>

#include "catch.hpp"
#include "chain/models.hpp"

// Simulations in lanes with their own times and steps.

namespace lanes_test {

using kte::test::contains_text;
using namespace kte;
using P = pack<double, 8>;
template <class S>
using pair = Eigen::Matrix<S, 2, 1>;

/// A spring that stiffens, with a force that depends on time.
template <class S>
struct duffing {
  S k;
  pair<S> operator()(const S& t, const pair<S>& x) const {
    return {x[1], -k * x[0] - x[0] * x[0] * x[0] - S(0.1) * x[1] + S(0.3) * t};
  }
};
const sweep_cases springs = random_cases(43, 5, {log_uniform("k", 0.5, 200), uniform("end", 0.2, 3)});
const auto own_end = [](const auto& c) { return c["end"]; };
template <template <class, class> class Method, class... Setting>
auto spring(const Setting&... setting) {
  return [=](const auto& c) {
    using S = typename std::remove_cvref_t<decltype(c)>::scalar;
    return Method<duffing<S>, pair<S>>(duffing<S>{c["k"]}, 0.0, pair<S>(S(1), S(0)), setting...);
  };
}
/// Checks the results in lanes: with other companions in the pack the same bits, and those of numbers but for rounding.
template <class Simulation>
void check_lanes(const sweep_cases& cases, const std::vector<std::string>& names, const Simulation& simulation,
                 double rounding) {
  const auto together = sweep(cases, names, in_packs<P>(simulation)).table();
  const auto alone = sweep(cases, names, in_packs<P>(simulation), {.shard_size = 1}).table();
  const auto threes = sweep(cases, names, in_packs<P>(simulation), {.shard_size = 3}).table();
  const auto numbers = sweep(cases, names, simulation).table();
  for (const auto& name : names)
    for (std::size_t i = 0; i < together[name].size(); ++i) {
      CHECK(together[name][i] == alone[name][i]);
      CHECK(together[name][i] == threes[name][i]);
      CHECK(std::abs(together[name][i] - numbers[name][i]) <= rounding * (1 + std::abs(numbers[name][i])));
    }
  CHECK(together.failures.empty());
}

TEST_CASE("lanes with their own ends and steps do not depend on their companions") {
  const tolerances<double> fine{.absolute = 1e-8, .relative = 1e-8};
  check_lanes(springs, {"x", "v"}, final_state(own_end, spring<runge_kutta4>(0.01)), 1e-13);
  check_lanes(springs, {"x", "v"}, final_state(own_end, spring<dormand_prince45>(fine)), 1e-11);
  check_lanes(springs, {"x", "v"}, final_state(2.0, spring<prince_dormand87>(fine)), 1e-11);
  // so tight that step errors are rounding
  check_lanes(springs, {"x", "v"},
              final_state(0.3, spring<dormand_prince45>(tolerances<double>{.absolute = 1e-17, .relative = 1e-14})),
              1e-11);
}

TEST_CASE("the number of steps in lanes is that of each case alone") {
  long long calls = 0, alone = 0;
  const auto counting = [&calls](const auto& c) {
    using S = typename std::remove_cvref_t<decltype(c)>::scalar;
    const auto f = [k = c["k"], &calls](const S& t, const pair<S>& x) {
      ++calls;
      return duffing<S>{k}(t, x);
    };
    return dormand_prince45<std::remove_const_t<decltype(f)>, pair<S>>(f, 0.0, pair<S>(S(1), S(0)));
  };
  const auto cases = random_cases(400, 5, {log_uniform("k", 0.5, 200), uniform("end", 2, 6)});
  (void)sweep(cases, {"x", "v"}, final_state(own_end, counting)).table();
  alone = std::exchange(calls, 0);
  (void)sweep(cases, {"x", "v"}, in_packs<P>(final_state(own_end, counting))).table();
  CHECK(static_cast<double>(calls) < 1.35 * static_cast<double>(alone) / 8);
}

TEST_CASE("events in lanes: balls that bounce, rest, and stop") {
  const auto falling = [](const auto& c) {
    using S = typename std::remove_cvref_t<decltype(c)>::scalar;
    const auto f = [g = c["g"]](const S&, const pair<S>& x) { return pair<S>(x[1], -g); };
    return dormand_prince45<std::remove_const_t<decltype(f)>, pair<S>>(f, 0.0, pair<S>(c["height"], S(0)));
  };
  const auto cases = random_cases(
      37, 2,
      {uniform("g", 1.6, 25), uniform("height", 0.5, 5), uniform("restitution", 0.5, 0.95), uniform("end", 1, 6)});
  const auto simulation = final_state(own_end, falling).with_events([](const sweep_case<double>& c) {
    const double e = c["restitution"];
    int* const bounces = new int(0);
    auto floor = event([](double, const auto& x) { return x[0]; }, crossing::falling).named("floor");
    auto bounce = floor.reset([e, bounces](double, auto& x) { x[1] *= -e, ++*bounces; }).one_sided();
    auto third = event([bounces](double, const auto& x) { return *bounces < 3 ? 1.0 : x[1]; }, crossing::falling)
                     .terminal()
                     .named("third apex");
    return std::pair(std::shared_ptr<int>(bounces), events(bounce, third));
  });
  check_lanes(cases, {"t", "x", "v", "events", "apex"}, simulation.keep([](const auto& end) {
    return std::array{end.time, end.state[0], end.state[1], static_cast<double>(end.events),
                      end.stopped_by == "third apex" ? 1.0 : 0.0};
  }),
              1e-9);
  const auto fixed =
      final_state(own_end, [](const auto& c) {
        using S = typename std::remove_cvref_t<decltype(c)>::scalar;
        const auto f = [g = c["g"]](const S&, const pair<S>& x) { return pair<S>(x[1], -g); };
        return runge_kutta4<std::remove_const_t<decltype(f)>, pair<S>>(f, 0.0, pair<S>(c["height"], S(0)), 0.05);
      }).with_events([](const auto& c) {
        return events(event([](double, const auto& x) { return x[0]; }, crossing::falling)
                          .reset([e = c["restitution"]](double, auto& x) { x[1] *= -e; })
                          .rest([](double, auto& x) { x[0] = x[1] = 0; }));
      });
  check_lanes(cases, {"x", "v"}, fixed, 1e-9);
}

TEST_CASE("lanes that fail leave the others alone, and say why") {
  /// x' = 1 / (1 - x / pole) ... grows without limit at a time that depends on the case.
  const auto cases = random_cases(30, 9, {uniform("pole", 0.3, 3)});
  const auto blowing = [](const auto& c) {
    using S = typename std::remove_cvref_t<decltype(c)>::scalar;
    const auto f = [p = c["pole"]](const S&, const Eigen::Matrix<S, 1, 1>& x) {
      return Eigen::Matrix<S, 1, 1>(x[0] * x[0] / p);
    };
    return dormand_prince45<std::remove_const_t<decltype(f)>, Eigen::Matrix<S, 1, 1>>(f, 0.0,
                                                                                      Eigen::Matrix<S, 1, 1>(S(1)));
  };
  const auto lanes = sweep(cases, {"x"}, in_packs<P>(final_state(1.0, blowing))).table();
  const auto numbers = sweep(cases, {"x"}, final_state(1.0, blowing)).table();
  CHECK(lanes["failed"] == numbers["failed"]);
  CHECK(lanes.summary.failed > 3);
  REQUIRE(lanes.failures.size() == numbers.failures.size());
  for (std::size_t i = 0; i < 30; ++i)
    if (numbers["failed"][i] == 0) CHECK(lanes["x"][i] == within_relative(numbers["x"][i], 1e-12));
  CHECK_THAT(lanes.failures[0].reason, contains_text("kte: integration stopped at t = 0."));

  // exceptions of the right-hand side, of starts, and starts that are not finite
  const auto odd = [](const auto& c) {
    using S = typename std::remove_cvref_t<decltype(c)>::scalar;
    if (any(c["n"] == S(11))) throw std::runtime_error("no start");
    const auto f = [n = c["n"]](const S&, const pair<S>& x) {
      if (any(n == S(4))) throw std::runtime_error("no slope");
      return pair<S>(x[1], -x[0]);
    };
    const S x0 = select(c["n"] == S(17), S(std::numeric_limits<double>::infinity()), S(1));
    return dormand_prince45<std::remove_const_t<decltype(f)>, pair<S>>(f, 0.0, pair<S>(x0, S(0)));
  };
  std::vector<double> n(20);
  for (std::size_t i = 0; i < 20; ++i) n[i] = static_cast<double>(i);
  const auto table = sweep(one_of("n", n), {"x", "v"}, in_packs<P>(final_state(1.0, odd))).table();
  REQUIRE(table.failures.size() == 3);
  CHECK(table.failures[0] == sweep_failure{4, "no slope"});
  CHECK(table.failures[1] == sweep_failure{11, "no start"});
  CHECK(table.failures[2].index == 17);
  CHECK_THAT(table.failures[2].reason, contains_text("start state must be finite"));
  for (std::size_t i = 0; i < 20; ++i)
    if (i != 4 && i != 11 && i != 17) CHECK(table["x"][i] == within(std::cos(1.0), 1e-5));

  const auto short_of = sweep(one_of("n", {1}), {"x"}, in_packs<P>(final_state(1.0, odd))).table();
  CHECK_THAT(short_of.failures.at(0).reason, contains_text("gave 2 numbers for 1 columns"));
}

/// A runtime chain of an arm with friction, in the scalar S.
template <class S>
struct moving_arm {
  runtime_chain chain;
  basic_runtime_state<S> state;
  using X = Eigen::Matrix<S, 4, 1>;

  explicit moving_arm(const runtime_chain& c) : chain(c), state(c.make_state<S>()) {}
  X operator()(const S&, const X& x) {
    const std::array<S, 2> zero{S(0), S(0)};
    const auto& a = forward_dynamics(chain, state, Eigen::Matrix<S, 2, 1>(x.template head<2>()),
                                     Eigen::Matrix<S, 2, 1>(x.template tail<2>()), zero);
    return {x[2], x[3], a[0], a[1]};
  }
};

TEST_CASE("runtime chains in lanes with their own steps") {
  runtime_chain arm;
  arm << revolute_joint_3D("q1", "base", "upper", axis::y) << rigid_link_3D("upper", "elbow", along_x(0.4))
      << inertia_3D("elbow", point_mass(2.0)) << joint_damping_gen("q1", 0.3)
      << revolute_joint_3D("q2", "elbow", "lower", axis::y) << rigid_link_3D("lower", "tool", along_x(0.3))
      << inertia_3D("tool", point_mass(1.0));
  arm.gravity(vec3<>{0, 0, -9.81});
  const auto start = [&arm](const auto& c) {
    using S = typename std::remove_cvref_t<decltype(c)>::scalar;
    const moving_arm<S> f(kte::lanes(arm, parameter{"tool/mass", c["mass"]}, parameter{"q1/damping", c["damping"]}));
    return dormand_prince45<moving_arm<S>, Eigen::Matrix<S, 4, 1>>(
        f, 0.0, Eigen::Matrix<S, 4, 1>(S(0.1), c["start"], S(0), S(0)));
  };
  check_lanes(
      random_cases(21, 3,
                   {uniform("mass", 0.5, 3), uniform("damping", 0, 1), uniform("start", 0, 1), uniform("end", 0.2, 1)}),
      {"q1", "q2", "v1", "v2"}, final_state(own_end, start), 1e-10);
}

TEST_CASE("events of elements in lanes: stops that are hit at other times in each lane") {
  const auto hinged =
      chain(revolute_joint_2D(models::q, models::base, models::joint),
            rigid_link_2D(models::joint, models::tip, along_x(0.5)), inertia_2D(models::tip, planar_body(1.0, 0.1)),
            joint_limit_gen(models::q, {.lower = -0.4, .upper = 0.5, .stiffness = 3000}))
          .gravity(along_y(-9.81));
  CHECK_THROWS_MATCHES(kte::lanes(hinged, parameter{"q/stiffness", P(1.0)}), bad_argument,
                       kte::test::says("is a double by the type of its element"));
  static constexpr double tolerance = 1e-13;
  const auto start = [&hinged](const auto& c) {
    using S = typename std::remove_cvref_t<decltype(c)>::scalar;
    const auto f = [arm = kte::lanes(hinged, parameter{"tip/mass", c["mass"]})](const S&, const pair<S>& x) {
      return pair<S>(x[1], forward_dynamics(arm, std::array{x[0]}, std::array{x[1]}, std::array{S(0)})[0]);
    };
    return dormand_prince45<std::remove_const_t<decltype(f)>, pair<S>>(
        f, 0.0, pair<S>(c["start"], S(0)), tolerances<double>{.absolute = tolerance, .relative = tolerance});
  };
  const auto of_elements = [&hinged](const sweep_case<double>& c) {
    const auto arm = kte::lanes(hinged, parameter{"tip/mass", c["mass"]});
    const auto model = std::make_shared<manipulator_dynamics_model<std::remove_const_t<decltype(arm)>>>(arm);
    return std::pair(model, element_events(*model));
  };
  const auto cases = random_cases(19, 4, {uniform("mass", 0.5, 3), uniform("start", 0, 0.4), uniform("end", 0.5, 1.5)});
  const auto steps = sweep(cases, {"steps"}, [&](const sweep_case<double>& c) {
    auto solver = start(c);
    auto events = of_elements(c);
    solver.integrate(c["end"], events.second);
    return std::array{static_cast<double>(solver.statistics().steps)};
  });
  // Rounding may reject a try in one of both, so that they agree within their errors: each step has an error of at most
  // the tolerance, which a stop turns into velocity by w = sqrt(k/I), I at least 0.1 + 0.5 * 0.25 kg m^2.
  const double w = std::sqrt(3000 / 0.225);
  check_lanes(cases, {"q", "v", "events"},
              final_state(own_end, start).with_events(of_elements).keep([](const auto& end) {
                return std::array{end.state[0], end.state[1], static_cast<double>(end.events)};
              }),
              2 * steps.table().summary.statistics[0].most * tolerance * w);
}

}  // namespace lanes_test
