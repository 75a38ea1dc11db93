#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/hybrid_dynamics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/dynamics/reduced.hpp>
#include <kte/elements/joint_stiction.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include <limits>

#include "dynamics/small_chains.hpp"

// Chains with locked joints: their forces and masses are those of the whole chain that has these joints at rest.

namespace reduced_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::small_chains;

constexpr double rounding = 500 * std::numeric_limits<double>::epsilon();  // M, its inverse, motions along 8 poses

/// Numbers of a vector of the whole chain that a part has, by names.
template <class X>
Eigen::VectorXd numbers_of(const runtime_chain& part, const runtime_chain& whole, const X& x, bool configuration) {
  Eigen::VectorXd y(configuration ? part.nq() : part.dofs());
  for (const auto& e : layout(part))
    for (const auto& f : layout(whole))
      if (f.name == e.name) {
        if (configuration)
          for (int i = 0; i < e.nq; ++i) y[e.q + i] = x[f.q + i];
        else
          for (int i = 0; i < e.nv; ++i) y[e.v + i] = x[f.v + i];
      }
  return y;
}

template <class... Names>
void check(const runtime_chain& c, unsigned seed, const Names&... names) {
  random_numbers random(seed);
  const auto vector = [&](int n, double size) {
    Eigen::VectorXd x(n);
    for (auto& number : x) number = random(size);
    return x;
  };
  const Eigen::VectorXd q = integrate(c, neutral_configuration(c), vector(c.dofs(), 2), 1.0);
  const auto part = reduced(c, q, names...);
  auto s = c.make_state(), t = part.make_state();
  // At rest what is locked; whatever else.
  const Eigen::VectorXd kept = [&] {
    Eigen::VectorXd x = Eigen::VectorXd::Ones(c.dofs());
    for (const std::string_view name : {std::string_view(names)...})
      for (const auto& f : layout(c))
        if (f.name == name) x.segment(f.v, f.nv).setZero();
    return x;
  }();
  const Eigen::VectorXd v = kept.cwiseProduct(vector(c.dofs(), 2)), a = kept.cwiseProduct(vector(c.dofs(), 5)),
                        tau = vector(c.dofs(), 5);
  const auto of = [&](const auto& x) { return numbers_of(part, c, x, false); };
  const Eigen::VectorXd at = numbers_of(part, c, q, true);
  CHECK(part.dofs() == static_cast<int>(kept.sum()));
  CHECK(gap(inverse_dynamics(part, t, at, of(v), of(a)), of(inverse_dynamics(c, s, q, v, a))) < rounding);
  const Eigen::MatrixXd m = mass_matrix(c, s, q);
  for (int i = 0; i < part.dofs(); ++i) {
    const auto column = [&](const runtime_chain& x, int k) {
      return Eigen::VectorXd(Eigen::VectorXd::Unit(x.dofs(), k));
    };
    int row = 0;
    while (kept[row] == 0 || of(column(c, row))[i] == 0) ++row;
    CHECK(gap(mass_matrix(part, t, at).col(i), of(m.col(row))) < rounding);
  }
  // Forward dynamics is hybrid dynamics with the locked ones prescribed at rest.
  const Eigen::VectorXd known = kept.cwiseProduct(tau);
  const auto hybrid = hybrid_dynamics(c, s, q, v, known, {std::string_view(names)...});
  CHECK(gap(forward_dynamics(part, t, at, of(v), of(tau)), of(hybrid.a)) < rounding);
  CHECK(potential_energy(part, t, at) == within_relative(potential_energy(c, s, q), 10 * rounding));
}

TEST_CASE("chains with locked joints: forces, masses, accelerations") {
  const auto c = models::element_by_element(floating);
  check(c, 1, "q1");
  check(c, 2, "trunk", "q2");
  check(c, 3, "ball");
  check(models::element_by_element(planar), 4, "puck");
}

