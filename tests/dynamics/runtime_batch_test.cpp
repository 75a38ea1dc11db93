#include <kte/dynamics/batch.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include <limits>
#include <vector>

#include "catch.hpp"
#include "chain/models.hpp"
#include "random.hpp"

// Many states of a runtime chain at once, against each state alone.

namespace runtime_batch_test {

using namespace kte;

/// A slide, a hinge about a general axis with a rotor, a ball: six numbers a configuration, five degrees of freedom.
runtime_chain arm() {
  runtime_chain c;
  c << prismatic_joint_3D("slide", "base", "cart", axis::y) << inertia_3D("cart", point_mass(2.0))
    << rigid_link_3D("cart", "mount", vec3{0.1, 0.2, -0.3})
    << revolute_joint_3D("turn", "mount", "arm", vec3{0.6, 0.0, 0.8}) << inertia_gen("turn", 0.05)
    << inertia_3D("arm", rigid_body{1.5, vec3{0.02, -0.03, 0.1}, sym3{0.03, 0.001, -0.002, 0.025, 0.003, 0.02}})
    << spherical_joint_3D("ball", "arm", "hand")
    << inertia_3D("hand", rigid_body{0.5, vec3{0.0, 0.1, 0.05}, diagonal(0.003, 0.002, 0.0025)});
  c.gravity(vec3{0.3, -0.4, -9.81});
  return c;
}
constexpr std::size_t nq = 6, nv = 5;

struct states {
  std::vector<double> q, v, a;
  explicit states(std::size_t count) {
    random_numbers random(31);
    for (std::size_t i = 0; i < nq * count; ++i) q.push_back(random(3));
    for (std::size_t i = 0; i < nv * count; ++i) v.push_back(random(2)), a.push_back(random(5));
  }
  Eigen::VectorXd one(const std::vector<double>& x, std::size_t n, std::size_t k) const {
    return Eigen::Map<const Eigen::VectorXd>(x.data() + n * k, static_cast<Eigen::Index>(n));
  }
};
/// The largest difference of result k from x, relative to the largest number of x.
template <class X>
double gap(const std::vector<double>& all, std::size_t k, const X& x) {
  double off = 0, size = 0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    off = test::worse(
        off, std::abs(all[k * static_cast<std::size_t>(x.size()) + static_cast<std::size_t>(i)] - x.data()[i]));
    size = test::worse(size, std::abs(x.data()[i]));
  }
  return off / size;
}
/// Both are within half of it of the true result (tests/dynamics/runtime_scalars_test.cpp).
constexpr double rounding = 64 * 0x1p-52;

TEST_CASE("batches of states of a runtime chain") {
  const runtime_chain c = arm();
  auto s = c.make_state();
  REQUIRE(c.nq() == static_cast<int>(nq));
  REQUIRE(c.dofs() == static_cast<int>(nv));
  for (const std::size_t count : {0, 1, 7, 8, 300}) {  // with a rest, and more than one task
    const states x(count);
    std::vector<double> tau(nv * count), acceleration(nv * count), mass(nv * nv * count), threaded(nv * count);
    batch::inverse_dynamics<4>(c, x.q, x.v, x.a, tau);
    batch::inverse_dynamics<4>(c, x.q, x.v, x.a, threaded, batch::threads(2));
    CHECK(tau == threaded);
    batch::forward_dynamics<4>(c, x.q, x.v, x.a, acceleration);
    batch::mass_matrix<4>(c, x.q, mass);
    for (std::size_t k = 0; k < count; ++k) {
      const auto q = x.one(x.q, nq, k), v = x.one(x.v, nv, k), a = x.one(x.a, nv, k);
      CHECK(gap(tau, k, inverse_dynamics(c, s, q, v, a)) < rounding);
      CHECK(gap(acceleration, k, forward_dynamics(c, s, q, v, a)) < rounding);
      CHECK(gap(mass, k, mass_matrix(c, s, q)) < rounding);
    }
  }
}

TEST_CASE("a bad state of a batch does not spoil the others") {
  const runtime_chain c = arm();
  states x(11);
  std::vector<double> good(nv * 11), tau(nv * 11);
  batch::inverse_dynamics<4>(c, x.q, x.v, x.a, good);
  x.v[nv * 6 + 1] = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH(batch::inverse_dynamics<4>(c, x.q, x.v, x.a, tau),
                    test::contains_text("state 6: a velocity is not finite: v[1] of 'turn' is inf"));
  for (std::size_t k = 0; k < 11; ++k)
    for (std::size_t i = 0; i < nv; ++i)
      CHECK((k == 6 ? std::isnan(tau[k * nv + i]) : tau[k * nv + i] == good[k * nv + i]));
  x.v[nv * 6 + 1] = 0;
  std::fill_n(x.q.begin() + nq * 3 + 2, 4, 0.0);
  CHECK_THROWS_WITH(batch::inverse_dynamics<4>(c, x.q, x.v, x.a, tau),
                    test::contains_text("state 3: quaternion 'ball' has length 0"));
  std::vector<double> short_one(nv * 10);
  CHECK_THROWS_WITH(batch::inverse_dynamics<4>(c, x.q, x.v, x.a, short_one), test::contains_text("tau has 50 numbers"));
}

TEST_CASE("matrices of states in rows are refused") {
  const runtime_chain c = arm();  // two states in two rows: as many numbers, and 2 divides 6
  const Eigen::MatrixXd q = Eigen::MatrixXd::Constant(2, 6, 0.1), v = Eigen::MatrixXd::Zero(5, 2);
  Eigen::MatrixXd tau(5, 2), mass(5, 10), flat(25, 2);
  CHECK_THROWS_WITH(batch::inverse_dynamics<4>(c, q, v, v, tau),
                    test::contains_text("q has columns of 2 numbers, a state has 6"));
  CHECK_THROWS_WITH(batch::mass_matrix<4>(c, q, mass), test::contains_text("q has columns of 2 numbers"));
  const Eigen::MatrixXd columns = q.transpose();
  CHECK_NOTHROW(batch::mass_matrix<4>(c, columns, mass));
  CHECK_NOTHROW(batch::mass_matrix<4>(c, columns, flat));
  CHECK(flat.reshaped() == mass.reshaped());
}

TEST_CASE("batches of chains of elements with their own laws") {
  runtime_chain c = arm();
  c << spring_gen("slide", "turn", 0.1, 10.0) << damper_3D("base", "hand", 3.0);
  const states x(19);
  std::vector<double> tau(nv * 19), acceleration(tau);
  batch::inverse_dynamics<4>(c, x.q, x.v, x.a, tau);
  batch::forward_dynamics<4>(c, x.q, x.v, x.a, acceleration);
  auto s = c.make_state();
  for (std::size_t k = 0; k < 19; ++k) {
    CHECK(gap(tau, k, inverse_dynamics(c, s, x.one(x.q, nq, k), x.one(x.v, nv, k), x.one(x.a, nv, k))) < rounding);
    CHECK(gap(acceleration, k, forward_dynamics(c, s, x.one(x.q, nq, k), x.one(x.v, nv, k), x.one(x.a, nv, k))) <
          16 * rounding);
  }
}

}  // namespace runtime_batch_test
