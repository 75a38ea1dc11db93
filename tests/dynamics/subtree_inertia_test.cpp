#include <kte/dynamics/subtree_inertia.hpp>

#include <limits>

#include "dynamics/small_chains.hpp"
#include "static_models/static_model.hpp"

namespace subtree_inertia_test {

// What a frame carries: a formula, the mass matrix, the centre of mass of all; static against runtime.

using namespace kte;
using namespace kte::test;
using namespace kte::test::small_chains;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double rounding = 50 * eps;  // sums of a few bodies along at most 8 poses

Eigen::Matrix<double, 10, 1> eigen(const dense_composite_inertia<double>& b) {
  Eigen::Matrix<double, 10, 1> x;
  const auto& [m, h, i] = b;
  x << m, h.x, h.y, h.z, i.xx, i.xy, i.xz, i.yy, i.yz, i.zz;
  return x;
}
/// The functions of a frame of a static chain, against those of a runtime chain.
void check_runtime(dense_composite_inertia<double> (*inertia)(const Eigen::VectorXd& q),
                   mass_centre<> (*mass_centre_of)(const Eigen::VectorXd& q), const runtime_chain& c,
                   std::string_view frame, unsigned seed) {
  auto s = c.make_state();
  random_numbers random(seed);
  const auto q = random_configuration<double>(c, random);
  const auto b = eigen(inertia(q));
  CHECK(gap(eigen(subtree_inertia(c, s, q, frame)), b) < rounding);
  CHECK(gap(eigen(subtree_inertia(c, s, frame)), b) < rounding);
  const auto centre = mass_centre_of(q), r = carried_mass_centre(c, s, q, frame);
  CHECK(r.mass == within_relative(centre.mass, rounding));
  CHECK(gap(small_chains::eigen(r.position), small_chains::eigen(centre.position)) < rounding);
}
template <const auto& Chain, const auto& Frame>
void check_runtime(unsigned seed) {
  check_runtime([](const auto& q) { return subtree_inertia(Chain, q, Frame); },
                [](const auto& q) { return carried_mass_centre(Chain, q, Frame); }, models::element_by_element(Chain),
                Frame.name, seed);
}

TEST_CASE("what a frame carries, by its formula") {
  // 2 kg at 0.5 m on the cart, then 3 kg on a link of 1 m that is turned by a quarter.
  constexpr auto c = chain(revolute_joint_2D(q1, table, cart), inertia_2D(cart, point_mass(2.0, vec3{0.5, 0.0, zero})),
                           rigid_link_2D(cart, rail, along_x(1.0), quarter_turn),
                           inertia_2D(rail, point_mass(3.0, vec3{0.25, 0.0, zero})));
  const std::array q{0.7};
  const auto b = subtree_inertia(c, q, cart);
  CHECK(b.mass == 5);
  CHECK(b.moment == vec3{4.0, 0.75, 0.0});
  CHECK(b.inertia.zz == within(2 * 0.25 + 3 * (1 + 0.0625), 4 * eps));
  const auto at = carried_mass_centre(c, q, rail);
  CHECK(at.mass == 3);
  CHECK(at.position.x == within(std::cos(0.7) - 0.25 * std::sin(0.7), 2 * eps));
  CHECK(at.position.y == within(std::sin(0.7) + 0.25 * std::cos(0.7), 2 * eps));
}

TEST_CASE("what a joint carries is the block of the mass matrix, and what the base carries is all") {
  random_numbers random(1);
  const auto q = random_configuration<double>(floating, random);
  const auto m = mass_matrix(floating, q);
  const auto at_hand = subtree_inertia(floating, q, hand).inertia;
  CHECK(gap(to_eigen<double>(full(at_hand)), m.block<3, 3>(6, 6)) < rounding);
  CHECK(subtree_inertia(floating, q, body).mass == within(m(0, 0), 4 * eps));
  const auto all = carried_mass_centre(floating, q, ground), centre = centre_of_mass(floating, q);
  CHECK(all.mass == within(centre.mass, 4 * eps));
  CHECK(gap(small_chains::eigen(all.position), small_chains::eigen(centre.position)) < rounding);
}

TEST_CASE("what frames of runtime chains carry") {
  check_runtime<floating, socket>(2);
  check_runtime<floating, ground>(3);
  check_runtime<planar, rail>(4);
  check_runtime<geared, socket>(5);
  check_runtime<::models::tree, ::models::trunk>(6);
}

TEST_CASE("what frames carry, of bad arguments") {
  const auto model = models::element_by_element(geared);
  auto s = model.make_state();
  const std::array q{0.1, 0.2};
  CHECK_THROWS_AS(subtree_inertia(model, s, q, "tpi"), unknown_name);
  CHECK_THROWS_AS(carried_mass_centre(model, s, q, "q1"), unknown_name);
  CHECK_THROWS_AS(subtree_inertia(model, s, std::array{0.0, std::nan("")}, "tip"), bad_argument);
  runtime_chain none;
  none << revolute_joint_2D("q", "base", "end");
  auto t = none.make_state();
  CHECK(subtree_inertia(none, t, "end").mass == 0);
  CHECK_THROWS_AS(carried_mass_centre(none, t, "end"), bad_argument);
}

}  // namespace subtree_inertia_test
