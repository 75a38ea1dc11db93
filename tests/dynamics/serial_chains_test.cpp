#include <cmath>
#include <vector>

#include "catch.hpp"
#include "data/chain2.hpp"
#include "data/chain32.hpp"
#include "data/chain8.hpp"
#include "data/numbered_chain.hpp"

// Chains of bodies with numbers for everything, against 31 digits. The values are those of the rotations nearest to the
// rounded matrices of the placements, which are 1e-16 away: that is an error of eps/2 in the inputs of each body,
// beside those of the recursions. Relative to the largest number, measured up to 9e-16 for inverse dynamics, 7e-16 for
// mass matrices, 9e-16 for forward dynamics, whatever the length and the condition; bounds are 2 to 3 times that.

namespace serial_chains_test {

using namespace kte;

/// max |x - reference| / max |reference|; infinite if an x is NaN.
template <class X>
long double relative_error(const X& x, const long double* reference, int n) {
  long double difference = 0, size = 0;
  for (int i = 0; i < n; ++i) {
    const auto d = std::fabs(static_cast<long double>(x[i]) - reference[i]);
    difference = d == d ? std::max(difference, d) : HUGE_VALL;
    size = std::max(size, std::fabs(reference[i]));
  }
  return difference / size;
}
template <class M>
long double error_of_matrix(const M& m, const long double* upper) {
  std::vector<double> u;
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index j = i; j < m.cols(); ++j) {
      CHECK(m(i, j) == m(j, i));
      u.push_back(m(i, j));
    }
  return relative_error(u.data(), upper, static_cast<int>(u.size()));
}

struct bounds {
  long double inverse_dynamics, mass_matrix, forward_dynamics;
};
constexpr bounds most{2e-15L, 2e-15L, 3e-15L};

/// The algorithms by functions of q, v and what else, so that static and runtime chains are one.
template <int n, std::size_t N, class ID, class M, class FD>
void check(const reference::state<n> (&states)[N], const ID& id, const M& mass, const FD& fd) {
  const double none[n]{};
  for (const auto& x : states) {
    CHECK(relative_error(id(x.q, x.v, x.a), x.inverse_dynamics, n) < most.inverse_dynamics);
    CHECK(relative_error(id(x.q, x.v, none), x.bias, n) < most.inverse_dynamics);
    CHECK(error_of_matrix(mass(x.q), x.mass_matrix) < most.mass_matrix);
    CHECK(relative_error(fd(x.q, x.v, x.tau), x.forward_dynamics, n) < most.forward_dynamics);
  }
}
template <std::size_t B, int n, std::size_t N>
void check_static(const reference::serial_body (&bodies)[B], const reference::state<n> (&states)[N]) {
  const auto c = reference::static_chain_of(bodies);
  check(
      states, [&](const auto& q, const auto& v, const auto& a) { return inverse_dynamics(c, q, v, a); },
      [&](const auto& q) { return mass_matrix(c, q); },
      [&](const auto& q, const auto& v, const auto& tau) { return forward_dynamics(c, q, v, tau); });
}
template <std::size_t B, int n, std::size_t N>
void check_runtime(const reference::serial_body (&bodies)[B], const reference::state<n> (&states)[N]) {
  const auto c = reference::runtime_chain_of(bodies);
  auto s = c.make_state();
  check(
      states, [&](const auto& q, const auto& v, const auto& a) { return inverse_dynamics(c, s, q, v, a); },
      [&](const auto& q) { return mass_matrix(c, s, q); },
      [&](const auto& q, const auto& v, const auto& tau) { return forward_dynamics(c, s, q, v, tau); });
}

TEST_CASE("a chain of 2 bodies against 31 digits") {
  check_static(reference::chain2_bodies, reference::chain2);
  check_runtime(reference::chain2_bodies, reference::chain2);
}
TEST_CASE("a chain of 8 bodies against 31 digits") {
  check_static(reference::chain8_bodies, reference::chain8);
  check_runtime(reference::chain8_bodies, reference::chain8);
}
TEST_CASE("a chain of 32 bodies against 31 digits") { check_runtime(reference::chain32_bodies, reference::chain32); }

}  // namespace serial_chains_test