TEST_CASE("chains with locked joints that springs act on, and coordinates that follow them") {
  check(models::element_by_element(floating_with_springs), 5, "q2");
  check(models::element_by_element(floating_with_dampers), 6, "q1", "trunk");
  check(models::element_by_element(models::tree), 7, "hip");
  const auto tree = models::element_by_element(models::tree);
  check(tree, 8, "knee");  // with the joint that follows it, and its mass
  const auto part = reduced(tree, std::array{0.1, 0.2, 0.3}, "knee");
  CHECK(part.make_state().tree().plan.bases.size() == 1);
  const auto s = geared;
  check(models::element_by_element(s), 9, "q1");
  const auto locked = reduced(models::element_by_element(s), std::array{0.1, 0.2}, "q1");
  CHECK(locked.make_state().tree().plan.tree);  // its followers are links, too
}

TEST_CASE("static chains with locked joints") {
  random_numbers random(10);
  const random_motion_of<double, std::remove_const_t<decltype(floating)>> m(floating, random);
  const auto part = reduced(floating, m.q, trunk, q1);
  static_assert(decltype(part)::dofs == 4);
  const auto model = reduced(models::element_by_element(floating), m.q, "trunk", "q1");
  auto s = model.make_state();
  const Eigen::VectorXd q = numbers_of(model, models::element_by_element(floating), m.q, true);
  CHECK(gap(mass_matrix(part, q), mass_matrix(model, s, q)) < rounding);
  const Eigen::Vector4d v(1, 2, 3, 4);
  CHECK(gap(inverse_dynamics(part, q, v, v), inverse_dynamics(model, s, q, v, v)) < rounding);
  constexpr auto flat = chain(free_joint_2D(puck, table, cart), revolute_joint_2D(q1, cart, disc),
                              inertia_2D(disc, point_mass(0.8, vec3{0.25, 0.0, zero})))
                            .gravity(along_y(-9.81));
  const auto hung = reduced(flat, std::array{1.0, 2.0, 0.3, 0.0}, puck);
  CHECK(inverse_dynamics(hung, std::array{0.0}, std::array{0.0}, std::array{0.0})[0] ==
        within(0.8 * 0.25 * 9.81 * std::cos(0.3), 1e-15));
}

TEST_CASE("locked joints of bad names") {
  const auto c = models::element_by_element(geared);
  const std::array q{0.1, 0.2};
  CHECK_THROWS_AS(reduced(c, q, "q3"), unknown_name);
  CHECK_THROWS_MATCHES(reduced(c, q, "f1"), bad_argument, says("'f1' is not a degree of freedom"));
  CHECK_THROWS_MATCHES(reduced(c, q, "tip"), bad_argument, says("not a degree of freedom"));
  CHECK_THROWS_AS(reduced(c, std::array{0.1, std::nan("")}, "q1"), bad_argument);
  CHECK(reduced(c, q).dofs() == 2);
  CHECK(reduced(c, q, std::vector<std::string>{"q1", "q2"}).dofs() == 0);
}

TEST_CASE("locked joints of the name of a frame, with a brake, and on a mount") {
  runtime_chain c;
  c.gravity(along_y(-9.81)) << revolute_joint_2D("arm", "base", "arm").at(along_x(0.5), rotation_by(0.2))
                            << inertia_2D("arm", point_mass(2.0, along_x(0.3))) << brake_gen("arm", "mode", "force")
                            << prismatic_joint_2D("slide", "arm", "tip", axis::x) << inertia_2D("tip", point_mass(1.0));
  const auto part = reduced(c, std::array{0.4, 0.0}, "arm");
  auto s = part.make_state();
  REQUIRE(part.dofs() == 1);
  CHECK(inverse_dynamics(part, s, std::array{0.1}, std::array{0.0}, std::array{2.0})[0] ==
        within(2 + 9.81 * std::sin(0.6), 1e-14));
}

}  // namespace reduced_test
