#include <kte/dynamics/relative_motion.hpp>
#include <kte/elements/line_point_mindist.hpp>

#include <limits>

#include "dynamics/small_chains.hpp"
#include "static_models/static_model.hpp"

namespace relative_motion_test {

// Motion of one frame in another: against their motions in the world, against the Jacobian, static against runtime.

using namespace kte;
using namespace kte::test;
using namespace kte::test::small_chains;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double rounding = 200 * eps;  // as for rates of Jacobians: motions along at most 8 poses, twice

template <class S>
Eigen::Matrix<S, 6, 1> rates_of(const dense_motion<S>& m) {
  return eigen(linear_angular<S>{m.velocity, m.ang_velocity});
}

/// The functions under test of two frames of a static chain.
struct functions {
  using vector = Eigen::VectorXd;
  pose<mat3<vec3<>>, vec3<>> (*pose)(const vector& q);
  Eigen::MatrixXd (*jacobian)(const vector& q);
  dense_motion<double> (*motion)(const vector& q, const vector& v, const vector& a);
};
template <const auto& Chain, const auto& B, const auto& A>
constexpr functions functions_of{
    [](const auto& q) {
      const auto p = relative_pose(Chain, q, B, A);
      return pose<mat3<vec3<>>, vec3<>>{p.rotation, p.position};
    },
    [](const auto& q) -> Eigen::MatrixXd { return relative_jacobian(Chain, q, B, A); },
    [](const auto& q, const auto& v, const auto& a) { return relative_motion(Chain, q, v, a, B, A); }};

/// `f` of the frame b in a, and of a in b.
void check(const functions& f, const functions& reverse, const runtime_chain& c, std::string_view b, std::string_view a,
           unsigned seed) {
  auto s = c.make_state();
  random_numbers random(seed);
  for (int round = 0; round < 3; ++round) {
    const random_motion<double> m(c, random);
    const auto x = f.motion(m.q, m.v, m.a);
    const auto j = f.jacobian(m.q);
    CHECK(gap(j * m.v, rates_of(x)) < rounding);
    const auto p = f.pose(m.q);
    CHECK(gap(eigen(p.position), eigen(x.position)) < rounding);
    CHECK(gap(to_eigen<double>(p.rotation), to_eigen<double>(x.rotation)) < rounding);
    // The motion of A in B is the other way round.
    const auto back = compose(x, reverse.motion(m.q, m.v, m.a));
    CHECK(gap(eigen(back.acceleration), Eigen::Vector3d::Zero()) < rounding * 100);  // of numbers below 100
    // By differences of the pose and of the rates.
    const double h = 1e-5;
    const auto at = [&](double t) { return f.pose(integrate(c, m.q, m.v + m.a * (t / 2), t)); };
    const Eigen::Vector3d v = (eigen(at(h).position) - eigen(at(-h).position)) / (2 * h);
    CHECK(gap(eigen(vec3<>(x.rotation * x.velocity)), v) < 1e-7);
    // Runtime.
    CHECK(gap(relative_jacobian(c, s, m.q, b, a), j) < rounding);
    CHECK(gap(relative_jacobian(c, s, b, a), j) < rounding);
    const auto y = relative_motion(c, s, m.q, m.v, m.a, b, a);
    CHECK(gap(rates_of(y), rates_of(x)) < rounding);
    CHECK(gap(eigen(y.acceleration), eigen(x.acceleration)) < rounding);
    CHECK(gap(eigen(y.ang_acceleration), eigen(x.ang_acceleration)) < rounding);
    CHECK(gap(rates_of(relative_motion(c, s, b, a)), rates_of(y)) == 0);
    CHECK(gap(eigen(relative_pose(c, s, m.q, b, a).position), eigen(p.position)) < rounding);
    CHECK(gap(eigen(relative_pose(c, s, b, a).position), eigen(p.position)) < rounding);
  }
}
template <const auto& Chain, const auto& B, const auto& A>
void check(unsigned seed) {
  check(functions_of<Chain, B, A>, functions_of<Chain, A, B>, models::element_by_element(Chain), B.name, A.name, seed);
}

TEST_CASE("relative motion of frames by identities, differences and runtime chains") {
  check<floating, tip, aside>(1);    // on two branches
  check<floating, hand, tip>(2);     // the one on the other
  check<floating, body, ground>(3);  // a frame in its base
  check<planar, disc, cart>(4);
  check<geared, palm, hand>(5);
}

TEST_CASE("relative Jacobians have zeros for what moves both frames") {
  const auto q = random_configuration<double>(floating, *std::make_unique<random_numbers>(6));
  const auto j = relative_jacobian(floating, q, tip, aside);
  CHECK(j.leftCols<6>().isZero(0));  // of the trunk
  const auto model = models::element_by_element(floating);
  auto s = model.make_state();
  CHECK(relative_jacobian(model, s, q, "tip", "aside").leftCols(6).isZero(0));
  CHECK(relative_jacobian(floating, q, tip, tip).isZero(0));
  CHECK(relative_jacobian(model, s, q, "tip", "tip").isZero(0));
}

TEST_CASE("relative motion of frames on different bases") {
  runtime_chain c;
  c << base_2D("other") << revolute_joint_2D("q1", "one", "a") << prismatic_joint_2D("q2", "other", "b", axis::x);
  auto s = c.make_state();
  s.frame_2D("other").position = {1.0, 2.0};
  const std::array q{0.0, 0.5}, v{1.0, 3.0}, a{0.0, 0.0};
  const auto m = relative_motion(c, s, q, v, a, "b", "a");
  CHECK(m.position.x == within(1.5, eps));
  CHECK(m.position.y == within(2.0, eps));
  // In axes that turn by 1 rad/s the point moves by (3, 0) - w x p.
  CHECK(m.velocity.x == within(3 + 2, 4 * eps));
  CHECK(m.velocity.y == within(-1.5, 4 * eps));
  const Eigen::VectorXd rates = relative_jacobian(c, s, q, "b", "a") * Eigen::Vector2d(1, 3);
  CHECK(rates[0] == within(5, 4 * eps));
  CHECK(rates[1] == within(-1.5, 4 * eps));
  CHECK(rates[5] == -1);
}

TEST_CASE("relative motion of bad arguments") {
  const auto model = models::element_by_element(planar);
  auto s = model.make_state();
  const std::array<double, 4> q{0.1, 0.2, 0.3, 0.4}, nan{0.1, 0.2, 0.3, std::numeric_limits<double>::quiet_NaN()};
  CHECK_THROWS_AS(relative_pose(model, s, q, "disc", "crt"), unknown_name);
  CHECK_THROWS_AS(relative_jacobian(model, s, q, "dsc", "cart"), unknown_name);
  CHECK_THROWS_AS(relative_motion(model, s, q, q, q, "q1", "cart"), unknown_name);
  CHECK_THROWS_AS(relative_jacobian(planar, nan, disc, cart), bad_argument);
  CHECK_THROWS_AS(relative_motion(planar, q, nan, q, disc, cart), bad_argument);
  CHECK_THROWS_AS(relative_motion(model, s, q, q, nan, "disc", "cart"), bad_argument);
}

TEST_CASE("relative motion of frames that follow others: Jacobians are refused") {
  static constexpr struct near_ final : frame_2D_key<"near"> {
  } near;
  constexpr auto c = chain(revolute_joint_2D(q1, table, cart), rigid_link_2D(cart, rail, along_x(0.75)),
                           line_point_mindist_2D(rail, near, vec2{1.0, 0.0}, vec2{0.0, 0.0}));
  runtime_chain model;
  model << c;
  auto s = model.make_state();
  const std::array q{0.3}, v{2.0}, a{0.0};
  const auto p = relative_pose(c, q, near, table), r = relative_pose(model, s, q, "near", "table");
  CHECK(p.position.x == within(0.75 * std::cos(0.3), eps));
  CHECK(r.position.x == within(0.75 * std::cos(0.3), eps));
  CHECK(gap(rates_of(relative_motion(model, s, q, v, a, "near", "cart")),
            rates_of(relative_motion(c, q, v, a, near, cart))) < rounding);
  CHECK_THROWS_MATCHES(relative_jacobian(model, s, q, "near", "table"), bad_argument, says("'near' follows others"));
  CHECK_THROWS_MATCHES(jacobian_rate(model, s, q, v, "near"), bad_argument, says("'near' follows others"));
  // By dual numbers static chains know that rate.
  const double h = 1e-5;
  const Eigen::Matrix<double, 6, 1> rate =
      (jacobian(c, std::array{0.3 + 2 * h}, near) - jacobian(c, std::array{0.3 - 2 * h}, near)) / (2 * h);
  CHECK(gap(jacobian_rate(c, q, v, near), rate) < 1e-7);
}

}  // namespace relative_motion_test
