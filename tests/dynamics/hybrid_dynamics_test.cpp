#include <kte/dynamics/hybrid_dynamics.hpp>

#include "dynamics/trees.hpp"

// Hybrid dynamics against the equations of motion M a + bias = tau, solved for what is not known in long double.

namespace hybrid_dynamics_test {

using namespace kte;
using namespace kte::test::trees;

void mark(gen_coord<double>& x) { x.q_ddot = 1; }
template <class X>
void mark(X& x) {
  if constexpr (requires { x.acceleration; }) x.acceleration.x = x.acceleration.y = 1;
  if constexpr (requires { x.acceleration.z = 1; }) x.acceleration.z = 1;
  if constexpr (requires { x.ang_acceleration.z; }) {
    x.ang_acceleration = {1, 1, 1};
  } else {
    x.ang_acceleration = 1;
  }
}
/// 1 at the degrees of freedom of coordinates, else 0.
template <class Chain, class... Keys>
joint_vector<double, Chain::dofs> degrees_of(const Chain& c, const Keys&... keys) {
  auto s = make_state(c);
  set_accelerations(s, joint_vector<double, Chain::dofs>::Zero().eval());
  (mark(s[keys]), ...);
  return accelerations(s);
}

/// The equations of motion in long double, by inverse dynamics.
template <class Chain>
struct equations {
  static constexpr int n = Chain::dofs;
  using vector = joint_vector<precise, n>;
  joint_matrix<precise, n> M;
  vector bias;

  equations(const Chain& c, const trial<Chain>& x) {
    const auto q = x.q.template cast<precise>().eval();
    const auto v = x.v.template cast<precise>().eval();
    bias = inverse_dynamics(c, q, v, vector(vector::Zero()));
    for (int j = 0; j < n; ++j) M.col(j) = inverse_dynamics(c, q, v, vector(vector::Unit(j))) - bias;
  }
  /// The accelerations, where those in `is_given` are known and the forces of others.
  template <class V>
  vector accelerations(const V& known, const V& is_given) const {
    joint_matrix<precise, n> m = M;
    vector x = known.template cast<precise>() - bias;
    for (int i = 0; i < n; ++i)
      if (is_given[i] == 1) m.row(i).setZero(), m(i, i) = 1, x[i] = precise(known[i]);
    return solved<precise, n>(m, x);
  }
};

/// With a prescription in random states. Bounds as for forward and inverse dynamics (tree_motion.hpp).
template <class Chain, class... Keys>
void check(const Chain& c, unsigned seed, const Keys&... keys) {
  random_numbers random(seed);
  using vector = joint_vector<double, Chain::dofs>;
  const vector is_given = degrees_of(c, keys...);
  struct {
    double a = 0, tau = 0;
  } worst;
  for (int round = 0; round < 20; ++round) {
    const trial<Chain> x(random);
    vector known = x.tau;
    for (int i = 0; i < Chain::dofs; ++i)
      if (is_given[i] == 1) known[i] = x.a[i];
    const auto r = hybrid_dynamics(c, x.q, x.v, known, prescribed(keys...));
    // Given numbers are returned unchanged.
    for (int i = 0; i < Chain::dofs; ++i) CHECK((is_given[i] == 1 ? r.a : r.tau)[i] == known[i]);
    const equations<Chain> exact(c, x);
    const auto a = exact.accelerations(known, is_given);
    worst.a = std::max(worst.a, gap(r.a, a));
    // Forces are sums of those of all accelerations.
    const decltype(a) tau = exact.M * a + exact.bias;
    const double size = largest(tau) + largest(exact.M) * largest(a);
    worst.tau = std::max(worst.tau, largest(decltype(a)(r.tau.template cast<precise>() - tau)) / size);
  }
  CHECK(worst.a < 1e-14);
  CHECK(worst.tau < 5e-15);
}

TEST_CASE("hybrid dynamics of a tree in space") {
  SECTION("at its root") { check(tree_3D, 1, q1); }
  SECTION("in its middle, of six degrees of freedom") { check(tree_3D, 2, floating); }
  SECTION("in its middle, a ball joint, and at an end") { check(tree_3D, 3, ball, q3); }
  SECTION("all but one") { check(tree_3D, 4, q4, q3, q1, floating, ball); }
}

TEST_CASE("hybrid dynamics of masses on coordinates") {
  SECTION("without a joint") { check(rotors, 5, lone); }
  SECTION("with a joint, beside a coordinate that is given") { check(rotors, 6, q1, q4); }
}

TEST_CASE("hybrid dynamics of a tree in the plane") {
  SECTION("a free joint") { check(tree_2D, 7, sliding); }
  SECTION("a sliding joint in its middle") { check(tree_2D, 8, q2, q3); }
}

}  // namespace hybrid_dynamics_test
