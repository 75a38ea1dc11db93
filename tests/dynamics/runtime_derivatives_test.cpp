#include <kte/dynamics/derivatives.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/hybrid_dynamics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/dynamics/mass_matrix_inverse.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include "data/derivatives.hpp"
#include "dynamics/matrix_error.hpp"
#include "dynamics/small_chains.hpp"
#include "dynamics/trees.hpp"
#include "robots/iiwa14.hpp"

// Derivatives, the inverse of the mass matrix and hybrid dynamics of runtime chains: against 21 digits, and against
// static chains, which have their own tests. Both do the same sums; static chains leave out what is zero by its type,
// so that results differ where the compiler contracts other products. Bound: the errors of both.

namespace runtime_derivatives_test {

using namespace kte;
using namespace kte::test::trees;
using kte::test::error_of;
using models::element_by_element;

constexpr double both_errors = 4e-15;

/// The largest differences from static chains, in random states, with what comes from `outside` anywhere.
template <class Chain, class Compare, class... Outside>
void in_random_states(const Chain& model, unsigned seed, const Compare& compare, const Outside&... outside) {
  random_numbers random(seed);
  const runtime_chain c = element_by_element(model);
  auto s = make_state(model);
  auto r = c.make_state();
  for (int round = 0; round < 20; ++round) {
    const trial<Chain> x(random);
    const unsigned outside_seed = 1000 * seed + static_cast<unsigned>(round);
    const auto set = [&](auto& state) {
      random_numbers draw(outside_seed);
      set_positions(state, x.q), set_velocities(state, x.v), set_accelerations(state, x.a);
      (move(thing_of(state, outside), draw), ...);
    };
    set(s), set(r);
    compare(c, r, s, x);
  }
}

template <class Chain, class... Outside>
void check_derivatives(const Chain& model, unsigned seed, const Outside&... outside) {
  const auto compare = [&](const runtime_chain& c, runtime_state& r, const auto& s, const auto&) {
    const auto x = inverse_dynamics_derivatives(model, s);
    const auto& y = inverse_dynamics_derivatives(c, r);
    CHECK(gap(y.tau, x.tau) < both_errors);
    CHECK(gap(y.by_q, x.by_q) < both_errors);
    CHECK(gap(y.by_v, x.by_v) < both_errors);
    CHECK(gap(y.by_a, x.by_a) < both_errors);
    const auto f = forward_dynamics_derivatives(model, s);
    const auto& g = forward_dynamics_derivatives(c, r);
    // The condition of M, scaled to a diagonal of ones, is up to 100 here (as in derivatives_robots_test.cpp).
    CHECK(gap(g.a, f.a) < 100 * both_errors);
    CHECK(gap(g.by_q, f.by_q) < 100 * both_errors);
    CHECK(gap(g.by_v, f.by_v) < 100 * both_errors);
    CHECK(gap(g.by_tau, f.by_tau) < 100 * both_errors);
  };
  in_random_states(model, seed, compare, outside...);
}

template <class Chain, class... Outside>
void check_inverse(const Chain& model, unsigned seed, const Outside&... outside) {
  const auto compare = [&](const runtime_chain& c, runtime_state& r, const auto& s, const auto&) {
    CHECK(gap(mass_matrix_inverse(c, r), mass_matrix_inverse(model, s)) < both_errors);
  };
  in_random_states(model, seed, compare, outside...);
}

template <class Chain, class... Keys>
void check_hybrid(const Chain& model, unsigned seed, const Keys&... keys) {
  const auto compare = [&](const runtime_chain& c, runtime_state& r, const auto&, const auto& x) {
    const auto h = hybrid_dynamics(model, x.q, x.v, x.tau, prescribed(keys...));
    const auto g = hybrid_dynamics(c, r, x.q, x.v, x.tau, {Keys::name...});
    CHECK(gap(g.a, h.a) < 3 * both_errors);
    CHECK(gap(g.tau, h.tau) < 3 * both_errors);
    // Nothing is prescribed any more.
    CHECK(gap(forward_dynamics(c, r, x.q, x.v, x.a), forward_dynamics(model, x.q, x.v, x.a)) < 3 * both_errors);
  };
  in_random_states(model, seed, compare);
}

TEST_CASE("derivatives of a runtime iiwa14 against 21 digits") {
  const runtime_chain c = element_by_element(robots::iiwa14);
  auto s = c.make_state();
  for (std::size_t k = 0; k < std::size(reference::iiwa14_derivatives); ++k) {
    CAPTURE(k);
    const auto& x = reference::iiwa14[k];
    const auto& y = reference::iiwa14_derivatives[k];
    const auto& r = inverse_dynamics_derivatives(c, s, x.q, x.v, x.a);
    CHECK(error_of(r.by_q, y.dtau_dq) < 1e-15L);
    CHECK(error_of(r.by_v, y.dtau_dv) < 1e-15L);
    CHECK(error_of(r.tau, x.inverse_dynamics) < 1e-15L);
    const auto& f = forward_dynamics_derivatives(c, s, x.q, x.v, x.tau);
    CHECK(error_of(f.by_q, y.ddq_dq) < 6.4e-15L);  // bounds: derivatives_robots_test.cpp
    CHECK(error_of(f.by_v, y.ddq_dv) < 6.4e-15L);
    CHECK(error_of(f.by_tau, y.ddq_dtau) < 6.4e-15L);
  }
}

TEST_CASE("derivatives of runtime trees") {
  SECTION("joints of all kinds") { check_derivatives(joints_3D.gravity(fall), 1, base, cart); }
  SECTION("in the plane") { check_derivatives(joints_2D, 2, floor_2D, wall); }
  SECTION("rotors, springs on coordinates, given coordinates, a mass without a joint") {
    check_derivatives(rotors, 3, base, drive, motor, pull);
  }
}

// Where nothing is known element by element: by dual numbers that go through elements.
TEST_CASE("derivatives of runtime chains with forces between frames") {
  SECTION("in space") { check_derivatives(tree_3D, 12, base, cart, motor); }
  SECTION("in the plane") { check_derivatives(tree_2D, 13, floor_2D, wall, motor); }
}

TEST_CASE("derivatives of runtime chains in which coordinates follow others") {
  check_derivatives(kte::test::small_chains::geared, 14);
}

TEST_CASE("the inverse of the mass matrix of runtime chains") {
  SECTION("in space, with springs between frames") { check_inverse(tree_3D, 4, base, cart, motor); }
  SECTION("in the plane, with springs between frames") { check_inverse(tree_2D, 5, floor_2D, wall, motor); }
  SECTION("rotors") { check_inverse(rotors, 6, base, drive, motor, pull); }
  SECTION("coordinates that follow others") { check_inverse(kte::test::small_chains::geared, 7); }
}

TEST_CASE("hybrid dynamics of runtime chains") {
  SECTION("in the middle of a tree") { check_hybrid(tree_3D, 8, floating, ball, q3); }
  SECTION("nothing") { check_hybrid(tree_3D, 9); }
  SECTION("a mass without a joint, and a joint beside a given coordinate") { check_hybrid(rotors, 10, lone, q1); }
  SECTION("in the plane") { check_hybrid(tree_2D, 11, sliding, q2); }
  SECTION("coordinates that follow others") {
    check_hybrid(kte::test::small_chains::geared, 15, kte::test::small_chains::q1);
  }
}

TEST_CASE("hybrid dynamics where coordinates follow others is between inverse and forward dynamics") {
  const auto& model = kte::test::small_chains::geared;
  random_numbers random(16);
  for (int round = 0; round < 20; ++round) {
    const trial<std::remove_cvref_t<decltype(model)>> x(random);
    const auto a = forward_dynamics(model, x.q, x.v, x.tau);
    joint_vector<double, 2> known = x.tau;
    known[0] = a[0];
    const auto r = hybrid_dynamics(model, x.q, x.v, known, prescribed(kte::test::small_chains::q1));
    CHECK(r.a[0] == a[0]);
    CHECK(r.tau[1] == x.tau[1]);
    // Forces are sums of terms of the size of M a.
    const double size = 1 + largest(a) * largest(mass_matrix(model, x.q)) / largest(x.tau);
    CHECK(gap(r.tau, x.tau) < both_errors * size);
    CHECK(gap(r.a, a) < both_errors * size);
    const auto all =
        hybrid_dynamics(model, x.q, x.v, x.a, prescribed(kte::test::small_chains::q1, kte::test::small_chains::q2));
    CHECK(all.a == x.a);
    CHECK(gap(all.tau, inverse_dynamics(model, x.q, x.v, x.a)) < both_errors);
  }
}

TEST_CASE("what runtime chains cannot do is said") {
  using kte::test::contains_text;
  const std::vector<double> none(8, 0.0);
  const runtime_chain springs = element_by_element(tree_2D);
  auto s = springs.make_state();
  const auto hybrid = [&](const char* name) {
    return hybrid_dynamics(springs, s, positions(s), velocities(s), accelerations(s), {name});
  };
  CHECK_THROWS_AS(hybrid("q77"), unknown_name);
  CHECK_THROWS_WITH(hybrid("wall"), contains_text("'wall' is not a degree of freedom"));

  runtime_chain massless;
  massless << revolute_joint_2D("q", "base", "end");
  auto m = massless.make_state();
  CHECK_THROWS_AS(mass_matrix_inverse(massless, m), singular_mass_matrix);
  CHECK_THROWS_AS(forward_dynamics_derivatives(massless, m), singular_mass_matrix);
  m.coordinate("q").q = std::nan("");
  CHECK_THROWS_AS(mass_matrix_inverse(massless, m), bad_argument);
  CHECK_THROWS_AS(inverse_dynamics_derivatives(massless, m), bad_argument);
}

TEST_CASE("a given coordinate that is not finite") {
  const runtime_chain model = element_by_element(rotors);
  auto r = model.make_state();
  auto s = make_state(rotors);
  r.coordinate("drive").q = s[drive].q = std::nan("");
  CHECK_THROWS_AS(mass_matrix(model, r), bad_argument);
  CHECK_THROWS_AS(mass_matrix(rotors, s), bad_argument);
  CHECK_THROWS_AS(mass_matrix_inverse(model, r), bad_argument);
  CHECK_THROWS_AS(mass_matrix_inverse(rotors, s), bad_argument);
  CHECK_THROWS_AS(forward_dynamics(model, r), bad_argument);
  CHECK_THROWS_AS(forward_dynamics(rotors, s), bad_argument);
}

TEST_CASE("a coordinate that hybrid dynamics has prescribed is free in the next call") {
  const runtime_chain c = element_by_element(robots::iiwa14);
  auto s = c.make_state();
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(7);
  const Eigen::MatrixXd free = mass_matrix_inverse(c, s, rest);
  (void)hybrid_dynamics(c, s, rest, rest, rest, {layout(c)[1].name});
  CHECK(mass_matrix_inverse(c, s, rest) == free);
}

TEST_CASE("the inverse of the mass matrix does not depend on an earlier call with a number that is not finite") {
  // Brothers, and trees side by side: their common numbers are zeros that no joint writes.
  const runtime_chain c = element_by_element(tree_3D);
  auto s = c.make_state();
  random_numbers random(16);
  const trial<std::remove_cvref_t<decltype(tree_3D)>> x(random);
  const Eigen::MatrixXd good = mass_matrix_inverse(c, s, x.q);
  int refused = 0;
  for (Eigen::Index i = 0; i < x.q.size(); ++i) {
    auto far = x.q;
    far[i] = 1e200;
    try {
      (void)mass_matrix_inverse(c, s, far);
    } catch (const error&) {
      ++refused;
    }
    CHECK(mass_matrix_inverse(c, s, x.q) == good);
  }
  CHECK(refused > 2);  // positions whose squares are NaN
}

}  // namespace runtime_derivatives_test
