#include <limits>

#include "data/solo12.hpp"
#include "dynamics/small_chains.hpp"
#include "robots/iiwa14.hpp"
#include "robots/solo12.hpp"
#include "static_models/static_model.hpp"

namespace energy_test {

// Energies: against 31 digits, the mass matrix, by hand, and by the work that is done along a motion.

using namespace kte;
using namespace kte::test;
using small_chains::big, small_chains::by_differences, small_chains::derivative;

/// v . M v / 2 at 50 digits.
void check_by_mass_matrix(const model& x, unsigned seed, double tolerance = 1e-45) {
  const auto& c = x.exact;
  random_numbers random(seed);
  for (int round = 0; round < 3; ++round) {
    const random_motion<big> m(x.runtime, random);
    const big expected = m.v.dot(c.mass_matrix(m.q) * m.v) / 2;
    CHECK(abs(big(c.kinetic_energy(m.q, m.v) / expected - 1)) < tolerance);
    const auto both = c.energy(m.q, m.v);
    CHECK(both.kinetic == c.kinetic_energy(m.q, m.v));
    CHECK(both.potential == c.potential_energy(m.q));
  }
}
/// d/dt energy = tau . v + power of what is no spring, along a motion, at 50 digits.
void check_work(const model& x, unsigned seed, double tolerance = by_differences) {
  const auto& c = x.exact;
  random_numbers random(seed);
  for (int round = 0; round < 3; ++round) {
    const random_motion<big> m(x.runtime, random);
    const big change = derivative([&](const big& t) {
      const auto e = c.energy(m.position_at(c, t), m.velocity_at(t));
      return big(e.kinetic + e.potential);
    });
    const big power = m.v.dot(c.inverse_dynamics(m.q, m.v, m.a));
    CHECK(static_cast<double>(abs(big(change - power)) / (1 + abs(power))) < tolerance);
  }
}
/// Static and runtime in double against 50 digits. That is a sum of what is not negative,
/// of squares of sums along at most 8 frames; a potential energy may cancel.
void check_double(const model& x, unsigned seed) {
  constexpr double rounding = 100 * std::numeric_limits<double>::epsilon();
  random_numbers random(seed);
  auto s = x.runtime.make_state();
  for (int round = 0; round < 20; ++round) {
    const random_motion<double> m(x.runtime, random);
    const auto e = x.in_double.energy(m.q, m.v);
    const auto exact = x.exact.energy(m.q.cast<big>(), m.v.cast<big>());
    CHECK(abs(big(e.kinetic / exact.kinetic - 1)) < rounding);
    CHECK(abs(big(e.potential - exact.potential)) <
          rounding * (100 + abs(exact.potential)));  // up to 60 N over a few m
    const auto r = energy(x.runtime, s, m.q, m.v);
    CHECK(std::fabs(r.kinetic / e.kinetic - 1) < rounding);
    CHECK(abs(big(r.potential - exact.potential)) < rounding * (100 + abs(exact.potential)));
    CHECK(potential_energy(x.runtime, s, m.q) == r.potential);
  }
}

TEST_CASE("energies of solo12 against 31 digits") {
  const auto model = models::element_by_element(robots::solo12);
  auto s = model.make_state();
  constexpr long double bound = 1e-15L;  // as of its other numbers
  for (const auto& x : reference::solo12) {
    const auto e = energy(robots::solo12, x.q, x.v);
    CHECK(std::fabs(e.kinetic / x.kinetic_energy - 1) < bound);
    CHECK(std::fabs(e.potential / x.potential_energy - 1) < bound);
    CHECK(std::fabs(kinetic_energy(robots::solo12, x.q, x.v) / x.kinetic_energy - 1) < bound);
    CHECK(std::fabs(potential_energy(robots::solo12, x.q) / x.potential_energy - 1) < bound);
    CHECK(std::fabs(kinetic_energy(model, s, x.q, x.v) / x.kinetic_energy - 1) < bound);
    CHECK(std::fabs(potential_energy(model, s, x.q) / x.potential_energy - 1) < bound);
  }
}

TEST_CASE("kinetic energy by the mass matrix") {
  check_by_mass_matrix(static_models::iiwa14(), 1);
  check_by_mass_matrix(static_models::floating(), 2);
  check_by_mass_matrix(static_models::planar(), 3);
  check_by_mass_matrix(static_models::geared(), 4);
  check_by_mass_matrix(static_models::tree(), 5, 1e-15);  // an axis that is a unit vector to half an eps
}

TEST_CASE("work along a motion changes the energy") {
  check_work(static_models::iiwa14(), 11);
  check_work(static_models::floating(), 12);
  check_work(static_models::floating_with_springs(), 13);
  check_work(static_models::planar(), 14);
  check_work(static_models::geared(), 15);
}

TEST_CASE("energies in double, and of runtime chains") {
  check_double(static_models::iiwa14(), 21);
  check_double(static_models::floating_with_springs(), 22);
  check_double(static_models::planar(), 23);
  check_double(static_models::geared(), 24);
  check_double(static_models::tree(), 25);
}

TEST_CASE("energies by hand") {
  const auto c = models::pendulum.gravity(along_y(-10.0));
  const std::array rest{0.0}, down{-std::acos(0.0)}, fast{2.0};
  CHECK(kinetic_energy(c, rest, fast) == 0.5);  // 1 kg at 0.5 m, 2 rad/s
  CHECK(potential_energy(c, rest) == 0);
  CHECK(std::fabs(potential_energy(c, down) + 5) < 1e-15);
  CHECK(potential_energy(models::pendulum, down) == 0);  // no gravity
  // k/2 of the square of the stretch: 10 N/m, 0.2 m beyond rest; with 1 N at most: 1 * 0.2 - 1/20.
  using models::hip, models::wall, models::ground, models::trunk;
  const auto sprung = [](const auto&... most) {
    return chain(base_gen(wall), prismatic_joint_3D(hip, ground, trunk, axis::x),
                 spring_gen(wall, hip, 0.1, 10.0, most...));
  };
  CHECK(std::fabs(potential_energy(sprung(), std::array{0.3}) - 0.2) < 1e-16);
  CHECK(std::fabs(potential_energy(sprung(1.0), std::array{0.3}) - 0.15) < 1e-16);
  CHECK(kinetic_energy(sprung(), std::array{0.3}, fast) == 0);  // no mass
}

TEST_CASE("kinetic energy of bodies on a base that moves, with and without a mass fixed to it") {
  constexpr rigid_body body{1.5, vec3{0.02, -0.03, 0.1}, sym3{0.03, 0.001, -0.002, 0.025, 0.003, 0.02}};
  for (const bool loaded : {false, true}) {
    runtime_chain c;
    c << base_3D("ground");
    if (loaded) c << inertia_3D("ground", body);
    c << revolute_joint_3D("q", "ground", "arm", axis::y) << rigid_link_3D("arm", "tip", vec3{0.3, 0.1, -0.2})
      << inertia_3D("tip", body);
    auto s = c.make_state();
    auto& ground = s.frame_3D("ground");
    ground.velocity = {0.3, -0.2, 0.5}, ground.ang_velocity = {1.0, 2.0, -0.5};
    s.coordinate("q").q = 0.4, s.coordinate("q").q_dot = -1.5;
    const double energy_of_all = kinetic_energy(c, s);
    c.doMotion(s);
    double sum = 0;
    for (const char* frame : {"ground", "tip"}) {
      const auto& x = s.frame_3D(frame);
      const vec3<> v = x.velocity + cross(x.ang_velocity, body.com);
      if (loaded || frame == std::string("tip"))
        sum += (body.mass * dot(v, v) + dot(x.ang_velocity, body.inertia * x.ang_velocity)) / 2;
    }
    CHECK(energy_of_all == within_relative(sum, 4 * std::numeric_limits<double>::epsilon()));
  }
}

/// A prismatic joint that stores an energy and has no force.
struct wound_slide : transmission<wound_slide> {
  static constexpr std::string_view type = "wound_slide_3D";
  static constexpr std::array<port, 3> ports{{{kind::gen, access::in, "coordinate"},
                                              {kind::frame_3D, access::in, "base"},
                                              {kind::frame_3D, access::out, "end"}}};
  template <class C>
  constexpr auto relative(const C& c) const {
    constexpr vec3 axis{one, zero, zero};
    return motion{axis * c.q, no_rotation{}, axis * c.q_dot, zero3{}, axis * c.q_ddot, zero3{}};
  }
  template <class C, class Base>
  constexpr auto potential_energy(const C& c, const Base&) const {
    return 5.0 * c.q * c.q;
  }
  constexpr void check(const parameter_check&) const {}
  template <class Self, class Visit>
  static constexpr void parameters(Self&, Visit&&) {}
};

TEST_CASE("energy of a joint, and of bodies between which something without an energy acts") {
  runtime_chain wound, damped;
  wound << connect(wound_slide{}, "q", "ground", "slide") << inertia_3D("slide", point_mass(2.0));
  auto s = wound.make_state();
  const std::array q{0.5}, v{3.0};
  CHECK(energy(wound, s, q, v).potential == 1.25);
  CHECK(energy(wound, s, q, v).kinetic == 9);
  damped << base_3D("ground") << prismatic_joint_3D("q", "ground", "slide", axis::x)
         << inertia_3D("slide", point_mass(2.0)) << damper_3D("ground", "slide", 4.0) << joint_stiffness_gen("q", 10.0);
  auto t = damped.make_state();
  CHECK(energy(damped, t, q, v).potential == 1.25);
  CHECK(energy(damped, t, q, v).kinetic == 9);
}

TEST_CASE("energies of bad arguments") {
  const auto& c = robots::iiwa14;
  const auto model = models::element_by_element(c);
  auto s = model.make_state();
  const std::array<double, 7> good{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7};
  const std::vector two{1.0, 2.0};
  CHECK_THROWS_AS(energy(c, good, two), bad_argument);
  CHECK_THROWS_AS(energy(c, two, good), bad_argument);
  CHECK_THROWS_AS(potential_energy(c, two), bad_argument);
  CHECK_THROWS_AS(kinetic_energy(model, s, good, two), bad_argument);
  for (std::size_t i = 0; i < 7; ++i) {
    auto bad = good;
    bad[i] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(energy(c, bad, good), bad_argument);
    CHECK_THROWS_AS(energy(c, good, bad), bad_argument);
    CHECK_THROWS_AS(kinetic_energy(c, bad, good), bad_argument);
    CHECK_THROWS_AS(kinetic_energy(c, good, bad), bad_argument);
    CHECK_THROWS_AS(potential_energy(c, bad), bad_argument);
    CHECK_THROWS_AS(kinetic_energy(model, s, good, bad), bad_argument);
    CHECK_THROWS_AS(kinetic_energy(model, s, bad, good), bad_argument);
  }
  auto fast = good;
  fast[0] = 1e200;
  CHECK_THROWS_AS(kinetic_energy(c, good, fast), bad_argument);  // its square is infinite
}

}  // namespace energy_test
