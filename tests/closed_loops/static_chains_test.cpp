#include <kte/elements/law_signal.hpp>

#include "allocations.hpp"
#include "catch.hpp"
#include "closed_loops/mechanisms.hpp"
#include "closed_loops/static_four_bar.hpp"

namespace static_chains_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::loops;
using namespace kte::test::loops::with_keys;
using Catch::Matchers::Message;

/// The four-bar as a runtime chain.
runtime_chain four_bar_at_run_time() {
  runtime_chain c;
  c << four_bar;
  return c;
}
const Eigen::Vector3d none(0, 0, 0);

double largest(const vector& x) { return x.cwiseAbs().maxCoeff(); }

// A pose, a rotation and closures of all other shapes, with a mass on a coordinate.
inline constexpr struct world_ final : frame_3D_key<"world"> {
} world;
inline constexpr struct hull_ final : frame_3D_key<"hull"> {
} hull;
inline constexpr struct tip_ final : frame_3D_key<"tip"> {
} tip;
inline constexpr struct arm_ final : frame_3D_key<"arm"> {
} arm;
inline constexpr struct hand_ final : frame_3D_key<"hand"> {
} hand;
inline constexpr struct float_ final : pose_3D_key<"float"> {
} floats;
inline constexpr struct ball_ final : rotation_3D_key<"ball"> {
} ball;
inline constexpr struct slide_ final : coord_key<"slide"> {
} slide;
inline constexpr struct wheel_ final : coord_key<"wheel"> {
} wheel;
inline constexpr struct rod_ final : loop_key<"rod"> {
} rod;
inline constexpr struct hinge_ final : loop_key<"hinge"> {
} hinge;
inline constexpr struct belt_ final : loop_key<"belt"> {
} belt;
const rigid_body<> solid{1.5, vec3<>{0.1, 0.2, -0.1}, sym3<>{0.3, 0.01, 0, 0.4, 0.02, 0.5}};
const auto tangle = chain(free_joint_3D(floats, world, hull), inertia_3D(hull, solid),
                          spherical_joint_3D(ball, hull, tip).at(vec3<>{0.5, 0.1, 0}), inertia_3D(tip, solid),
                          prismatic_joint_3D(slide, tip, arm, vec3<>{0.6, 0, 0.8}), inertia_3D(arm, solid),
                          rigid_link_3D(arm, hand, vec3<>{0.1, 0.4, 0}), inertia_gen(wheel, 0.7),
                          hinge_3D(hinge, world, hand, vec3<>{0, 0, 1}), distance_3D(rod, hull, hand, 0.9),
                          coupled_coordinates(belt, slide, wheel, 2.0, -1.0))
                        .gravity(along_z(-9.81));

TEST_CASE("a static four-bar has the accelerations and forces of the same at run time") {
  const auto q = assemble(four_bar, guess, held(crank));
  CHECK(q[0] == 1.1);
  CHECK(kte::loops(four_bar, q).gap < 1e-15);
  const auto v = consistent_velocities(four_bar, q, Eigen::Vector3d(2, 0, 0));
  CHECK(largest(loop_jacobian(four_bar, q) * v) < 1e-15);
  CHECK(largest(impulse(four_bar, q, Eigen::Vector3d(2, 0, 0)) - v) == 0);
  const Eigen::Vector3d tau(0.3, -0.2, 0.1);
  const auto x = constrained_dynamics(four_bar, q, v, tau);

  const auto c = four_bar_at_run_time();
  auto s = c.make_state();
  const auto& y = constrained_dynamics(c, s, q, v, tau);
  CHECK(largest(vector(x.a) - y.a) == 0);
  CHECK(x.rank == 2);
  CHECK(x.mobility == 1);
  CHECK(x.dependent.empty());
  CHECK(x.force(pin).x == y.loop("pin").force.x);
  CHECK(x.force(pin).y == y.loop("pin").force.y);
  CHECK(std::abs(x.loop(pin).residual.x) < 1e-15);
  CHECK(largest(vector(kte::forward_dynamics(four_bar, q, v, tau)) - y.a) == 0);

  auto state = make_state(four_bar);
  set_positions(state, q), set_velocities(state, v);
  CHECK(largest(kte::forward_dynamics(four_bar, state) - constrained_dynamics(four_bar, q, v, none).a) == 0);
}

