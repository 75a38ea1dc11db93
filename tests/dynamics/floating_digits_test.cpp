
#include "digits50.hpp"
#include "dynamics/floating_bodies.hpp"

// Double precision where bodies float.

namespace floating_digits_test {

using namespace kte;
using namespace kte::test::floating_bodies;
using big = kte::test::digits50;

/// Doubles against the same templates at 50 digits.
template <class Chain>
void check_digits(const Chain& c, unsigned seed, int rounds) {
  constexpr int n = Chain::dofs;
  random_numbers random(seed);
  for (int round = 0; round < rounds; ++round) {
    const auto q = random_configuration(c, random);
    const auto v = random_vector<double, n>(random, 2), a = random_vector<double, n>(random, 5);
    const auto up = [](const auto& x) { return x.template cast<big>().eval(); };
    const auto error_of = [](const auto& x, const auto& exact) {
      big difference = 0, size = 0;
      for (Eigen::Index i = 0; i < exact.size(); ++i) {
        difference = kte::test::worse(difference, big(abs(big(x.data()[i]) - exact.data()[i])));
        size = std::max(size, big(abs(exact.data()[i])));
      }
      return static_cast<double>(difference / size);
    };
    const auto M = mass_matrix(c, q);
    const Eigen::VectorXd eigenvalues = eigenvalues_of(M);
    CHECK(error_of(inverse_dynamics(c, q, v, a), inverse_dynamics(c, up(q), up(v), up(a))) < 8 * eps);
    CHECK(error_of(M, mass_matrix(c, up(q))) < 8 * eps);
    CHECK(error_of(forward_dynamics(c, q, v, a), forward_dynamics(c, up(q), up(v), up(a))) <
          8 * eps * eigenvalues[n - 1] / eigenvalues[0]);
  }
}

TEST_CASE("double precision against 50 digits, floating") {
  // A revolute, a free and a ball joint, springs and a damper: more chains would show the same.
  check_digits(hanging, 12, 20);
}

}  // namespace floating_digits_test
