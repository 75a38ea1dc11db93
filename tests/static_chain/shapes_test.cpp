#include <kte/dynamics.hpp>
#include <kte/elements/dry_revolute_joint.hpp>
#include <kte/elements/law_follower.hpp>
#include <kte/elements/law_signal.hpp>
#include <kte/elements/line_point_mindist.hpp>
#include <kte/elements/mimic.hpp>
#include <kte/elements/position_control.hpp>
#include <kte/elements/position_measure.hpp>
#include <kte/elements/rotor.hpp>
#include <kte/simulation.hpp>

#include "catch.hpp"

namespace shapes_test {

using namespace kte;

/// A static chain of all shapes that an element may have, against the same chain at run time, which
/// dynamics/shapes_test.cpp tests.

// clang-format off
constexpr struct shoulder_ final : coord_key<"shoulder">       {} shoulder;
constexpr struct elbow_    final : coord_key<"elbow">          {} elbow;
constexpr struct finger_   final : coord_key<"finger">         {} finger;
constexpr struct thumb_    final : coord_key<"thumb">          {} thumb;
constexpr struct lift_     final : coord_key<"lift">           {} lift;
constexpr struct ground_   final : frame_3D_key<"ground">      {} ground;
constexpr struct table_    final : frame_3D_key<"table">       {} table;
constexpr struct upper_    final : frame_3D_key<"upper">       {} upper;
constexpr struct fore_     final : frame_3D_key<"fore">        {} fore;
constexpr struct hand_     final : frame_3D_key<"hand">        {} hand;
constexpr struct claw_     final : frame_3D_key<"claw">        {} claw;
constexpr struct tray_     final : frame_3D_key<"tray">        {} tray;
constexpr struct foot_     final : frame_3D_key<"foot">        {} foot;
constexpr struct table_p_  final : vector_key<"table.p">       {} table_p;
constexpr struct table_v_  final : vector_key<"table.v">       {} table_v;
constexpr struct table_a_  final : vector_key<"table.a">       {} table_a;
constexpr struct lift_p_   final : input_key<"lift.p">         {} lift_p;
constexpr struct lift_v_   final : input_key<"lift.v">         {} lift_v;
constexpr struct lift_a_   final : input_key<"lift.a">         {} lift_a;
constexpr struct seen_     final : input_key<"seen">           {} seen;
constexpr struct drive_    final : input_key<"drive">          {} drive;
constexpr struct where_    final : vector_key<"where">         {} where;
// clang-format on

struct cam {
  template <class Q>
  auto operator()(const Q& q) const {
    using std::sin;
    return Q(0.7 * q + 0.2 * sin(q));
  }
};
struct controller {
  template <class U>
  auto operator()(const U& q, const U& t) const {
    using std::sin;
    return U(-3.0 * q + sin(U(2.0 * t)));
  }
};

/// `name(key)`: the key itself, or its text for a runtime chain. `to`: takes the elements.
template <class Name, class To>
auto all_shapes(const Name& name, const To& to, bool dry) {
  constexpr rigid_body body{1.5, vec3{0.02, -0.03, 0.1}, sym3{0.03, 0.001, -0.002, 0.025, 0.003, 0.02}};
  constexpr vec3 axis{0.6, 0.0, 0.8};
  return to(position_control_3D(name(table_p), name(table_v), name(table_a), name(ground), name(table)),
            revolute_joint_3D(name(shoulder), name(table), name(upper), axis), inertia_3D(name(upper), body),
            dry_revolute_joint_3D(name(elbow), name(upper), name(fore), axis::y, dry ? 0.02 : 0.0, 0.1),
            inertia_3D(name(fore), body), mimic_gen(name(elbow), name(finger), 0.8, 0.1),
            prismatic_joint_3D(name(finger), name(fore), name(hand), axis::x), inertia_3D(name(hand), body),
            law_follower_gen(cam{}, name(shoulder), name(thumb)),
            revolute_joint_3D(name(thumb), name(hand), name(claw), axis::z), inertia_3D(name(claw), body),
            position_control_gen(name(lift_p), name(lift_v), name(lift_a), name(lift)),
            prismatic_joint_3D(name(lift), name(upper), name(tray), axis::z), inertia_3D(name(tray), body),
            rotor_3D(name(elbow), name(upper), axis, 30.0, 1e-4),
            line_point_mindist_3D(name(claw), name(foot), axis, vec3{0.1, 0.2, 0.3}),
            spring_3D(name(foot), name(tray), 0.1, 70.0), position_measure_gen(name(elbow), name(seen)),
            law_signal(controller{}, name(seen), name(chain_time), name(drive)),
            driving_actuator_gen(name(shoulder), name(drive)), position_measure_3D(name(claw), name(where)));
}
auto static_one(bool dry) {
  return all_shapes([](const auto& key) { return key; }, [](const auto&... e) { return chain(e...); }, dry)
      .gravity(vec3{0.3, -0.4, -9.81});
}
runtime_chain runtime_one(bool dry) {
  runtime_chain c;
  all_shapes([](const auto& key) { return std::string(key.name); },
             [&c](const auto&... e) { return (c << ... << e), 0; }, dry);
  return c.gravity(vec3{0.3, -0.4, -9.81});
}
template <class A, class B>
double difference_of(const A& a, const B& b) {
  return (a - b).template lpNorm<Eigen::Infinity>() / std::max(1.0, b.template lpNorm<Eigen::Infinity>());
}

TEST_CASE("a static chain of all shapes is what it is at run time") {
  const bool dry = GENERATE(false, true);
  const auto c = static_one(dry);
  const auto r = runtime_one(dry);
  auto s = make_state(c);
  auto t = r.make_state();
  const auto put_inputs = [](const auto& numbers, const auto& vectors) {
    vectors(table_p) = {0.1, -0.2, 0.3}, vectors(table_v) = {0.5, 0.4, -0.3}, vectors(table_a) = {-1.1, 2.2, 0.7};
    numbers(lift_p) = 0.2, numbers(lift_v) = -0.3, numbers(lift_a) = 0.4, numbers(chain_time) = 0.7;
  };
  put_inputs([&](const auto& key) -> double& { return s[key]; }, [&](const auto& key) -> vec3<>& { return s[key]; });
  put_inputs([&](const auto& key) -> double& { return t.input(key.name); },
             [&](const auto& key) -> vec3<>& { return t.vector(key.name); });
  const Eigen::Vector2d q{0.4, -0.7}, v{0.9, 1.3}, a{-0.6, 0.5};
  set_positions(s, q), set_velocities(s, v), set_accelerations(s, a);
  set_positions(t, q), set_velocities(t, v), set_accelerations(t, a);

  const Eigen::Vector2d tau = inverse_dynamics(c, s);
  CHECK(difference_of(tau, Eigen::Vector2d(inverse_dynamics(r, t))) < 1e-14);
  c.doMotion(s), c.clearForce(s), c.doForce(s);
  CHECK(difference_of(-forces(s), tau) < 1e-14);
  CHECK(s[where].x == within(s[claw].position.x, 0));
  CHECK(s[drive] == within(-3 * -0.7 + std::sin(1.4), 1e-15));
  const auto y = c.outputs(s);
  REQUIRE(y.size() == 5);
  CHECK(y[0] == within(-0.7, 0));
  CHECK(y[1] == within(s[drive], 0));
  CHECK(y[4] == within(s[claw].position.z, 0));
  r.doMotion(t);
  const auto named = r.outputs(t);
  REQUIRE(named.size() == 3);
  CHECK(named[1].name == "drive");
  CHECK(named[1].numbers[0] == within(y[1], 1e-15));
  CHECK(named[2].numbers[2] == within(y[4], 1e-15));
  CHECK(difference_of(mass_matrix(c, s), Eigen::Matrix2d(mass_matrix(r, t))) < 1e-15);
  CHECK(difference_of(mass_matrix_inverse(c, s), Eigen::Matrix2d(mass_matrix_inverse(r, t))) < 1e-14);
  CHECK(difference_of(forward_dynamics(c, s), Eigen::Vector2d(forward_dynamics(r, t))) < 1e-14);
  const auto known = forward_dynamics_derivatives(c, s);
  const auto& of_runtime = forward_dynamics_derivatives(r, t);
  CHECK(difference_of(known.by_q, Eigen::Matrix2d(of_runtime.by_q)) < 1e-13);
  CHECK(difference_of(known.by_v, Eigen::Matrix2d(of_runtime.by_v)) < 1e-13);
  CHECK(difference_of(known.by_tau, Eigen::Matrix2d(of_runtime.by_tau)) < 1e-13);
  CHECK(difference_of(jacobian(c, q, foot), Eigen::Matrix<double, 6, 2>(jacobian(r, t, q, "foot"))) < 1e-14);
  CHECK(difference_of(jacobian(c, q, foot, in_world_axes),
                      Eigen::Matrix<double, 6, 2>(jacobian(r, t, q, "foot", in_world_axes))) < 1e-14);

  manipulator_dynamics_model model(c);
  manipulator_dynamics_model runtime_model(r);
  REQUIRE(model.input().size() == 12);
  REQUIRE(runtime_model.input().size() == 12);
  Eigen::VectorXd u(12);
  u << 0.1, -0.2, 0.3, 0.5, 0.4, -0.3, -1.1, 2.2, 0.7, 0.2, -0.3, 0.4;
  model.setInput(u), runtime_model.setInput(u);
  const auto x = model.make_x(q, v);
  const Eigen::Vector4d rate = model(0.7, x);
  CHECK(difference_of(Eigen::Vector2d(rate.tail(2)), Eigen::Vector2d(forward_dynamics(c, s))) < 1e-15);
  CHECK(difference_of(rate, Eigen::Vector4d(runtime_model(0.7, Eigen::VectorXd(x)))) < 1e-14);
  CHECK(difference_of(rate, Eigen::Vector4d(runtime_model(0.8, Eigen::VectorXd(x)))) > 1e-3);

  // stiff methods, of both kinds of chain
  const auto end_of = [](auto solver) {
    solver.integrate(0.75);
    return Eigen::VectorXd(solver.state());
  };
  const Eigen::VectorXd y1 = end_of(prince_dormand87(std::cref(model), 0.7, x, {.absolute = 1e-12, .relative = 1e-12}));
  CHECK(difference_of(end_of(rodas(std::cref(model), 0.7, x, {.absolute = 1e-9, .relative = 1e-9})), y1) < 1e-7);
  CHECK(difference_of(
            end_of(rodas(std::cref(runtime_model), 0.7, Eigen::VectorXd(x), {.absolute = 1e-9, .relative = 1e-9})),
            y1) < 1e-7);
}

}  // namespace shapes_test
