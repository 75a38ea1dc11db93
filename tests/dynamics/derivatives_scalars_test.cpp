#include <kte/dynamics/derivatives.hpp>

#include "catch.hpp"
#include "chain/models.hpp"
#include "digits50.hpp"

// Derivatives of the dynamics in scalars other than double, dual numbers among them.

namespace derivatives_scalars_test {

using namespace kte;

inline constexpr struct ball_ final : rotation_3D_key<"ball"> {
} ball;
/// A revolute and a ball joint.
constexpr auto arm = chain(revolute_joint_3D(models::hip, models::ground, models::trunk, axis::x),
                           inertia_3D(models::trunk, point_mass(0.5, vec3{0.25, 0.5, 0.0})),
                           rigid_link_3D(models::trunk, models::left, along_y(0.5)),
                           spherical_joint_3D(ball, models::left, models::hand),
                           inertia_3D(models::hand, rigid_body{1.5, vec3{0.125, -0.25, 0.0625},
                                                               sym3{0.25, 0.03125, -0.0625, 0.1875, 0.015625, 0.1875}}))
                         .gravity(along_z(-9.75));

/// All derivatives of a chain as S and as T: the largest difference, relative to the largest number of its matrix.
template <class S, class T, class Chain>
double gap_between(const Chain& c) {
  constexpr int n = Chain::dofs, nq = Chain::nq;
  const auto numbers = []<class X, int N>(std::integral_constant<int, N>, const X&, double first) {
    joint_vector<X, N> x;
    for (int i = 0; i < N; ++i) x[i] = X(first + 0.375 * i);  // exact in float
    return x;
  };
  const auto both = [&](const auto& f) {
    const auto at = [&](const auto& one) {
      return f(numbers(std::integral_constant<int, nq>{}, one, 0.5),
               numbers(std::integral_constant<int, n>{}, one, -0.75),
               numbers(std::integral_constant<int, n>{}, one, 1.25));
    };
    return std::pair{at(S(1)), at(T(1))};
  };
  double worst = 0;
  const auto compare = [&](const auto& x, const auto& y) {
    T most = 0, size = 0;
    for (Eigen::Index i = 0; i < y.size(); ++i) {
      const T d = T(x.data()[i]) - y.data()[i], e = d < 0 ? T(-d) : d, z = y.data()[i];
      most = test::worse(most, e);
      size = std::max(size, z < 0 ? T(-z) : z);
    }
    worst = test::worse(worst, static_cast<double>(T(most / size)));
  };
  const auto [x, y] = both([&](const auto&... z) { return inverse_dynamics_derivatives(c, z...); });
  compare(x.tau, y.tau), compare(x.by_q, y.by_q), compare(x.by_v, y.by_v), compare(x.by_a, y.by_a);
  const auto [f, g] = both([&](const auto&... z) { return forward_dynamics_derivatives(c, z...); });
  compare(f.a, g.a), compare(f.by_q, g.by_q), compare(f.by_v, g.by_v), compare(f.by_tau, g.by_tau);
  return worst;
}

TEST_CASE("derivatives in other scalars") {
  using big = kte::test::digits50;
  // Element by element, and by dual numbers: sums over two or three bodies, some eps of the worse of the two.
  CHECK(gap_between<float, double>(arm) < 20 * std::numeric_limits<float>::epsilon());
  CHECK(gap_between<double, long double>(arm) < 20 * std::numeric_limits<double>::epsilon());
  CHECK(gap_between<long double, big>(arm) < 20 * static_cast<double>(std::numeric_limits<long double>::epsilon()));
  CHECK(gap_between<float, double>(models::tree) < 20 * std::numeric_limits<float>::epsilon());
  CHECK(gap_between<double, long double>(models::tree) < 20 * std::numeric_limits<double>::epsilon());
}

TEST_CASE("second derivatives by dual numbers") {
  // tau = m l^2 a + m g l cos q, with m l^2 = 1/4 and m g l = 4 under gravity 8.
  const auto c = models::pendulum.gravity(along_y(-8.0));
  using number = dual<double, 1>;
  std::array<number, 1> q{number(0.5)}, v{number(3.0)}, a{number(2.0)};
  q[0].derivative[0] = 1;
  const auto r = inverse_dynamics_derivatives(c, q, v, a);
  CHECK(r.tau[0].derivative[0] == within_relative(-4 * std::sin(0.5), 1e-15));
  CHECK(r.by_q(0, 0).value == within_relative(-4 * std::sin(0.5), 1e-15));
  CHECK(r.by_q(0, 0).derivative[0] == within_relative(-4 * std::cos(0.5), 1e-15));
  CHECK(r.by_a(0, 0).derivative[0] == 0);
  const auto f = forward_dynamics_derivatives(c, q, v, a);
  CHECK(f.by_q(0, 0).value == within_relative(16 * std::sin(0.5), 1e-15));
  CHECK(f.by_q(0, 0).derivative[0] == within_relative(16 * std::cos(0.5), 1e-15));
}

}  // namespace derivatives_scalars_test
