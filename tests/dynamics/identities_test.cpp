#include "catch.hpp"
#include "chain/models.hpp"
#include "digits50.hpp"
#include "eigenvalues.hpp"
#include "random.hpp"
#include "robots/iiwa14.hpp"

// The algorithms against each other.

using models::element_by_element, models::hand, models::pendulum, models::tree;
using big = kte::test::digits50;

namespace {

template <class S, int N>
kte::joint_vector<S, N> random_vector(random_numbers& random, double size) {
  kte::joint_vector<S, N> x;
  for (auto& e : x) e = S(random(size));
  return x;
}

/// Columns of M by inverse dynamics, and forward dynamics after inverse dynamics.
template <class Chain>
void check_identities(const Chain& c, unsigned seed) {
  constexpr int n = Chain::dofs;
  using V = kte::joint_vector<double, n>;
  random_numbers random(seed);
  for (int round = 0; round < 200; ++round) {
    const V q = random_vector<double, n>(random, 3), v = random_vector<double, n>(random, 2),
            a = random_vector<double, n>(random, 5);
    const auto M = kte::mass_matrix(c, q);
    const V rest = kte::inverse_dynamics(c, q, v, V(V::Zero()));
    const double size = std::max(rest.cwiseAbs().maxCoeff(), M.cwiseAbs().maxCoeff());
    for (int j = 0; j < n; ++j) {
      const V column = kte::inverse_dynamics(c, q, v, V(V::Unit(j))) - rest;
      // The difference of two sums of size `size`, each of about ten roundings.
      CHECK((column - M.col(j)).cwiseAbs().maxCoeff() < 20 * 2.2e-16 * size);
    }
    CHECK(M == M.transpose());
    const V tau = kte::inverse_dynamics(c, q, v, a);
    const V again = kte::forward_dynamics(c, q, v, tau);
    // A solve loses the condition of M at most.
    const Eigen::VectorXd eigenvalues = kte::test::eigenvalues_of(M);
    CHECK(eigenvalues[0] > 0);
    const double condition = eigenvalues[n - 1] / eigenvalues[0];
    CHECK((again - a).norm() < 20 * 2.2e-16 * condition * std::max(a.norm(), tau.norm() / eigenvalues[n - 1]));
  }
}

}  // namespace

TEST_CASE("mass matrix by columns, forward dynamics after inverse dynamics", "[laws]") {
  check_identities(pendulum, 1);
  check_identities(tree, 2);
  check_identities(robots::iiwa14, 3);
}

TEST_CASE("static and runtime algorithms agree") {
  const auto model = element_by_element(tree);
  auto s = model.make_state();
  random_numbers random(4);
  for (int round = 0; round < 100; ++round) {
    const auto q = random_vector<double, 3>(random, 3), v = random_vector<double, 3>(random, 2),
               x = random_vector<double, 3>(random, 9);
    const auto close = [](const auto& a, const auto& b) { return (a - b).norm() <= 20 * 2.2e-16 * (1 + a.norm()); };
    CHECK(close(kte::inverse_dynamics(tree, q, v, x), kte::inverse_dynamics(model, s, q, v, x)));
    CHECK(close(kte::mass_matrix(tree, q), kte::mass_matrix(model, s, q)));
    const auto a = kte::forward_dynamics(tree, q, v, x);
    CHECK((a - kte::forward_dynamics(model, s, q, v, x)).norm() < 1e-13 * a.norm());  // condition of M: 200
    const auto p = kte::forward_kinematics(tree, q, hand), r = kte::forward_kinematics(model, s, q, "hand");
    CHECK((to_eigen(p.position) - to_eigen(r.position)).norm() < 1e-15);
  }
}

namespace {

/// v . (tau - tau at rest) = damping + d/dt (v M v / 2): all velocity terms in one equation. Returns the relative gap.
/// Central differences with h = 1e-12 err by h^2 = 1e-24, and lose 1e-50/h = 1e-38.
template <class Chain, class Damping>
double power_gap(const Chain& c, random_numbers& random, const Damping& damping) {
  constexpr int n = Chain::dofs;
  using V = kte::joint_vector<big, n>;
  const V q = random_vector<big, n>(random, 3), v = random_vector<big, n>(random, 2),
          a = random_vector<big, n>(random, 5);
  const V zeros = V::Zero();
  const auto kinetic = [&](const big& t) {
    const V qt = q + v * t + a * (t * t / 2), vt = v + a * t;
    return big(vt.dot(kte::mass_matrix(c, qt) * vt) / 2);
  };
  const big h = 1e-12;
  const big change = (kinetic(h) - kinetic(-h)) / (2 * h);
  const V work = kte::inverse_dynamics(c, q, v, a) - kte::inverse_dynamics(c, q, zeros, zeros);
  return static_cast<double>(abs(v.dot(work) - damping(v) - change) / (1 + abs(change)));
}

}  // namespace

TEST_CASE("power balance at 50 digits") {
  random_numbers random(5);
  for (int round = 0; round < 5; ++round) {
    CHECK(power_gap(robots::iiwa14, random, [](const auto&) { return big(0); }) < 1e-21);
    // The axis (0.6, 0, 0.8) of the tree is a unit vector to half an eps only.
    CHECK(power_gap(tree, random, [](const auto& v) { return big(0.8 * (v[0] - v[2]) * (v[0] - v[2])); }) < 1e-15);
  }
}

TEST_CASE("double precision against the same templates at 50 digits") {
  random_numbers random(6);
  for (int round = 0; round < 20; ++round) {
    const auto q = random_vector<double, 7>(random, 3), v = random_vector<double, 7>(random, 2),
               a = random_vector<double, 7>(random, 5);
    const auto up = [](const auto& x) { return kte::joint_vector<big, 7>(x.template cast<big>()); };
    const auto error = [](const auto& x, const auto& exact) {
      big difference = 0, size = 0;
      for (Eigen::Index i = 0; i < exact.size(); ++i) {
        difference = kte::test::worse(difference, big(abs(big(x.data()[i]) - exact.data()[i])));
        size = std::max(size, big(abs(exact.data()[i])));
      }
      return static_cast<double>(difference / size);
    };
    const auto& c = robots::iiwa14;
    CHECK(error(kte::inverse_dynamics(c, q, v, a), kte::inverse_dynamics(c, up(q), up(v), up(a))) < 1e-15);
    CHECK(error(kte::mass_matrix(c, q), kte::mass_matrix(c, up(q))) < 1e-15);
    CHECK(error(kte::forward_dynamics(c, q, v, a), kte::forward_dynamics(c, up(q), up(v), up(a))) <
          1e-13);  // any state
  }
}
