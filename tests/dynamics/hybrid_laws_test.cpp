#include <kte/dynamics/hybrid_dynamics.hpp>

#include "data/solo12.hpp"
#include "digits50.hpp"
#include "dynamics/trees.hpp"
#include "robots/solo12.hpp"

// Hybrid dynamics is between inverse and forward dynamics; of a robot against 31 digits; of what is singular or no
// number.

namespace hybrid_laws_test {

using namespace kte;
using namespace kte::test::trees;

TEST_CASE("with nothing prescribed, hybrid dynamics is forward dynamics") {
  random_numbers random(9);
  for (int round = 0; round < 20; ++round) {
    const trial<decltype(rotors)> x(random);
    const auto r = hybrid_dynamics(rotors, x.q, x.v, x.tau, prescribed());
    CHECK(gap(r.a, forward_dynamics(rotors, x.q, x.v, x.tau)) < 1e-14);
    CHECK(r.tau == x.tau);
  }
}

TEST_CASE("with everything prescribed, hybrid dynamics is inverse dynamics") {
  random_numbers random(10);
  for (int round = 0; round < 20; ++round) {
    const trial<decltype(rotors)> x(random);
    const auto r = hybrid_dynamics(rotors, x.q, x.v, x.a, prescribed(q1, q2, q3, q4, lone));
    CHECK(gap(r.tau, inverse_dynamics(rotors, x.q, x.v, x.a)) < 5e-15);
    CHECK(r.a == x.a);
  }
}

TEST_CASE("hybrid dynamics of the accelerations of forward dynamics returns the forces") {
  random_numbers random(11);
  for (int round = 0; round < 20; ++round) {
    const trial<decltype(rotors)> x(random);
    const auto a = forward_dynamics(rotors, x.q, x.v, x.tau);
    joint_vector<double, 5> known = x.tau;
    for (const int i : {0, 3}) known[i] = a[i];
    const auto r = hybrid_dynamics(rotors, x.q, x.v, known, prescribed(q1, q4));
    // Forces are sums of terms of the size of M a.
    const double size = 1 + largest(a) * largest(mass_matrix(rotors, x.q)) / largest(x.tau);
    CHECK(gap(r.tau, x.tau) < 5e-15 * size);
    CHECK(gap(r.a, a) < 1e-14);
  }
}

TEST_CASE("hybrid dynamics of solo12 with its trunk prescribed against 31 digits") {
  const auto& c = robots::solo12;
  constexpr int n = 18;
  using exact_vector = joint_vector<long double, n>;
  for (const auto& x : reference::solo12) {
    const Eigen::Map<const exact_vector> fd(x.forward_dynamics), id(x.inverse_dynamics);
    // a, the forces that go with it, and the largest force of its inertia. A lower leg has 1e-4 kg m^2 to turn: what is
    // rounded of a given moment is 1e4 times as much in a, measured 1.8e-13. Of forces, measured 1e-16.
    const auto compare = [&](const exact_vector& a, const exact_vector& tau, double size) {
      double known[n];
      for (int i = 0; i < n; ++i) known[i] = static_cast<double>(i < 6 ? a[i] : tau[i]);
      const auto r = hybrid_dynamics(c, x.q, x.v, known, prescribed(robots::solo12_names::trunk));
      const double rounding = 2e-16 * largest(exact_vector(tau).tail<12>().eval());
      CHECK(largest(exact_vector(r.a.cast<long double>() - a)) < 5e-15 * largest(a) + 1e4 * rounding);
      CHECK(largest(exact_vector(r.tau.cast<long double>() - tau)) < 2e-15 * size);
      for (int i = 0; i < n; ++i) CHECK((i < 6 ? r.a : r.tau)[i] == known[i]);
    };
    const auto M = mass_matrix(c, x.q);
    compare(fd, Eigen::Map<const joint_vector<double, n>>(x.tau).cast<long double>(), largest(M) * largest(fd));
    compare(Eigen::Map<const joint_vector<double, n>>(x.a).cast<long double>(), id, largest(M) * largest(id));
  }
}

TEST_CASE("a joint that is prescribed needs no mass") {
  // A crane turns by hand; a load of 2 kg slides on its boom.
  constexpr auto crane = chain(revolute_joint_3D(q1, base, a), prismatic_joint_3D(q2, a, b, axis::x),
                               inertia_3D(b, point_mass(2.0)), inertia_gen(lone, 0.0));
  const std::array q{0.5, 3.0, 0.0}, v{2.0, 0.25, 0.0}, known{4.0, 7.0, 1.0};
  const auto r = hybrid_dynamics(crane, q, v, known, prescribed(lone, q1));
  CHECK(r.a == joint_vector<double, 3>(4.0, 15.5, 1.0));                                // F/m + w^2 r
  CHECK(r.tau[0] == within_relative(2.0 * 3.0 * (3.0 * 4.0 + 2 * 2.0 * 0.25), 1e-15));  // m r (r al + 2 w r')
  CHECK(r.tau[1] == 7.0);
  CHECK(r.tau[2] == 0.0);
  CHECK_THROWS_AS(hybrid_dynamics(crane, q, v, known, prescribed(q1)), singular_mass_matrix);
  CHECK_THROWS_AS(hybrid_dynamics(crane, q, v, known, prescribed()), singular_mass_matrix);
  // Two joints that do the same: not where the motion of one is known.
  constexpr auto twice = chain(revolute_joint_3D(q1, base, a, oblique), revolute_joint_3D(q2, a, c, oblique),
                               inertia_3D(c, body), inertia_gen(lone, 1.0));
  CHECK_NOTHROW(hybrid_dynamics(twice, q, v, known, prescribed(q1)));
  CHECK_NOTHROW(hybrid_dynamics(twice, q, v, known, prescribed(q2)));
  CHECK_THROWS_AS(hybrid_dynamics(twice, q, v, known, prescribed(lone)), singular_mass_matrix);
}

TEST_CASE("hybrid dynamics at 50 digits") {
  using big = kte::test::digits50;
  constexpr auto c =
      chain(prismatic_joint_3D(q1, base, a, axis::y), inertia_3D(a, body), spherical_joint_3D(ball, a, b),
            inertia_3D(b, light), revolute_joint_3D(q2, b, d, oblique), inertia_3D(d, body), spring_3D(a, d, 0.25, 8.0))
          .gravity(fall);
  const std::array<big, 6> q{big(1) / 3, big(1) / 2, big(1) / 7, big(-2) / 3, big(1) / 5, big(5) / 7};
  const std::array<big, 5> v{big(1) / 3, big(-2) / 7, big(5) / 3, big(1) / 9, big(7) / 3};
  const std::array<big, 5> known{big(4) / 3, big(7) / 3, big(-1) / 3, big(8) / 7, big(2) / 3};
  const auto r = hybrid_dynamics(c, q, v, known, prescribed(ball));
  const std::array is_given{false, true, true, true, false};
  for (int i = 0; i < 5; ++i) {
    const auto at_i = static_cast<std::size_t>(i);
    CHECK((is_given[at_i] ? r.a : r.tau)[i] == known[at_i]);
  }
  const joint_vector<big, 5> missing = inverse_dynamics(c, q, v, r.a) - r.tau;
  CHECK(largest(missing) < 1e-45);
}

TEST_CASE("hybrid dynamics of arguments that are not finite, and of other sizes") {
  constexpr auto c =
      chain(revolute_joint_3D(q1, base, a), inertia_3D(a, body), spherical_joint_3D(ball, a, b), inertia_3D(b, body),
            prismatic_joint_3D(q2, b, d, axis::x), inertia_3D(d, light), inertia_gen(lone, 0.5));
  const std::array q{0.5, 0.25, 0.5, -0.75, 0.125, 0.25, 0.5};
  const std::array v{1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
  const auto solve = [&](const auto& at_q, const auto& at_v, const auto& known) {
    return hybrid_dynamics(c, at_q, at_v, known, prescribed(ball, lone));
  };
  CHECK_NOTHROW(solve(q, v, v));
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -HUGE_VAL}) {
    CAPTURE(bad);
    for (std::size_t i = 0; i < 7; ++i) {
      auto x = q;
      x[i] = bad;
      CHECK_THROWS_AS(solve(x, v, v), bad_argument);
      CHECK_THROWS_WITH(solve(x, v, v),
                        kte::test::contains_text("kte: a coordinate is not finite: q[" + std::to_string(i)));
    }
    for (std::size_t i = 0; i < 6; ++i) {
      CAPTURE(i);
      auto x = v;
      x[i] = bad;
      if (i < 5) CHECK_THROWS_AS(solve(q, x, v), bad_argument);  // nothing reads the rate of the lone one
      CHECK_THROWS_AS(solve(q, v, x), bad_argument);
      CHECK_THROWS_AS(hybrid_dynamics(c, q, v, x, prescribed(q1, ball, q2, lone)), bad_argument);
      CHECK_THROWS_AS(hybrid_dynamics(c, q, v, x, prescribed()), bad_argument);
    }
  }
  auto turned = q;
  for (std::size_t i = 1; i < 5; ++i) turned[i] = 0;
  CHECK_THROWS_AS(solve(turned, v, v), bad_argument);
  CHECK_THROWS_WITH(solve(turned, v, v), "kte: quaternion 'ball' has length 0");
  const std::vector six(v.begin(), v.end()), seven(q.begin(), q.end());
  CHECK_THROWS_WITH(solve(six, six, six), "kte: q has 6 numbers, the chain has 7 numbers of a configuration");
  CHECK_THROWS_WITH(solve(seven, seven, six), "kte: v has 7 numbers, the chain has 6 degrees of freedom");
  CHECK_THROWS_WITH(solve(seven, six, seven), "kte: known has 7 numbers, the chain has 6 degrees of freedom");
}

}  // namespace hybrid_laws_test
