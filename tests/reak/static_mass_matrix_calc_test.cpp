#include <kte/dynamics/mass_matrix.hpp>
#include <kte/reak/mass_matrix_calc.hpp>

#include <limits>

#include "dynamics/small_chains.hpp"

// The mass matrix by Jacobians of bodies of static chains: against that of runtime chains, that by composite inertias,
// and its rate against differences at 50 digits.

namespace static_mass_matrix_calc_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::small_chains;

constexpr double rounding = 200 * std::numeric_limits<double>::epsilon();  // as of rates of Jacobians

template <class Chain>
void check(const Chain& c, unsigned seed) {
  const auto fixed = mass_matrix_calc(c) << all_coordinates << all_inertias;
  const auto model = models::element_by_element(c);
  mass_matrix_calc calc(model);
  calc << all_inertias << all_coordinates;
  const auto columns = fixed.columns();
  CHECK(std::vector(columns.begin(), columns.end()) == calc.columns());
  auto s = model.make_state();
  random_numbers random(seed);
  const random_motion_of<double, Chain> m(c, random);
  const auto t = fixed.twist_shaping(m.q, m.v);
  const auto same = calc.twist_shaping(s, m.q, m.v);
  static_assert(decltype(t.value)::RowsAtCompileTime == decltype(fixed)::rows);
  CHECK(gap(t.value, same.value) < rounding);
  CHECK(gap(t.rate, same.rate) < rounding);
  CHECK(gap(t.masses, same.masses) < rounding);
  const auto x = fixed.mass_matrix_and_rate(m.q, m.v);
  const auto y = calc.mass_matrix_and_rate(s, m.q, m.v);
  CHECK(gap(x.value, y.value) < rounding);
  CHECK(gap(x.rate, y.rate) < rounding);
}

TEST_CASE("mass matrix by Jacobians of static chains: as of runtime chains") {
  check(planar, 1);
  check(geared, 2);
}

TEST_CASE("mass matrix by Jacobians of static chains: the rate is the derivative") {
  const auto calc = mass_matrix_calc(planar) << all_inertias << all_coordinates;
  random_numbers random(3);
  const random_motion_of<big, std::remove_const_t<decltype(planar)>> m(planar, random);
  const auto x = calc.mass_matrix_and_rate(m.q, m.v);
  const auto at = [&](const big& t) { return calc.mass_matrix(integrate(planar, m.q, m.v, t)); };
  CHECK(gap(x.rate, derivative(at)) < by_differences);
  CHECK(gap(x.value, at(0)) < 1e-45);
  const auto all = mass_matrix(planar, m.q);
  const auto of = calc.columns();
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) CHECK(abs(x.value(i, j) - all(of[std::size_t(i)], of[std::size_t(j)])) < 1e-45);
}

TEST_CASE("mass matrix by Jacobians of static chains: what is fed, in the order of kinds") {
  const auto calc = mass_matrix_calc(planar) << moved_by(puck) << inertia_on(disc) << moved_by(q1) << inertia_on(q1);
  CHECK(calc.columns() == std::array{3, 0, 1, 2});  // the number, then the pose
  static_assert(decltype(calc)::rows == 4 && decltype(calc)::size == 4);
  const std::array q{0.1, 0.2, 0.3, 0.4}, v{1.0, 2.0, 3.0, 4.0};
  const auto t = calc.twist_shaping(q, v);
  CHECK(t.value.row(0) == Eigen::RowVector4d(1, 0, 0, 0));
  CHECK(t.masses(0, 0) == 0.02);
  CHECK(calc.mass_matrix(q)(0, 0) == within(0.1 + 0.02, rounding));
  const auto part = mass_matrix_calc(planar) << inertia_on(cart) << moved_by(q1);
  CHECK(part.mass_matrix(q).isZero(0));  // which is before the joint
  CHECK_THROWS_AS(part.mass_matrix(std::array{1.0, 2.0, 3.0, std::nan("")}), bad_argument);
  CHECK((mass_matrix_calc(planar) << all_inertias).mass_matrix(q).size() == 0);
}

}  // namespace static_mass_matrix_calc_test
