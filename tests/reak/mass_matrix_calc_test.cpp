#include <kte/dynamics/coriolis_matrix.hpp>
#include <kte/elements/inertial_beam.hpp>
#include <kte/reak/mass_matrix_calc.hpp>

#include <limits>

#include "dynamics/small_chains.hpp"

// The mass matrix by Jacobians of bodies: against that by composite inertias, its rate against the Coriolis matrix.

namespace mass_matrix_calc_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::small_chains;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double rounding = 200 * eps;  // as of rates of Jacobians

template <class Chain>
void check(const Chain& c, unsigned seed) {
  const auto model = models::element_by_element(c);
  mass_matrix_calc calc(model);
  calc << all_inertias << all_coordinates;
  auto s = model.make_state(), t = model.make_state();
  const auto of = calc.columns();
  random_numbers random(seed);
  for (int round = 0; round < 5; ++round) {
    const random_motion_of<double, Chain> m(c, random);
    const auto x = calc.mass_matrix_and_rate(s, m.q, m.v);
    const Eigen::MatrixXd mass = mass_matrix(model, t, m.q)(of, of);
    const Eigen::MatrixXd coriolis = coriolis_matrix(model, t, m.q, m.v)(of, of);
    CHECK(gap(x.value, mass) < rounding);
    CHECK(gap(calc.mass_matrix(s), x.value) < rounding);
    CHECK(gap(calc.mass_matrix(s, m.q), x.value) < rounding);
    const Eigen::MatrixXd skew = x.rate - 2 * coriolis;
    CHECK(gap(skew, Eigen::MatrixXd(-skew.transpose())) < rounding);
    // T v are the rates of the bodies, which determine the kinetic energy.
    const auto shaping = calc.twist_shaping(s, m.q, m.v);
    Eigen::VectorXd v(m.v.size());
    for (std::size_t i = 0; i < of.size(); ++i) v[static_cast<Eigen::Index>(i)] = m.v[of[i]];
    const Eigen::VectorXd twists = shaping.value * v;
    CHECK(twists.dot(shaping.masses * twists) / 2 == within_relative(kinetic_energy(model, t, m.q, m.v), rounding));
    // Differences: h^2 f'''/6 of numbers below 1e3, and eps/h.
    const double h = 1e-5;
    const auto at = [&](double time) { return calc.twist_shaping(s, integrate(c, m.q, m.v, time), m.v); };
    CHECK(gap((at(h).value - at(-h).value) / (2 * h), shaping.rate) < 1e-7);
  }
}

TEST_CASE("mass matrix by Jacobians: all of a chain") {
  check(floating, 1);
  check(planar, 2);
  check(geared, 3);
  check(models::tree, 4);
}

TEST_CASE("mass matrix by Jacobians: what is fed, in the order of kinds") {
  const auto model = models::element_by_element(planar);
  mass_matrix_calc calc(model);
  calc << moved_by("puck") << inertia_on("disc") << moved_by("q1") << inertia_on("q1");
  CHECK(calc.columns() == std::vector{3, 0, 1, 2});  // the number, then the pose
  auto s = model.make_state();
  const std::array q{0.1, 0.2, 0.3, 0.4}, v{1.0, 2.0, 3.0, 4.0};
  const auto t = calc.twist_shaping(s, q, v);
  REQUIRE(t.value.rows() == 4);  // the coordinate's, then the disc's
  CHECK(t.value.row(0) == Eigen::RowVector4d(1, 0, 0, 0));
  CHECK(t.masses(0, 0) == 0.02);
  // Of 0.8 kg at 0.25 m: -h_y = 0, h_x = 0.2, I = 0.05 + 0.8 * 0.0625.
  Eigen::Matrix3d disc_alone;
  disc_alone << 0.8, 0, 0, 0, 0.8, 0.2, 0, 0.2, 0.1;
  CHECK(gap(t.masses.bottomRightCorner(3, 3), disc_alone) < 2 * eps);
  // Its own joint turns it about its origin; that is all that the number moves.
  CHECK(calc.mass_matrix(s, q)(0, 0) == within(0.1 + 0.02, 2 * eps));
  mass_matrix_calc part(model);
  part << inertia_on("cart") << moved_by("q1");
  CHECK(part.mass_matrix(s, q).isZero(0));  // which is before the joint
}

TEST_CASE("mass matrix by Jacobians of bad arguments") {
  const auto model = models::element_by_element(planar);
  mass_matrix_calc calc(model);
  CHECK_THROWS_AS(calc << inertia_on("dsc"), unknown_name);
  CHECK_THROWS_AS(calc << moved_by("q3"), unknown_name);
  CHECK_THROWS_MATCHES(calc << inertia_on("rail"), bad_argument, says("no mass on 'rail'"));
  CHECK_THROWS_MATCHES(calc << moved_by("disc"), bad_argument, says("'disc' is not a degree of freedom"));
  calc << inertia_on("disc") << moved_by("q1");
  CHECK_THROWS_MATCHES(calc << inertia_on("disc"), bad_argument, says("twice"));
  CHECK_THROWS_MATCHES(calc << moved_by("q1"), bad_argument, says("twice"));
  const auto other = models::element_by_element(geared);
  auto s = other.make_state();
  CHECK_THROWS_AS(calc.mass_matrix(s), bad_argument);
  auto t = model.make_state();
  CHECK_THROWS_AS(calc.mass_matrix(t, std::array{1.0, 2.0, 3.0, std::nan("")}), bad_argument);
}

TEST_CASE("mass matrix by Jacobians: a frame and a coordinate of one name, and masses between frames") {
  runtime_chain c;
  c << revolute_joint_2D("arm", "base", "arm") << inertia_2D("arm", point_mass(2.0, along_x(0.5)))
    << inertia_gen("arm", 0.25);
  mass_matrix_calc calc(c);
  calc << inertia_on("arm") << moved_by("arm");
  auto s = c.make_state();
  CHECK(calc.mass_matrix(s)(0, 0) == within(0.75, eps));
  c << inertial_beam_2D("base", "arm", 1.0);
  CHECK_THROWS_MATCHES(mass_matrix_calc(c) << all_inertias, bad_argument, says("distributed mass"));
  auto t = c.make_state();
  CHECK_THROWS_AS(coriolis_matrix(c, t), bad_argument);

  // What throws leaves nothing behind, and no end of such a mass is left out.
  mass_matrix_calc part(c);
  CHECK_THROWS_MATCHES(part << inertia_on("arm"), bad_argument,
                       says("inertial_beam_2D (anchor1 'base', anchor2 'arm')"));
  CHECK_THROWS_AS(part << inertia_on("base"), bad_argument);
  CHECK_THROWS_AS(part << all_inertias, bad_argument);
  part << moved_by("arm");
  CHECK_THROWS_AS(part << all_coordinates, bad_argument);
  CHECK((part.inertias().empty() && part.coordinates().size() == 1 && part.columns().size() == 1));
  CHECK(part.mass_matrix(t)(0, 0) == 0);
}

}  // namespace mass_matrix_calc_test
