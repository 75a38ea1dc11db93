#include <kte/dynamics.hpp>
#include <kte/elements/four_bar.hpp>
#include <kte/elements/implicit_follower.hpp>
#include <kte/io/model_file.hpp>
#include <kte/math/pack.hpp>
#include <kte/simulation.hpp>

#include <cmath>

#include "catch.hpp"
#include "chain/registered.hpp"
#include "digits50.hpp"
#include "elements/laws.hpp"

namespace implicit_follower_test {

using namespace kte;
using namespace kte::test;

constexpr four_bar_lengths bars{.pivot = {0.35, 0.05}, .crank = 0.12, .coupler = 0.33, .rocker = 0.24};
/// The ends of coupler and rocker of a four-bar together.
constexpr auto four_bar = [](const auto& q, const auto& c, const auto& r) {
  using std::cos;
  using std::sin;
  return make_rows(bars.crank * cos(q) + bars.coupler * cos(q + c) - bars.pivot.x - bars.rocker * cos(r),
                   bars.crank * sin(q) + bars.coupler * sin(q + c) - bars.pivot.y - bars.rocker * sin(r));
};
/// The ends of two equal cranks a coupler apart, as long as the ground: a parallelogram, or where it crosses itself an
/// antiparallelogram.
constexpr auto parallelogram = [](const auto& q, const auto& r) {
  using std::cos;
  using std::sin;
  constexpr double length = 0.5, crank = 0.2;
  const auto x = length + crank * cos(r) - crank * cos(q), y = crank * sin(r) - crank * sin(q);
  return (x * x + y * y - length * length) / (2 * length);
};

inline constexpr struct crank_ final : coord_key<"q"> {
} q_crank;
inline constexpr struct coupler_ final : coord_key<"c"> {
} q_coupler;
inline constexpr struct rocker_ final : coord_key<"r"> {
} q_rocker;
inline constexpr struct start1_ final : internal_key<"start1"> {
} start1;
inline constexpr struct start2_ final : internal_key<"start2"> {
} start2;
inline constexpr struct base_ final : frame_2D_key<"base"> {
} base;
inline constexpr struct crank_frame_ final : frame_2D_key<"crank"> {
} crank_frame;
inline constexpr struct tip_ final : frame_2D_key<"tip"> {
} tip;
inline constexpr struct coupler_frame_ final : frame_2D_key<"coupler"> {
} coupler_frame;
inline constexpr struct rocker_frame_ final : frame_2D_key<"rocker"> {
} rocker_frame;

const auto crank_bar = planar_body(0.3, 0.001, along_x(0.06)), coupler_bar = planar_body(0.5, 0.004, along_x(0.15)),
           rocker_bar = planar_body(0.4, 0.002, along_x(0.1));

template <class Follower>
auto static_four_bar(const Follower& f) {
  return chain(f, revolute_joint_2D(q_crank, base, crank_frame), inertia_2D(crank_frame, crank_bar),
               rigid_link_2D(crank_frame, tip, along_x(bars.crank)), revolute_joint_2D(q_coupler, tip, coupler_frame),
               inertia_2D(coupler_frame, coupler_bar), revolute_joint_2D(q_rocker, base, rocker_frame).at(bars.pivot),
               inertia_2D(rocker_frame, rocker_bar))
      .gravity(along_y(-9.81));
}
template <class Follower>
runtime_chain runtime_four_bar(const Follower& f) {
  runtime_chain c;
  c.gravity(along_y(-9.81)) << f << revolute_joint_2D("q", "base", "crank") << inertia_2D("crank", crank_bar)
                            << rigid_link_2D("crank", "tip", along_x(bars.crank))
                            << revolute_joint_2D("c", "tip", "coupler") << inertia_2D("coupler", coupler_bar)
                            << revolute_joint_2D("r", "base", "rocker").at(bars.pivot)
                            << inertia_2D("rocker", rocker_bar);
  return c;
}
/// Two cranks on the ground.
template <class Follower>
auto cranks(const Follower& f) {
  return chain(f, revolute_joint_2D(q_crank, base, crank_frame), inertia_2D(crank_frame, crank_bar),
               revolute_joint_2D(q_rocker, base, rocker_frame).at(vec2<>{0.5, 0}), inertia_2D(rocker_frame, rocker_bar))
      .gravity(along_y(-9.81));
}
template <class F>
std::string message_of(const F& f) {
  try {
    f();
  } catch (const kte::error& e) {
    return e.what();
  }
  return {};
}
const std::array guess{core::four_bar_coupler(bars).value(0.9) + 0.02, core::four_bar_rocker(bars).value(0.9) - 0.02};

TEST_CASE("implicit followers move a four-bar as those in closed form do") {
  const auto closed = static_four_bar(four_bar_2D(q_crank, q_coupler, q_rocker, bars));
  const auto implicit =
      static_four_bar(implicit_follower_gen(four_bar, guess, q_crank, q_coupler, q_rocker, start1, start2));
  const auto at_run_time = runtime_four_bar(implicit_follower_gen(four_bar, guess, "q", "c", "r", "start1", "start2"));
  auto s = at_run_time.make_state();
  for (const double q : {0.5, 0.9, 1.4}) {
    const std::array at{q}, v{2.1}, tau{0.1};
    const double expected = forward_dynamics(closed, at, v, tau)[0];
    CHECK(forward_dynamics(implicit, at, v, tau)[0] == within(expected, 2e-13));
    CHECK(forward_dynamics(at_run_time, s, at, v, tau)[0] == within(expected, 2e-13));
    const std::array a{-3.0};
    CHECK(inverse_dynamics(at_run_time, s, at, v, a)[0] == within(inverse_dynamics(closed, at, v, a)[0], 1e-14));
    const auto by_closed = inverse_dynamics_derivatives(closed, at, v, a),
               by_implicit = inverse_dynamics_derivatives(implicit, at, v, a);
    CHECK(by_implicit.by_q(0, 0) == within(by_closed.by_q(0, 0), 1e-12));
    CHECK(by_implicit.by_v(0, 0) == within(by_closed.by_v(0, 0), 1e-13));
    const auto at_run = inverse_dynamics_derivatives(at_run_time, s, at, v, a);
    CHECK(at_run.by_q(0, 0) == within(by_closed.by_q(0, 0), 1e-12));
  }
}

TEST_CASE("rates of an implicit follower are exact") {
  // y^3 + y = q, whose solution is known where y is
  const auto cubic = [](const auto& q, const auto& y) { return y * y * y + y - q; };
  const auto check = [&]<class S>(const S& y, const S& tolerance) {
    using twice = dual<dual<S, 1>, 1>;
    const S q = y * y * y + y, slope = S(1) / (S(3) * y * y + S(1));
    twice at{dual<S, 1>(q)};
    at.value.derivative[0] = S(1), at.derivative[0] = dual<S, 1>(S(1));
    const auto found = detail::implicit_value<twice>(cubic, std::array{at}, std::array{S(0.3)}, false,
                                                     [](auto, const auto&) { FAIL(); })[0];
    using std::abs;
    CHECK(abs(S(found.value.value - y)) < tolerance);
    CHECK(abs(S(found.value.derivative[0] - slope)) < tolerance);
    CHECK(abs(S(found.derivative[0].derivative[0] + S(6) * y * slope * slope * slope)) < S(4) * tolerance);
  };
  check(0.7, 2e-16);
  check(-1.3, 4e-16);
  check(digits50("0.7"), digits50("1e-49"));
  using lanes = pack<double, 4>;
  lanes q;
  for (std::size_t i = 0; i < 4; ++i) q.set(i, 2.0 * (0.1 + static_cast<double>(i)));
  dual<lanes, 1> at(q);
  at.derivative[0] = lanes(1.0);
  const auto y = detail::implicit_value<dual<lanes, 1>>(cubic, std::array{at}, std::array{lanes(0.3)}, false,
                                                        [](auto, const auto&) { FAIL(); })[0];
  for (std::size_t i = 0; i < 4; ++i) {
    const double x = y.value[i];
    CHECK(x * x * x + x == within(q[i], 1e-15));
    CHECK(y.derivative[0][i] == within(1 / (3 * x * x + 1), 1e-15));
  }
}

TEST_CASE("a parallelogram stays one where its branches cross, and so does its opposite") {
  const auto c = cranks(implicit_follower_gen(parallelogram, 0.95, q_crank, q_rocker, start1));
  const manipulator_dynamics_model model(c);
  const manipulator_dynamics_model parallel(cranks(mimic_gen(q_crank, q_rocker, 1.0)));
  for (const double speed : {30.0, -23.7, 6.1, 1.0}) {
    const auto start = model.make_x(std::array{0.9}, std::array{speed});
    CHECK(start[2] == within(0.9 - 0.95, 1e-15));
    prince_dormand87 solver(std::cref(model), 0.0, start, {.absolute = 1e-9, .relative = 1e-9});
    prince_dormand87 expected(std::cref(parallel), 0.0, parallel.make_x(std::array{0.9}, std::array{speed}),
                              {.absolute = 1e-9, .relative = 1e-9});
    solver.integrate(2.0), expected.integrate(2.0);
    CHECK(solver.state()[0] == within(expected.state()[0], 1e-6));
    CHECK(solver.state()[2] + 0.95 == within(solver.state()[0], 1e-7));
  }
  // crossed: it turns the other way round, and back where it is at rest again
  const auto crossed = cranks(implicit_follower_gen(parallelogram, -1.5, q_crank, q_rocker, start1));
  const manipulator_dynamics_model opposite(crossed);
  prince_dormand87 solver(std::cref(opposite), 0.0, opposite.make_x(std::array{0.9}, std::array{20.0}),
                          {.absolute = 1e-9, .relative = 1e-9});
  solver.integrate(2.0);
  const double q = solver.state()[0], r = solver.state()[2] - 1.5;
  CHECK(std::abs(q) > 20);
  CHECK(r / q < 0);  // a turn for a turn
  CHECK(std::abs(r + q) < 4);
  CHECK(std::abs(std::remainder(r - q, 2 * std::acos(-1.0))) > 1e-3);
}

TEST_CASE("dead points, crossings and positions out of reach are refused by name") {
  const auto says = [](const runtime_chain& c, double q) {
    auto s = c.make_state();
    return message_of([&] { (void)forward_dynamics(c, s, std::array{q}, std::array{1.0}, std::array{0.0}); });
  };
  // a slider leads its crank: at the end of its way the crank does not follow
  runtime_chain c;
  const auto slide = [](const auto& x, const auto& angle) {
    using std::cos;
    return cos(angle) - x;
  };
  c << implicit_follower_gen(slide, 1.0, "x", "angle", "start")
    << prismatic_joint_2D("x", "base", "slider", along_x(1.0)) << inertia_2D("slider", point_mass(1.0))
    << revolute_joint_2D("angle", "base", "crank") << inertia_2D("crank", crank_bar);
  CHECK(says(c, 0.5) == "");
  const std::string dead = says(c, 1 - 1e-13), beyond = says(c, 1.1);
  CHECK(dead.find("implicit_follower_gen (base1 'x', start1 'start', end 'angle')") != std::string::npos);
  CHECK(beyond.find("has no solution at 1.1") != std::string::npos);
  auto s = c.make_state();
  const auto at = [&](double x) { return forward_dynamics(c, s, std::array{x}, std::array{1.0}, std::array{0.0}); };
  CHECK_THROWS_MATCHES(at(1 - 1e-13), dead_point, test::says(": dead point at 0.99999999999"));
  CHECK_THROWS_AS(at(1.1), bad_argument);
  // close to a crossing, a start between both branches is refused
  const auto p = cranks(implicit_follower_gen(parallelogram, 0.95, q_crank, q_rocker, start1));
  const manipulator_dynamics_model model(p);
  auto x = model.make_x(std::array{0.9}, std::array{1.0});
  x[0] = 0.01, x[2] = 0.01 - 0.95;
  CHECK(model(0.0, x)[2] == within(1.0, 1e-10));
  x[2] -= 0.01;
  CHECK_THROWS_MATCHES(model(0.0, x), bad_argument, test::says("too close to each other to tell"));
}

TEST_CASE("an implicit follower cannot be saved, and its guess is checked") {
  const auto c = runtime_four_bar(implicit_follower_gen(four_bar, guess, "q", "c", "r", "start1", "start2"));
  CHECK(message_of([&] { (void)record_of(c); }).find("implicit_follower_gen (base1 'q'") != std::string::npos);
  CHECK(complaint([] {
          (void)implicit_follower_gen(parallelogram, std::numeric_limits<double>::quiet_NaN(), "q", "r", "start");
        }).find("guess must be finite") != std::string::npos);
}

}  // namespace implicit_follower_test
