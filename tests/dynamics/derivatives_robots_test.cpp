#include <kte/dynamics/derivatives.hpp>

#include "catch.hpp"
#include "data/chain2.hpp"
#include "data/chain8.hpp"
#include "data/derivatives.hpp"
#include "data/numbered_chain.hpp"
#include "dynamics/matrix_error.hpp"
#include "robots/iiwa14.hpp"
#include "robots/ur5.hpp"

// Derivatives of the dynamics of real arms, and of chains of bodies with numbers for everything, against 21 digits.
// The solo12 is in derivatives_test.cpp: one file takes long to compile.
//
// Bounds are relative to the largest number. Inverse dynamics: sums over up to eight bodies, a few eps; measured
// 4.5e-16 for arms, 7.2e-16 where placements are 1e-16 away from the rotations that the reference is for. Forward
// dynamics solves with M, whose factorisation does not mind the units of coordinates: it may lose the condition k of M
// scaled to a diagonal of ones, which is noted beside each state. (4 + k) eps is 1.2e-15 to 3.4e-14, measured 0.1 to
// 0.5 times that.

namespace derivatives_robots_test {

using namespace kte;
using kte::test::error_of;

constexpr long double eps = std::numeric_limits<double>::epsilon();

template <int N, std::size_t M, class Chain>
void check(const char* name, const Chain& c, const reference::state<N>* states,
           const reference::derivatives<N> (&exact)[M], long double inverse, long double condition) {
  STATIC_REQUIRE(detail::is_analytical<Chain>);
  using vector = joint_vector<double, N>;
  const long double forward = (4 + condition) * eps;
  for (std::size_t k = 0; k < M; ++k) {
    CAPTURE(name, k);
    const auto& x = states[k];
    const auto& y = exact[k];
    const vector q(x.q), v(x.v), a(x.a), tau(x.tau);
    const auto r = inverse_dynamics_derivatives(c, q, v, a);
    CHECK(error_of(r.by_q, y.dtau_dq) < inverse);
    CHECK(error_of(r.by_v, y.dtau_dv) < inverse);
    CHECK(error_of(r.tau, x.inverse_dynamics) < inverse);
    long double mass[N * N];
    for (int i = 0, place = 0; i < N; ++i)
      for (int j = i; j < N; ++j) mass[i * N + j] = mass[j * N + i] = x.mass_matrix[place++];
    CHECK(error_of(r.by_a, mass) < inverse);
    CHECK(r.by_a == joint_matrix<double, N>(r.by_a.transpose()));

    const auto f = forward_dynamics_derivatives(c, q, v, tau);
    CHECK(f.a == forward_dynamics(c, q, v, tau));
    CHECK(error_of(f.by_q, y.ddq_dq) < forward);
    CHECK(error_of(f.by_v, y.ddq_dv) < forward);
    CHECK(error_of(f.by_tau, y.ddq_dtau) < forward);
  }
}

TEST_CASE("derivatives of the iiwa14 against 21 digits") {
  check("iiwa14", robots::iiwa14, reference::iiwa14, reference::iiwa14_derivatives, 1e-15L, 25);  // 12 and 25
}
TEST_CASE("derivatives of the ur5 against 21 digits") {
  check("ur5", robots::ur5, reference::ur5, reference::ur5_derivatives, 1e-15L, 15);  // 15 and 5
}
TEST_CASE("derivatives of a chain of 2 bodies against 21 digits") {
  const auto c = reference::static_chain_of(reference::chain2_bodies);
  check("chain2", c, reference::chain2, reference::chain2_derivatives, 2e-15L, 1.4L);  // 1.4 and 1.0
}
TEST_CASE("derivatives of a chain of 8 bodies against 21 digits") {
  const auto c = reference::static_chain_of(reference::chain8_bodies);
  check("chain8", c, reference::chain8, reference::chain8_derivatives, 2e-15L, 148);
}

}  // namespace derivatives_robots_test
