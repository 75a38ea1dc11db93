#include <kte/dynamics/derivatives.hpp>

#include "catch.hpp"
#include "chain/models.hpp"
#include "data/solo12.hpp"
#include "dynamics/matrix_error.hpp"
#include "robots/solo12.hpp"

// Derivatives of the dynamics of a robot that floats against 21 digits, a pendulum by hand, and errors. Arms are in
// derivatives_robots_test.cpp, chains with everything in derivatives_tree_test.cpp.

namespace derivatives_test {

using namespace kte;
using kte::test::error_of;

constexpr long double eps = std::numeric_limits<double>::epsilon();

/// Forces -2 a and -5 b a on the coordinates a, b.
struct pair_of_springs {
  static constexpr std::string_view type = "pair_of_springs_gen";
  static constexpr std::array<port, 2> ports{{{kind::gen, access::on, "a"}, {kind::gen, access::on, "b"}}};
  template <class A, class B>
  constexpr auto doForce(const A& a, const B& b) const {
    return make_loads(-2.0 * a.q, -5.0 * b.q * a.q);
  }
  constexpr void check(const parameter_check&) const {}
  template <class Self, class Visit>
  static constexpr void parameters(Self&, Visit&&) {}
};

TEST_CASE("an element with both ports on one coordinate is derived by it once, in a static chain") {
  constexpr auto c = chain(revolute_joint_2D(models::q, models::base, models::joint),
                           rigid_link_2D(models::joint, models::tip, along_x(1.0)),
                           inertia_2D(models::tip, point_mass(1.0)), connect(pair_of_springs{}, models::q, models::q));
  const std::array q{2.0}, none{0.0};
  const auto r = inverse_dynamics_derivatives(c, q, none, none);
  CHECK(r.tau[0] == 2 * 2 + 5 * 2 * 2);
  CHECK(r.by_q(0, 0) == 2 + 2 * 5 * 2);
}

TEST_CASE("derivatives of the solo12, which floats, against 21 digits") {
  // Bounds as in derivatives_robots_test.cpp. Measured 3.9e-16 for inverse dynamics; 1.8e-15 for forward dynamics,
  // which may lose the condition of M scaled to a diagonal of ones.
  STATIC_REQUIRE(detail::is_analytical<std::remove_const_t<decltype(robots::solo12)>>);
  constexpr long double inverse = 1e-15L, forward = (4 + 18) * eps;
  constexpr int n = 18;
  using vector = joint_vector<double, n>;
  const auto& c = robots::solo12;
  const auto& x = reference::solo12[0];
  const auto& y = reference::solo12_derivatives[0];
  const joint_vector<double, n + 1> q(x.q);
  const vector v(x.v), a(x.a), tau(x.tau);
  const auto r = inverse_dynamics_derivatives(c, q, v, a);
  CHECK(error_of(r.by_q, y.dtau_dq) < inverse);
  CHECK(error_of(r.by_v, y.dtau_dv) < inverse);
  CHECK(error_of(r.tau, x.inverse_dynamics) < inverse);
  long double mass[n * n];
  for (int i = 0, place = 0; i < n; ++i)
    for (int j = i; j < n; ++j) mass[i * n + j] = mass[j * n + i] = x.mass_matrix[place++];
  CHECK(error_of(r.by_a, mass) < inverse);
  CHECK(r.by_a == joint_matrix<double, n>(r.by_a.transpose()));
  // Where the trunk is does not matter to any force, nor one leg to another.
  CHECK(r.by_q.leftCols<3>().cwiseAbs().maxCoeff() == 0);
  CHECK(r.by_q.block<3, 3>(6, 9).cwiseAbs().maxCoeff() == 0);
  CHECK(r.by_v.block<3, 9>(6, 9).cwiseAbs().maxCoeff() == 0);

  const auto f = forward_dynamics_derivatives(c, q, v, tau);
  CHECK(f.a == forward_dynamics(c, q, v, tau));
  CHECK(error_of(f.by_q, y.ddq_dq) < forward);
  CHECK(error_of(f.by_v, y.ddq_dv) < forward);
  CHECK(error_of(f.by_tau, y.ddq_dtau) < forward);

  // The length of a quaternion does not matter. Two numbers with errors: twice the bound.
  auto longer = q;
  longer.segment<4>(3) *= -1.5;
  const auto same = inverse_dynamics_derivatives(c, longer, v, a);
  const auto close = [](const auto& m, const auto& k) {
    return (m - k).cwiseAbs().maxCoeff() < 2e-15 * k.cwiseAbs().maxCoeff();
  };
  CHECK(close(same.tau, r.tau));
  CHECK(close(same.by_q, r.by_q));
  CHECK(close(same.by_v, r.by_v));
  CHECK(close(same.by_a, r.by_a));
}

TEST_CASE("the pendulum by hand") {
  // tau = m l^2 a + m g l cos q, with m l^2 = 1/4 and m g l = 4 under gravity 8.
  const auto c = models::pendulum.gravity(along_y(-8.0));
  const std::array q{0.5}, v{3.0}, a{2.0};
  const auto r = inverse_dynamics_derivatives(c, q, v, a);
  CHECK(r.tau[0] == within_relative(0.5 + 4 * std::cos(0.5), 1e-15));
  CHECK(r.by_q(0, 0) == within_relative(-4 * std::sin(0.5), 1e-15));
  CHECK(std::abs(r.by_v(0, 0)) < 1e-15);
  CHECK(r.by_a(0, 0) == 0.25);
  const auto f = forward_dynamics_derivatives(c, q, v, a);
  CHECK(f.a[0] == within_relative(8 - 16 * std::cos(0.5), 1e-15));
  CHECK(f.by_q(0, 0) == within_relative(16 * std::sin(0.5), 1e-15));
  CHECK(std::abs(f.by_v(0, 0)) < 4e-15);
  CHECK(f.by_tau(0, 0) == 4);
}

TEST_CASE("what has no derivatives") {
  constexpr auto c =
      chain(revolute_joint_2D(models::q, models::base, models::joint),
            rigid_link_2D(models::joint, models::tip, vec2{0.5, 0.25}), inertia_2D(models::tip, point_mass(1.0)));
  const std::array x{0.5};
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const std::array none{bad};
    CHECK_THROWS_AS(inverse_dynamics_derivatives(c, none, x, x), bad_argument);
    CHECK_THROWS_AS(inverse_dynamics_derivatives(c, x, none, x), bad_argument);
    CHECK_THROWS_AS(inverse_dynamics_derivatives(c, x, x, none), bad_argument);
    CHECK_THROWS_AS(forward_dynamics_derivatives(c, none, x, x), bad_argument);
    CHECK_THROWS_AS(forward_dynamics_derivatives(c, x, none, x), bad_argument);
    CHECK_THROWS_AS(forward_dynamics_derivatives(c, x, x, none), bad_argument);
    auto s = make_state(c);
    s[models::q].q = bad;
    CHECK_THROWS_AS(inverse_dynamics_derivatives(c, s), bad_argument);
    CHECK_THROWS_AS(forward_dynamics_derivatives(c, s), bad_argument);
  }
  const std::vector<double> one{0.5}, two{0.5, 0.5};
  CHECK_THROWS_AS(inverse_dynamics_derivatives(c, two, one, one), bad_argument);
  CHECK_THROWS_AS(inverse_dynamics_derivatives(c, one, two, one), bad_argument);
  CHECK_THROWS_AS(inverse_dynamics_derivatives(c, one, one, two), bad_argument);
  CHECK_THROWS_AS(forward_dynamics_derivatives(c, one, one, two), bad_argument);

  // Nothing to move: inverse dynamics can be derived, forward dynamics cannot.
  constexpr auto massless =
      chain(revolute_joint_2D(models::q, models::base, models::joint), inertia_2D(models::joint, point_mass(1.0)));
  const auto r = inverse_dynamics_derivatives(massless, x, x, x);
  CHECK(r.by_a(0, 0) == 0);
  CHECK(r.by_q(0, 0) == 0);
  CHECK_THROWS_AS(forward_dynamics_derivatives(massless, x, x, x), singular_mass_matrix);
  CHECK_THROWS_AS(forward_dynamics_derivatives(massless, make_state(massless)), singular_mass_matrix);
}

}  // namespace derivatives_test