TEST_CASE("inverse dynamics of a static chain by actuated keys") {
  const auto q = assemble(four_bar, guess, held(crank));
  const auto v = consistent_velocities(four_bar, q, Eigen::Vector3d(2, 0, 0));
  const auto a = kte::forward_dynamics(four_bar, q, v, Eigen::Vector3d(0, 0, 7.5));
  CHECK(kte::inverse_dynamics(four_bar, q, v, a, actuated(rocker))[0] == within(7.5, 1e-12));
  const auto g = loop_motion(four_bar, q, actuated(crank));
  CHECK(largest(loop_jacobian(four_bar, q) * g) < 1e-15);
  CHECK(g(0, 0) == 1);
  CHECK_THROWS_MATCHES(
      loop_motion(four_bar, q, actuated(crank, rocker)), bad_argument,
      Message("kte: this chain has mobility 1 here, so it is driven by as many coordinates, not by 2"));
  CHECK_THROWS_MATCHES(kte::inverse_dynamics(four_bar, q, v, Eigen::Vector3d(1, 0, 0), actuated(crank)), bad_argument,
                       Message("kte: these accelerations do not keep 'pin' closed: those of constrained_dynamics do"));
  CHECK_THROWS_AS(assemble(four_bar, Eigen::Vector3d(0.1, 0.2, pi), held(crank, rocker)), cannot_assemble);
}

TEST_CASE("closures of all shapes in a static chain") {
  runtime_chain c;
  c << tangle;
  auto s = c.make_state();
  vector at = neutral_configuration(tangle);
  vector d = vector::LinSpaced(tangle.dofs, -0.3, 0.4);
  const vector q = integrate(tangle, at, d, 1.0), v = vector::LinSpaced(tangle.dofs, 1, -0.5);
  const vector tau = vector::LinSpaced(tangle.dofs, -2, 2);
  const auto x = constrained_dynamics(tangle, q, v, tau);
  const auto& y = constrained_dynamics(c, s, q, v, tau);
  CHECK(x.rank == 7);
  CHECK(y.rank == 7);
  CHECK(largest(vector(x.a) - y.a) < 1e-13 * largest(y.a));
  CHECK(std::abs(x.loop(belt).torque.x - y.loop("belt").torque.x) < 1e-12);
  CHECK(std::abs(x.force(rod).x - y.loop("rod").force.x) < 1e-12);
  CHECK(std::abs(x.loop(hinge).torque.y - y.loop("hinge").torque.y) < 1e-12);
  const auto on = assemble(tangle, q);
  CHECK(kte::loops(tangle, on).gap < 1e-14);
  CHECK(largest(vector(on) - assemble(c, s, q)) < 1e-12);
}

