#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/runge_kutta4.hpp>
#include <kte/models/manipulator_dynamics_model.hpp>
#include <kte/models/vector_form.hpp>
#include <kte/static.hpp>

#include "catch.hpp"

namespace manipulator_dynamics_model_test {

using namespace kte;
using kte::test::contains_text;

// clang-format off
constexpr struct q_     final : coord_key<"q">          {} q;
constexpr struct base_  final : frame_2D_key<"base">    {} base;
constexpr struct joint_ final : frame_2D_key<"joint">   {} joint;
constexpr struct tip_   final : frame_2D_key<"tip">     {} tip;
constexpr struct motor_ final : input_key<"motor">      {} motor;
constexpr struct hairs_ final : internal_key<"bristles"> {} bristles;
constexpr struct r_     final : coord_key<"r">          {} r;
constexpr struct more_  final : internal_key<"more">    {} more;
constexpr struct body_  final : pose_3D_key<"body">     {} body;
constexpr struct world_ final : frame_3D_key<"world">   {} world;
constexpr struct trunk_ final : frame_3D_key<"trunk">   {} trunk;
// clang-format on

constexpr auto pendulum = chain(revolute_joint_2D(q, base, joint), rigid_link_2D(joint, tip, along_x(0.5)),
                                inertia_2D(tip, point_mass(1.0)), driving_actuator_gen(q, motor))
                              .gravity(along_y(-9.81));
constexpr lugre_parameters friction{
    .sigma0 = 1e5, .sigma1 = 300, .sigma2 = 0.4, .coulomb = 1, .stiction = 1.5, .stribeck_velocity = 0.001};
constexpr auto frictional = chain(prismatic_joint_2D(q, base, tip, axis::x), inertia_2D(tip, point_mass(2.0)),
                                  joint_lugre_gen(q, bristles, friction), driving_actuator_gen(q, motor));
constexpr auto frictional_twice =
    chain(prismatic_joint_2D(q, base, joint, axis::x), prismatic_joint_2D(r, joint, tip, axis::y),
          inertia_2D(tip, point_mass(2.0)), joint_lugre_gen(q, bristles, friction), joint_lugre_gen(r, more, friction));

const auto free_body =
    chain(free_joint_3D(body, world, trunk), inertia_3D(trunk, rigid_body<>{1.0, {}, {1.0, 0.0, 0.0, 2.0, 0.0, 3.0}}));

using pendulum_model = manipulator_dynamics_model<std::remove_const_t<decltype(pendulum)>>;
static_assert(state_rate_function<const pendulum_model, Eigen::Vector2d>);
static_assert(state_rate_function_with_io<pendulum_model, Eigen::Vector2d, Eigen::Matrix<double, 1, 1>>);

TEST_CASE("a model gives the rates of a pendulum, and takes inputs") {
  manipulator_dynamics_model model(pendulum);
  const auto x = model.make_x(std::array{0.0}, std::array{2.0});
  CHECK(x == Eigen::Vector2d(0, 2));
  CHECK(model.computeStateRate(0.0, x) == Eigen::Vector2d(2, -9.81 / 0.5));
  model.input(motor) = 1;
  CHECK(model(0.0, x)[1] == within_relative(-19.62 + 4, 1e-15));
  model.setInput(std::array{-1.0});
  CHECK(model(0.0, x)[1] == within_relative(-19.62 - 4, 1e-15));
  CHECK(model.computeOutput(0.0, x) == x);
  CHECK(model.positions_of(x) == x.head(1));
  const Eigen::VectorXd five = Eigen::VectorXd::Zero(5), right = x;
  CHECK_THROWS_AS(model(0.0, five), bad_argument);
  CHECK_THROWS_AS(model.state_at(0.0, five), bad_argument);
  CHECK_THROWS_AS(model.computeOutput(0.0, five), bad_argument);
  CHECK(model(0.0, right) == model(0.0, x));
  CHECK_THROWS_WITH(model.positions_of(Eigen::VectorXd(5)),
                    contains_text("x has 5 numbers, the chain has 2 numbers of a state"));
  const auto height = model.with_output([](const auto& s) { return s[tip].position.y; });
  CHECK(height.computeOutput(0.0, model.make_x(std::array{0.5}, std::array{0.0})) ==
        within(0.5 * std::sin(0.5), 1e-16));
  CHECK(height.input()[0] == -1);
  CHECK_THROWS_WITH(model.setInput(std::vector<double>(3)), contains_text("u has 3 numbers, the chain has 1 inputs"));
}

TEST_CASE("bristles are part of the state") {
  manipulator_dynamics_model model(frictional);
  static_assert(decltype(model)::state::RowsAtCompileTime == 3);
  const auto x = model.make_x(std::array{0.0}, std::array{0.3}, std::array{1e-6});
  const double g = 1 + 0.5 * std::exp(-0.09 / 1e-6), z_dot = 0.3 - 1e5 * 0.3 * 1e-6 / g;
  const auto r = model(0.0, x);
  CHECK(r[0] == 0.3);
  CHECK(r[1] == within_relative(-(0.1 + 300 * z_dot + 0.4 * 0.3) / 2, 1e-14));
  CHECK(r[2] == within_relative(z_dot, 1e-14));
}

TEST_CASE("a free body integrates on its group") {
  manipulator_dynamics_model model(free_body);
  static_assert(moves_on_group<decltype(model), decltype(model)::state>);
  const std::array<double, 7> q0{0, 0, 0, 1, 0, 0, 0};
  const std::array<double, 6> v0{1, 0, 0, 0.01, 10, 0.01};
  dormand_prince45 solver(std::ref(model), 0.0, model.make_x(q0, v0), {.absolute = 1e-12, .relative = 1e-12});
  solver.integrate(10);
  const auto& x = solver.state();
  // rate of the body at 10 s by elliptic functions
  CHECK(x[10] == within_relative(4.46960797706577079, 1e-9));
  CHECK(x[11] == within_relative(8.94554104184593343, 1e-9));
  CHECK(x[12] == within_relative(2.58054228594495049, 1e-9));
  CHECK(x.segment<4>(3).norm() == within_relative(1, 1e-15));
  CHECK(x[0] == within_relative(10, 1e-9));  // in the direction it was thrown
  CHECK(std::abs(x[1]) + std::abs(x[2]) < 1e-8);
}

TEST_CASE("internal states follow velocities in the order of their elements, also in the vector form") {
  const manipulator_dynamics_model model(frictional_twice);
  const auto x = model.make_x(Eigen::Vector2d(0.1, 0.2), Eigen::Vector2d(0.3, -0.4), Eigen::Vector2d(1e-6, -2e-6));
  REQUIRE(x.size() == 6);
  CHECK(x.tail<4>() == Eigen::Vector4d(0.3, -0.4, 1e-6, -2e-6));
  CHECK(model.internals_of(x) == Eigen::Vector2d(1e-6, -2e-6));
  const auto rates = model(0.0, x);
  CHECK(rates[4] > 0);
  CHECK(rates[5] < 0);
  CHECK(vector_form(std::cref(model))(0.0, x) == rates);  // coordinates are numbers: equal rates
}

TEST_CASE("a failure of the integration says why the model could not be computed") {
  const auto reason = [](const auto& model, const auto& x) {
    try {
      (void)model.computeStateRate(0.0, x);
    } catch (const kte::error& e) {
      return std::string(e.what()).substr(5);  // "kte: "
    }
    return std::string("no reason");
  };
  const manipulator_dynamics_model free(free_body);
  const decltype(free)::state flat = decltype(free)::state::Zero();  // a quaternion of length 0
  dormand_prince45 turns(std::cref(free), 0.0, flat);
  CHECK_THROWS_WITH(turns.integrate(1),
                    contains_text("kte: integration stopped at t = 0: ") && contains_text(": " + reason(free, flat)));
  const manipulator_dynamics_model light(chain(revolute_joint_2D(q, base, joint),
                                               rigid_link_2D(joint, tip, along_x(0.5)),
                                               inertia_2D(tip, point_mass(0.0)), driving_actuator_gen(q, motor))
                                             .gravity(along_y(-9.81)));
  const auto x = light.make_x(std::array{0.0}, std::array{1.0});
  CHECK_THROWS_AS(light.computeStateRate(0.0, x), singular_mass_matrix);
  runge_kutta4 solver(std::cref(light), 2.0, x, 0.1);
  CHECK_THROWS_WITH(solver.integrate(3),
                    contains_text("kte: integration stopped at t = 2: ") && contains_text("mass matrix is singular"));
  CHECK(solver.state() == x);
}

TEST_CASE("a motion that blows up is a failure of the integration, with its time") {
  // Pushed by its own speed: with v' = v^3 infinite after 1/2 s, but gravity holds it back at first.
  manipulator_dynamics_model model(pendulum);
  const auto driven = [&](double t, const Eigen::Vector2d& x) {
    model.input(motor) = 0.25 * x[1] * x[1] * x[1];
    return model(t, x);
  };
  const auto start = model.make_x(std::array{-1.5707963267948966}, std::array{1.0});
  runge_kutta4 fixed(driven, 0.0, start, 0.01);
  CHECK_THROWS_WITH(fixed.integrate(2), contains_text("integration stopped at t = ") &&
                                            contains_text("the next state is not a finite number"));
  CHECK(fixed.state().allFinite());
  dormand_prince45 adaptive(driven, 0.0, start);
  CHECK_THROWS_AS(adaptive.integrate(2), integration_failure);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(model.computeStateRate(0.0, Eigen::Vector2d(nan, 0)), bad_argument);
  CHECK_THROWS_AS(model(0.0, Eigen::Vector2d(nan, 0)), bad_argument);
}

}  // namespace manipulator_dynamics_model_test
