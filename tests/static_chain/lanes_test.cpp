#include <kte/math/dual.hpp>
#include <kte/math/pack.hpp>
#include <kte/static_chain/lanes.hpp>

#include <array>

#include "catch.hpp"
#include "chain/models.hpp"
#include "digits50.hpp"
#include "robots/iiwa14.hpp"

namespace lanes_test {

using kte::test::digits50, kte::test::says;

using namespace models;
using P = kte::pack<double, 8>;

/// A pendulum with a body of numbers, a damper and a spring; `S`: the scalar of its parameters.
template <class S>
auto arm(S mass, S length, S friction, S g) {
  return kte::chain(kte::revolute_joint_2D(q, base, joint), kte::rigid_link_2D(joint, tip, kte::along_x(length)),
                    kte::joint_damping_gen(q, friction), kte::inertia_2D(tip, kte::planar_body(mass, S(0.1))))
      .gravity(kte::along_y(g));
}
P ramp(double first, double step) {
  P x;
  for (std::size_t i = 0; i < 8; ++i) x.set(i, first + step * static_cast<double>(i));
  return x;
}
const P masses = ramp(1, 0.25), lengths = ramp(0.5, 0.125), frictions = ramp(0, 0.5), gravities = ramp(-10, 1);

template <class Chain, class S>
auto acceleration(const Chain& c, const S& at) {
  return kte::forward_dynamics(c, std::array{at}, std::array{S(0.5) * at}, std::array{S(0)})[0];
}

TEST_CASE("lanes with different parameters have the results of chains of these parameters") {
  const auto arms = kte::lanes(arm(1.0, 1.0, 1.0, -9.81), kte::parameter{"tip/mass", masses},
                               kte::parameter{"tip/position/x", lengths}, kte::parameter{"q/damping", frictions},
                               kte::parameter{"gravity/y", gravities});
  const P a = acceleration(arms, ramp(0.5, 0.25));
  const P direct = acceleration(arm(masses, lengths, frictions, gravities), ramp(0.5, 0.25));
  for (std::size_t i = 0; i < 8; ++i) {
    const double at = 0.5 + 0.25 * static_cast<double>(i);
    // One pack, all of one lane: digits do not depend on the neighbours.
    const P same = acceleration(arm(P(masses[i]), P(lengths[i]), P(frictions[i]), P(gravities[i])), P(at));
    CHECK(a[i] == same[0]);
    CHECK(direct[i] == same[0]);
    CHECK(a[i] == within(acceleration(arm(masses[i], lengths[i], frictions[i], gravities[i]), at), 1e-13));
  }
}

TEST_CASE("a robot in lanes: inertias about the origin follow from parameters of bodies") {
  const auto arms = kte::lanes(robots::iiwa14, kte::parameter{"link7/mass", masses},
                               kte::parameter{"link7/com/z", lengths}, kte::parameter{"link3/inertia/xx", P(0.03)});
  std::array<P, 7> x;
  x.fill(P(0.3));
  const auto m = kte::mass_matrix(arms, x);
  for (std::size_t i = 0; i < 8; ++i) {
    const auto one = kte::lanes(robots::iiwa14, kte::parameter{"link7/mass", masses[i]},
                                kte::parameter{"link7/com/z", lengths[i]}, kte::parameter{"link3/inertia/xx", 0.03});
    const auto expected = kte::mass_matrix(one, std::array{0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3});
    for (int r = 0; r < 7; ++r)
      for (int c = 0; c < 7; ++c) CHECK(m(r, c)[i] == within(expected(r, c), 1e-14));
  }
}

TEST_CASE("parameters that are not there, or not allowed, by name and lane") {
  const auto one = arm(1.0, 1.0, 1.0, -9.81);
  P bad = masses;
  bad.set(3, -1);
  CHECK_THROWS_MATCHES(kte::lanes(one, kte::parameter{"tip/mass", bad}), kte::bad_parameter,
                       says("kte: lane 3: inertia_2D (frame 'tip'): mass must be finite and not negative, got -1"));
  CHECK_THROWS_MATCHES(arm(bad, lengths, frictions, gravities), kte::bad_parameter, says("lane 3"));
  CHECK_THROWS_MATCHES(kte::lanes(one, kte::parameter{"tip/weight", 1.0}), kte::unknown_name,
                       says("no parameter 'tip/weight'"));
  CHECK_THROWS_MATCHES(kte::lanes(one, kte::parameter{"tip/position/y", 1.0}), kte::bad_argument,
                       says("typed constant"));
  CHECK_THROWS_MATCHES(kte::lanes(one, kte::parameter{"gravity/x", 1.0}), kte::bad_argument, says("typed constant"));
  CHECK_THROWS_MATCHES(kte::lanes(one, kte::parameter{"gravity/y", bad * (1 / P(0.0))}), kte::bad_parameter,
                       says("gravity must be finite"));
  const auto twice = kte::chain(one, kte::inertia_2D(tip, kte::point_mass(1.0)));
  CHECK_THROWS_MATCHES(kte::lanes(twice, kte::parameter{"tip/mass", 2.0}), kte::bad_argument, says("2 elements"));
}

TEST_CASE("a chain in another scalar: all its numbers, not its typed constants") {
  constexpr auto one = pendulum.gravity(kte::along_y(-9.81));
  constexpr auto f = kte::in<float>(one);
  static_assert(std::is_same_v<decltype(f.gravity()), const kte::vec3<kte::zero_t, float, kte::zero_t>&>);
  static_assert(std::is_same_v<decltype(f.core<1>().position), kte::vec3<float, kte::zero_t, kte::zero_t>>);
  CHECK(static_cast<double>(acceleration(f, 0.5f)) == within(acceleration(one, 0.5), 1e-5));

  const auto many = kte::in<P>(one);
  CHECK(acceleration(many, P(0.5))[5] == acceleration(one, P(0.5))[5]);

  using D = kte::dual<double, 1>;
  const auto by_mass = kte::lanes(arm(1.0, 1.0, 1.0, -9.81), kte::parameter{"tip/mass", kte::seeded<1>(2.0, 0)});
  const double h = 1e-6, up = acceleration(arm(2 + h, 1.0, 1.0, -9.81), 0.5),
               down = acceleration(arm(2 - h, 1.0, 1.0, -9.81), 0.5);
  CHECK(acceleration(by_mass, D(0.5)).derivative[0] == within((up - down) / (2 * h), 1e-8));

  // 0.1 as a double, in 50 digits.
  const auto exact = kte::in<digits50>(one);
  CHECK(exact.gravity().y == digits50(-9.81));
}

}  // namespace lanes_test