TEST_CASE("a model of a static chain keeps its loops closed") {
  const auto q = assemble(four_bar, guess, held(crank));
  const auto v = consistent_velocities(four_bar, q, Eigen::Vector3d(2, 0, 0));
  const manipulator_dynamics_model model(four_bar);
  const auto c = four_bar_at_run_time();
  const manipulator_dynamics_model other(c);
  const tolerances<double> options{.absolute = 1e-10, .relative = 1e-10};
  prince_dormand87 solver(std::cref(model), 0.0, model.make_x(q, v), options);
  prince_dormand87 at_run_time(std::cref(other), 0.0, other.make_x(q, v), options);
  double gap = 0;
  solver.integrate(3.0, every(0.1), [&](double, const auto& x) {
    gap = (std::max)(gap, kte::loops(four_bar, vector(x.template head<3>())).gap);
  });
  at_run_time.integrate(3.0, every(0.1), [](double, const vector&) {});
  CHECK(gap < 1e-14);
  CHECK(largest(vector(solver.state()) - at_run_time.state()) < 1e-9);
  CHECK(solver.statistics().evaluations == at_run_time.statistics().evaluations);

  const auto s = model.state_at(0, solver.state());
  const auto r = constrained_dynamics(four_bar, solver.state().head<3>().eval(), solver.state().tail<3>().eval(), none);
  CHECK(s[pin].force.x == within(r.force(pin).x, 1e-12));
  CHECK(std::abs(s[pin].residual.x) < 1e-14);
  CHECK(std::abs(s[base].force.y + s[base].force.x) > 0);
  CHECK_THROWS_WITH(model.make_x(Eigen::Vector3d(1, 0, 0), v),
                    Catch::Matchers::StartsWith("kte: the state is off the loops: 'pin' is open by "));
  CHECK_THROWS_WITH(model.make_x(q, Eigen::Vector3d(1, std::numeric_limits<double>::quiet_NaN(), 0)),
                    "kte: a velocity is not finite");
  const auto x = model.make_x(q, v);
  CHECK(model.singular_distance(x) == within(other.singular_distance(vector(x)), 1e-15));
  CHECK((model.singular_distance(x) > 0.1 && model.singular_distance(x) <= 1));
}

TEST_CASE("a static chain off the loops tells its gap") {
  const auto q = assemble(four_bar, guess, held(crank));
  CHECK(constrained_dynamics(four_bar, q, none, none).gap < 1e-15);
  const Eigen::Vector3d off = q + Eigen::Vector3d(0, 0, 1e-3);
  CHECK(constrained_dynamics(four_bar, off, none, none).gap == kte::loops(four_bar, off).gap);
  CHECK(kte::loops(four_bar, off).gap > 1e-4);
  CHECK_NOTHROW(kte::forward_dynamics(four_bar, off, none, none));
  CHECK_THROWS_WITH(kte::forward_dynamics(four_bar, guess, none, none),
                    Catch::Matchers::StartsWith("kte: forward_dynamics: 'pin' is open by "));
  CHECK_THROWS_WITH(
      kte::forward_dynamics(four_bar, q, none, Eigen::Vector3d(0, std::numeric_limits<double>::infinity(), 0)),
      Catch::Matchers::EndsWith("tau[1] of 'coupler' is inf"));
}

TEST_CASE("a model of a static chain with a closure on a joint that moves in time") {
  static constexpr struct x_ final : coord_key<"x"> {
  } x;
  static constexpr struct p_ final : input_key<"p"> {
  } p;
  static constexpr struct v_ final : input_key<"v"> {
  } v;
  static constexpr struct acc_ final : input_key<"acc"> {
  } acc;
  static constexpr struct moved_ final : frame_2D_key<"moved"> {
  } moved;
  const auto bar_in_slot =
      chain(law_signal([](const auto& t) { return 0.3 + 0.5 * t * t; }, chain_time, p),
            law_signal([](const auto& t) { return t; }, chain_time, v),
            law_signal([](const auto& t) { return 0 * t + 1; }, chain_time, acc), position_control_gen(p, v, acc, x),
            prismatic_joint_2D(x, base, moved, axis::x), revolute_joint_2D(crank, base, a), inertia_2D(a, body),
            rigid_link_2D(a, A, along_x(1.0)), point_on_line_2D(pin, moved, A, axis::y));
  const manipulator_dynamics_model model(bar_in_slot);
  using one = Eigen::Matrix<double, 1, 1>;
  prince_dormand87 solver(std::cref(model), 0.0, model.make_x(one(std::acos(0.3)), one(0)),
                          {.absolute = 1e-9, .relative = 1e-9});
  solver.integrate(1.0);
  CHECK(solver.state()[0] == within(std::acos(0.8), 1e-14));
  CHECK(solver.state()[1] == within(-1 / 0.6, 1e-14));
  const auto s = model.state_at(1.0, solver.state());
  CHECK(s[crank].q_ddot == within((-1 - 0.8 / 0.36) / 0.6, 1e-13));

  const auto of_inputs = chain(position_control_gen(p, v, acc, x), prismatic_joint_2D(x, base, moved, axis::x),
                               revolute_joint_2D(crank, base, a), inertia_2D(a, body),
                               rigid_link_2D(a, A, along_x(1.0)), point_on_line_2D(pin, moved, A, axis::y));
  manipulator_dynamics_model by_inputs(of_inputs);
  by_inputs.input(p) = 0.3, by_inputs.input(v) = 0.1;
  CHECK_THROWS_WITH(by_inputs.make_x(one(std::acos(0.3)), one(0)),
                    Catch::Matchers::StartsWith("kte: inputs give a velocity to a frame of 'pin'"));
}

