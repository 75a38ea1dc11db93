#include <kte/dynamics/jacobian_rate.hpp>

#include <limits>

#include "dynamics/small_chains.hpp"
#include "dynamics/square.hpp"
#include "static_models/static_model.hpp"

namespace jacobian_rate_test {

// Rates of Jacobians: a formula, differences, identities with accelerations, static against runtime.

using namespace kte;
using namespace kte::test;
using namespace kte::test::small_chains;

constexpr double eps = std::numeric_limits<double>::epsilon();
/// Columns are sums of products along at most 8 poses, their rates of as many with rates below 10.
constexpr double rounding = 200 * eps;

/// The functions under test of a frame of a static chain.
struct functions {
  using vector = Eigen::VectorXd;
  Eigen::MatrixXd (*jacobian)(const vector& q);
  Eigen::MatrixXd (*rate)(const vector& q, const vector& v);
  vector (*bias)(const vector& q, const vector& v);
};
template <const auto& Chain, const auto& Frame, class Axes>
constexpr functions functions_of{
    [](const auto& q) -> Eigen::MatrixXd { return jacobian(Chain, q, Frame, Axes()); },
    [](const auto& q, const auto& v) -> Eigen::MatrixXd { return jacobian_rate(Chain, q, v, Frame, Axes()); },
    [](const auto& q, const auto& v) -> Eigen::VectorXd {
      return eigen(bias_acceleration(Chain, q, v, Frame, Axes()));
    }};

template <class Axes>
void check_axes(const functions& f, const runtime_chain& c, std::string_view frame, unsigned seed, Axes axes) {
  auto s = c.make_state();
  random_numbers random(seed);
  for (int round = 0; round < 3; ++round) {
    const random_motion<double> m(c, random);
    const auto j = f.jacobian(m.q), rate = f.rate(m.q, m.v);
    const Eigen::MatrixXd r = jacobian_rate(c, s, m.q, m.v, frame, axes);
    CHECK(gap(r, rate) < rounding);
    CHECK(gap(jacobian_rate(c, s, frame, axes), r) == 0);
    if constexpr (!std::is_same_v<Axes, in_own_axes_t>) CHECK(gap(jacobian(c, s, m.q, frame, axes), j) < rounding);
    // dJ/dt v, of passes.
    const auto bias = f.bias(m.q, m.v);
    CHECK(gap(rate * m.v, bias) < rounding);
    CHECK(gap(eigen(bias_acceleration(c, s, m.q, m.v, frame, axes)), bias) < rounding);
    // Central differences: h^2 f'''/6 of numbers below 1e3, and eps/h.
    const double h = 1e-5;
    const auto at = [&](double t) { return f.jacobian(integrate(c, m.q, m.v, t)); };
    CHECK(gap((at(h) - at(-h)) / (2 * h), rate) < 1e-7);
  }
}
template <const auto& Chain, const auto& Frame>
void check(unsigned seed) {
  const auto c = models::element_by_element(Chain);
  check_axes(functions_of<Chain, Frame, in_own_axes_t>, c, Frame.name, seed, in_own_axes);
  check_axes(functions_of<Chain, Frame, in_world_axes_t>, c, Frame.name, seed + 1, in_world_axes);
  check_axes(functions_of<Chain, Frame, at_world_origin_t>, c, Frame.name, seed + 2, at_world_origin);
}

TEST_CASE("rate of the Jacobian of a point on a wheel, by its formula") {
  // p = (l cos q, l sin q): in own axes J = (0, l, 1) for ever; in the world (-l sin q, l cos q), and 0 at the origin.
  constexpr auto c = chain(revolute_joint_2D(q1, table, cart), rigid_link_2D(cart, rail, along_x(0.5)));
  const std::array q{0.3}, v{2.0};
  CHECK(jacobian_rate(c, q, v, rail).isZero(0));
  const auto rate = jacobian_rate(c, q, v, rail, in_world_axes);
  CHECK(rate(0, 0) == within(-0.5 * 2.0 * std::cos(0.3), eps));
  CHECK(rate(1, 0) == within(-0.5 * 2.0 * std::sin(0.3), eps));
  CHECK(jacobian(c, q, rail, at_world_origin).topRows<2>().norm() == within(0, eps));
  CHECK(jacobian_rate(c, q, v, rail, at_world_origin).norm() == within(0, 2 * eps));
  const auto bias = bias_acceleration(c, q, v, rail);
  CHECK(bias.linear.x == within(0, 4 * eps));  // -l v^2 is there in the world alone
  CHECK(bias_acceleration(c, q, v, rail, in_world_axes).linear.x == within(-0.5 * 4 * std::cos(0.3), 4 * eps));
}

TEST_CASE("rates of Jacobians by differences and accelerations, static and runtime") {
  check<floating, tip>(1);
  check<floating, aside>(2);
  check<planar, disc>(3);
  check<geared, palm>(4);
}

TEST_CASE("rate of a Jacobian whose coordinate follows another by a ratio that changes") {
  static constexpr auto c = chain(revolute_joint_3D(q1, ground, body, axis::x), connect(square{}, q1, f1),
                                  prismatic_joint_3D(f1, body, hand, axis::y));
  runtime_chain model;
  model << c;
  check_axes(functions_of<c, hand, in_own_axes_t>, model, "hand", 5, in_own_axes);
  check_axes(functions_of<c, hand, at_world_origin_t>, model, "hand", 6, at_world_origin);
}

TEST_CASE("rates of Jacobians where the base moves") {
  // A base in a state that does what a free joint does.
  constexpr auto c = chain(free_joint_3D(trunk, ground, body), revolute_joint_3D(q1, body, hand, axis::x),
                           rigid_link_3D(hand, tip, vec3{0.1, 0.2, 0.3}));
  runtime_chain model;
  model << revolute_joint_3D("q1", "body", "hand", axis::x) << rigid_link_3D("hand", "tip", vec3{0.1, 0.2, 0.3});
  random_numbers random(7);
  const random_motion_of<double, std::remove_const_t<decltype(c)>> m(c, random);
  auto all = make_state(c);
  set_positions(all, m.q), set_velocities(all, m.v);
  c.doMotion(all);
  auto s = model.make_state();
  s.frame_3D("body") = all[body];
  s.coordinate("q1").q = m.q[7], s.coordinate("q1").q_dot = m.v[6];
  const auto check_last = [&](auto axes) {
    const auto expected = jacobian_rate(c, m.q, m.v, tip, axes);
    const Eigen::MatrixXd rate = jacobian_rate(model, s, "tip", axes);
    CHECK(gap(rate, expected.template rightCols<1>()) < rounding);
  };
  check_last(in_own_axes), check_last(in_world_axes), check_last(at_world_origin);
}

TEST_CASE("rates of Jacobians of bad arguments") {
  const auto model = models::element_by_element(planar);
  auto s = model.make_state();
  const std::array<double, 4> q{0.1, 0.2, 0.3, 0.4}, v{1, 2, 3, 4};
  CHECK_THROWS_AS(jacobian_rate(model, s, q, v, "dsc"), unknown_name);
  CHECK_THROWS_AS(bias_acceleration(model, s, q, v, "q1"), unknown_name);
  CHECK_THROWS_AS(jacobian(model, s, q, "dsc", at_world_origin), unknown_name);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    auto w = v;
    w[2] = bad;
    CHECK_THROWS_AS(jacobian_rate(planar, q, w, disc), bad_argument);
    CHECK_THROWS_AS(jacobian_rate(model, s, q, w, "disc"), bad_argument);
    CHECK_THROWS_AS(bias_acceleration(planar, q, w, disc), bad_argument);
    CHECK_THROWS_AS(bias_acceleration(model, s, q, w, "disc"), bad_argument);
  }
  CHECK_THROWS_AS(jacobian_rate(planar, q, std::vector<double>(3), disc), bad_argument);
}

}  // namespace jacobian_rate_test
