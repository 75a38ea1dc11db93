#include <kte/control/linearize.hpp>
#include <kte/elements/free_joint.hpp>
#include <kte/models/manipulator_dynamics_model.hpp>
#include <kte/models/runtime_dynamics_model.hpp>
#include <kte/static.hpp>

#include <functional>

#include "catch.hpp"
#include "chain/registered.hpp"

// Linear systems of models: in closed form, against other ways to the same, with more digits.

namespace linearize_test {

using namespace kte;

// clang-format off
constexpr struct x_         final : coord_key<"x">            {} x;
constexpr struct angle_     final : coord_key<"angle">        {} angle;
constexpr struct body_      final : pose_3D_key<"body">       {} body;
constexpr struct hairs_     final : internal_key<"bristles">  {} bristles;
constexpr struct motor_     final : input_key<"motor">        {} motor;
constexpr struct ground_    final : frame_2D_key<"ground">    {} ground;
constexpr struct cart_      final : frame_2D_key<"cart">      {} cart;
constexpr struct pole_      final : frame_2D_key<"pole">      {} pole;
constexpr struct tip_       final : frame_2D_key<"tip">       {} tip;
constexpr struct world_     final : frame_3D_key<"world">     {} world;
constexpr struct trunk_     final : frame_3D_key<"trunk">     {} trunk;
constexpr struct hip_       final : frame_3D_key<"hip">       {} hip;
// clang-format on

constexpr double M = 2, m = 0.5, l = 0.75, g = 9.81;
constexpr auto cart_pole = chain(prismatic_joint_2D(x, ground, cart, axis::x), inertia_2D(cart, point_mass(M)),
                                 revolute_joint_2D(angle, cart, pole), rigid_link_2D(pole, tip, along_y(l)),
                                 inertia_2D(tip, point_mass(m)), driving_actuator_gen(x, motor))
                               .gravity(along_y(-g));
/// A free body with a leg; a motor and bristles act on the hip.
constexpr lugre_parameters friction{
    .sigma0 = 50, .sigma1 = 1, .sigma2 = 0.4, .coulomb = 1, .stiction = 1.5, .stribeck_velocity = 0.1};
const auto walker =
    chain(free_joint_3D(body, world, trunk),
          inertia_3D(trunk, rigid_body<>{2.0, {0.01, -0.02, 0.03}, {0.02, 0.001, 0.0, 0.03, 0.0, 0.025}}),
          revolute_joint_3D(angle, trunk, hip, axis::y), inertia_3D(hip, point_mass(0.5, along_z(-0.3))),
          driving_actuator_gen(angle, motor), joint_lugre_gen(angle, bristles, friction))
        .gravity(along_z(-9.81));

double gap(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  REQUIRE(a.rows() == b.rows());
  REQUIRE(a.cols() == b.cols());
  return a.size() == 0 ? 0 : (a - b).cwiseAbs().maxCoeff() / (1 + b.cwiseAbs().maxCoeff());
}
using runtime_model = manipulator_dynamics_model<runtime_chain>;
/// (A B) by their definition: differences of the rate of d.
Eigen::MatrixXd by_differences(runtime_model model, const Eigen::VectorXd& at) {
  const int n = model.rates();
  const Eigen::VectorXd u = model.input();
  return detail::derive_by_differences<double>(
      n, n + static_cast<int>(u.size()), [](int) { return 1.0; },
      [&](int j, double h) -> Eigen::VectorXd {
        Eigen::VectorXd under = u, d = Eigen::VectorXd::Zero(n), moved = at;
        (j < n ? d[j] : under[j - n]) += h;
        model.setInput(under);
        model.displace(at, d, moved);
        Eigen::VectorXd r = model.computeStateRate(0, moved);
        model.pull_back(d, r);
        return r;
      });
}

TEST_CASE("a cart-pole is linearised in closed form, of both kinds of chain") {
  Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
  A(0, 2) = A(1, 3) = 1, A(2, 1) = m * g / M, A(3, 1) = (M + m) * g / (M * l);
  const Eigen::Vector4d B(0, 0, 1 / M, 1 / (M * l));
  const auto check = [&](const auto& model) {
    const auto r = linearize(model, model.make_x(std::array{0.3, 0.0}, std::array{0.0, 0.0}), std::array{0.0});
    CHECK(gap(r.A, A) < 1e-15);
    CHECK(gap(r.B, B) < 1e-15);
    CHECK(r.C == Eigen::Matrix4d::Identity());
    CHECK(r.D == Eigen::Vector4d::Zero());
    CHECK(r.x_dot.norm() == 0);
    CHECK(r.y0 == Eigen::Vector4d(0.3, 0, 0, 0));
  };
  check(manipulator_dynamics_model(cart_pole));
  check(runtime_model(models::registered(record_of(cart_pole))));
}

TEST_CASE("away from an equilibrium too, with all digits") {
  // Its equations by hand, derived in dual numbers of long double.
  const auto rates = [](long double, const auto& s, const auto& u) {
    using std::sin, std::cos;
    auto r = s;
    const auto sine = sin(s[1]), cosine = cos(s[1]);
    r[0] = s[2], r[1] = s[3];
    r[2] = (u[0] + m * sine * (g * cosine - l * s[3] * s[3])) / (M + m * sine * sine);
    r[3] = (r[2] * cosine + g * sine) / l;
    return r;
  };
  const Eigen::Matrix<long double, 4, 1> at(0.3L, 0.8L, 0.5L, -2.0L);
  const auto exact = linearize(rates, at, Eigen::Matrix<long double, 1, 1>(3.0L));
  const manipulator_dynamics_model model(cart_pole);
  const Eigen::Vector4d x0 = at.cast<double>();
  const auto r = linearize(model, x0, std::array{3.0});
  CHECK(gap(r.A, exact.A.cast<double>()) < 1e-15);
  CHECK(gap(r.B, exact.B.cast<double>()) < 1e-15);
  CHECK(gap(r.x_dot, exact.x_dot.cast<double>()) < 1e-15);
}

TEST_CASE("with rotations A is in the tangent space; inputs and internal states by dual numbers") {
  const std::array q{1.0, 2.0, 3.0, 0.5, -0.5, 0.5, 0.5, 0.4};
  const std::array v{0.1, -0.2, 0.3, 0.4, 2.0, -0.6, 0.7};
  const std::array z{0.01};
  const manipulator_dynamics_model model(walker);
  const auto at = model.make_x(q, v, z);
  const auto r = linearize(model, at, std::array{0.3});
  REQUIRE(r.A.rows() == 15);
  REQUIRE(r.C.rows() == 15);  // q has a number more than v, and z is not in y
  runtime_model runtime(models::registered(record_of(walker)));
  const auto same = linearize(runtime, runtime.make_x(q, v, z), std::array{0.3});
  CHECK(gap(same.A, r.A) < 1e-14);
  CHECK(gap(same.B, r.B) < 1e-14);
  CHECK(gap(same.C, r.C) == 0);
  CHECK(gap(same.x_dot, r.x_dot) < 1e-14);
  runtime.input("motor") = 0.3;
  Eigen::MatrixXd both(15, 16);
  both << r.A, r.B;
  CHECK(gap(both, by_differences(runtime, at)) < 1e-11);
  Eigen::Matrix<double, 15, 1> d = Eigen::Matrix<double, 15, 1>::Constant(0.1);
  auto moved = at;
  model.displace(at, d, moved);
  CHECK(gap(displacement(model, at, moved), d) < 1e-14);
}

TEST_CASE("inputs may move what stands on them, and what the mass matrix depends on") {
  runtime_chain c;
  c.gravity(along_y(-g)) << position_control_2D("p", "p'", "p''", "ground", "cart")
                         << revolute_joint_2D("angle", "cart", "pole") << inertia_2D("pole", point_mass(m, along_y(l)))
                         << driving_actuator_gen("angle", "motor");
  const runtime_model shaken(c);
  Eigen::VectorXd u(10);
  u << 0.1, 0.2, 0, 0.3, -0.4, 0, 1.5, -2.5, 0, 0.6;
  const auto r = linearize(shaken, shaken.make_x(std::array{0.4}, std::array{0.7}), u);
  // a = (p''_x cos(angle) + (p''_y + g) sin(angle))/l + torque/(m l^2)
  const double cosine = std::cos(0.4), sine = std::sin(0.4);
  CHECK(r.A(1, 0) == within((-1.5 * sine + (-2.5 + g) * cosine) / l, 1e-13));
  Eigen::RowVectorXd by_u = Eigen::RowVectorXd::Zero(10);
  by_u[6] = cosine / l, by_u[7] = sine / l, by_u[9] = 1 / (m * l * l);
  CHECK(gap(r.B.row(1), by_u) < 1e-14);

  // A slider on a crank whose angle is given: the mass of x depends on the input u.
  runtime_chain two;
  two << prismatic_joint_2D("x", "ground", "cart", axis::x) << inertia_2D("cart", point_mass(M))
      << position_control_gen("u", "u'", "u''", "given") << revolute_joint_2D("given", "cart", "crank")
      << rigid_link_2D("crank", "end", along_x(l)) << prismatic_joint_2D("y", "end", "slider", axis::y)
      << inertia_2D("slider", point_mass(m)) << driving_actuator_gen("x", "push");
  const runtime_model given(two);
  Eigen::VectorXd v(4);
  v << 0.5, 0.3, -2, 7;
  auto set = given;
  set.setInput(v);
  const auto at = given.make_x(std::array{0.1, 0.2}, std::array{0.3, -0.4});
  const auto b = linearize(given, at, v);
  Eigen::MatrixXd both(4, 8);
  both << b.A, b.B;
  CHECK(gap(both, by_differences(set, at)) < 1e-11);
}

TEST_CASE("custom outputs: by dual numbers, of runtime chains by differences") {
  const manipulator_dynamics_model model(cart_pole);
  const auto seen = model.with_output([](const auto& s) { return std::array{s[tip].position.x, s[x].q_ddot}; });
  const std::array q{0.3, 0.8}, v{0.5, -2.0};
  const auto r = linearize(seen, seen.make_x(q, v), std::array{3.0});
  CHECK(r.y0[0] == within(0.3 - l * std::sin(0.8), 1e-15));
  CHECK(gap(r.C.row(0), Eigen::RowVector4d(1, -l * std::cos(0.8), 0, 0)) < 1e-15);
  CHECK(gap(r.C.row(1), r.A.row(2)) < 1e-14);
  CHECK(r.D(0, 0) == 0);
  CHECK(r.D(1, 0) == within(r.B(2, 0), 1e-15));
  const runtime_model runtime(models::registered(record_of(cart_pole)));
  const auto same = linearize(runtime.with_output([](const runtime_state& s) {
    return Eigen::Vector2d(s.frame_2D("tip").position.x, s.coordinate("x").q_ddot);
  }),
                              runtime.make_x(q, v), std::array{3.0});
  CHECK(gap(same.C, r.C) < 1e-11);
  CHECK(gap(same.D, r.D) < 1e-11);
}

TEST_CASE("a closed loop has the matrix of the loop, also where the law has states, or takes numbers alone") {
  const manipulator_dynamics_model model(cart_pole);
  const auto at = model.make_x(std::array{0.3, 0.8}, std::array{0.5, -2.0});
  const Eigen::RowVector4d K(-1, -40, -2, -10);
  const controlled loop(model, [&](double, const auto& state) { return (-(K * (state - at))).eval(); });
  const auto open = linearize(model, at, std::array{0.0});
  const auto r = linearize(loop, at);
  CHECK(gap(r.A, open.A - open.B * K) < 1e-15);
  CHECK(r.B.cols() == 0);
  CHECK(r.x_dot == open.x_dot);
  const std::function<Eigen::VectorXd(double, const Eigen::Vector4d&)> numbers = [&](double, const auto& state) {
    return (-(K * (state - at))).eval();
  };
  CHECK(gap(linearize(controlled(model, numbers), at).A, r.A) < 1e-11);

  const controlled pid(
      model, [](double, const auto& s, const auto& c) { return std::array{-3 * s[0] * s[0] - 7 * c[0]}; },
      [](double, const auto& s, const auto& c) { return std::array{s[1] * c[0]}; }, std::array{0.25});
  const auto p = linearize(pid, pid.make_x(std::array{0.3, 0.8}, std::array{0.5, -2.0}));
  const auto under = linearize(model, at, std::array{-3 * 0.09 - 7 * 0.25});
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(5, 5);
  A.topLeftCorner(4, 4) = under.A;
  A.col(0).head(4) += under.B * (-6 * 0.3);
  A.col(4).head(4) = under.B * -7;
  A(4, 1) = 0.25, A(4, 4) = 0.8;
  CHECK(gap(p.A, A) < 1e-15);
  CHECK(p.x_dot[4] == 0.8 * 0.25);
  CHECK(p.C.cols() == 5);
}

TEST_CASE("any function of x and u is linearised; what does not fit is refused") {
  const auto f = [](double t, const auto& s, const auto& u) {
    using std::sin;
    auto r = s;
    r[0] = s[1] * u[0], r[1] = sin(s[0]) * t;
    return r;
  };
  const Eigen::Vector2d at(0.5, 3);
  const Eigen::Matrix<double, 1, 1> u(2);
  const auto r = linearize(f, at, u, 4.0);
  CHECK(gap(r.A, Eigen::Matrix2d{{0, 2}, {4 * std::cos(0.5), 0}}) < 1e-16);
  CHECK(r.B == Eigen::Vector2d(3, 0));
  CHECK(r.C == Eigen::Matrix2d::Identity());
  const auto numbers = [&](double t, const Eigen::Vector2d& s, const Eigen::Matrix<double, 1, 1>& v) {
    return f(t, s, v);
  };
  const auto h = [](double, const auto& s, const auto& v) { return s[0] * v[0]; };
  const auto d = linearize(numbers, h, at, u, 4.0);
  CHECK(gap(d.A, r.A) < 1e-12);
  CHECK(d.C == Eigen::RowVector2d(2, 0));
  CHECK(d.D(0, 0) == 0.5);
  CHECK_THROWS_MATCHES(linearize([](double, const auto& s, const auto&) { return s[0]; }, at, u), bad_argument,
                       test::says("f gives 1 rates, the state has 2 numbers"));
  const auto root = [](double, const auto& s, const auto&) {
    using std::sqrt;
    auto q = s;
    q[0] = sqrt(s[0]);
    return q;
  };
  CHECK_THROWS_MATCHES(linearize(root, Eigen::Vector2d(0, 1), u), bad_argument,
                       test::says("a derivative of the function is not finite"));
  const manipulator_dynamics_model model(cart_pole);
  CHECK_THROWS_MATCHES(linearize(model, Eigen::VectorXd::Zero(3), std::array{0.0}), bad_argument,
                       test::says("x has 3 numbers"));
  CHECK_THROWS_MATCHES(linearize(model, Eigen::Vector4d::Zero(), std::vector{0.0, 0.0}), bad_argument,
                       test::says("u has 2 numbers"));
  CHECK_THROWS_AS(linearize(model, Eigen::Vector4d(std::nan(""), 0, 0, 0), std::array{0.0}), bad_argument);
  CHECK_THROWS_MATCHES(displacement(model, Eigen::Vector4d::Zero(), Eigen::VectorXd::Zero(5)), bad_argument,
                       test::says("x has 5 numbers"));
}

}  // namespace linearize_test