TEST_CASE("the bases, signals and prescribed coordinates of a state reach the loops of a static chain") {
  static constexpr struct ground_ final : frame_2D_key<"ground"> {
  } ground;
  static constexpr struct turn_ final : coord_key<"turn"> {
  } turn;
  static constexpr struct motor_ final : input_key<"motor"> {
  } motor;
  const auto moved =
      chain(base_gen(turn), revolute_joint_2D(turn, ground, base), driving_actuator_gen(crank, motor), four_bar);
  runtime_chain c;
  c << moved;
  const auto q = assemble(four_bar, guess, held(crank));
  const auto v = consistent_velocities(four_bar, q, Eigen::Vector3d(2, 0, 0));
  auto state = make_state(moved);
  auto s = c.make_state();
  const auto give = [](auto& to, auto& frame, auto& coordinate, double& torque) {
    set_positions(to, Eigen::Vector3d(1.1, -0.5, 1.5));
    frame.velocity = {0.3, -0.2}, frame.ang_velocity = 0.7, frame.acceleration = {1.5, 11}, frame.ang_acceleration = -2;
    coordinate.q = 0.4, coordinate.q_dot = -1.5, coordinate.q_ddot = 3;
    torque = 0.25;
  };
  give(state, state.template get<kind::frame_2D>(0), state.coordinate(3), state.template get<kind::input>(0));
  give(s, s.frame_2D("ground"), s.coordinate("turn"), s.input("motor"));
  set_positions(state, q), set_velocities(state, v), set_positions(s, vector(q)), set_velocities(s, vector(v));
  const vector x = kte::forward_dynamics(moved, state), y = kte::forward_dynamics(c, s);
  CHECK(largest(x - y) == 0);
  CHECK(largest(x - vector(kte::forward_dynamics(four_bar, q, v, none))) > 1);
}

TEST_CASE("a second call on loops allocates nothing") {
  const auto q = assemble(four_bar, guess, held(crank));
  const auto v = consistent_velocities(four_bar, q, Eigen::Vector3d(2, 0, 0));
  const auto c = four_bar_at_run_time();
  auto s = c.make_state();
  const auto first = kte::forward_dynamics(four_bar, q, v, none);
  const vector x = q, rates = v, tau = none, other = constrained_dynamics(c, s, x, rates, tau).a;
  joint_vector<double, 3> second, third;
  const constrained_dynamics_result* again = nullptr;
  CHECK(allocations::during([&] {
          second = kte::forward_dynamics(four_bar, q, v, none);
          third = constrained_dynamics(four_bar, q, v, none).a;
          again = &constrained_dynamics(c, s, x, rates, tau);
        }) == 0);
  CHECK(largest(first - second) + largest(third - first) + largest(again->a - other) == 0);
}

}  // namespace static_chains_test
