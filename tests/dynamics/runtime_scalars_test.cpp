#include "dynamics/runtime_scalars.hpp"

namespace runtime_scalars_test {

// Runtime chains in 50 digits, in packs, in dual numbers, and in double. Other scalars are in
// runtime_scalars_long_test.cpp.

using namespace kte;
using namespace kte::test::runtime_scalars;
using kte::test::digits50;
using kte::test::within;

TEST_CASE("runtime chains in other scalars") {
  const runtime_chain c = creature();
  random_numbers random(11);
  for (int i = 0; i < 5; ++i) {
    const sample x(c, random);
    const auto exact = results_in<digits50>(c, x);
    check<double>(c, x, exact);
  }
}

TEST_CASE("several states of a runtime chain at once") {
  using four = pack<double, 4>;
  const runtime_chain c = creature();
  random_numbers random(12);
  const std::array<sample, 4> x{sample(c, random), sample(c, random), sample(c, random), sample(c, random)};
  const auto gathered = [&x](Eigen::VectorXd sample::*which) {
    runtime_vector<four> y((x[0].*which).size());
    for (Eigen::Index i = 0; i < y.size(); ++i)
      for (std::size_t k = 0; k < 4; ++k) y[i].set(k, (x[k].*which)[i]);
    return y;
  };
  auto s = c.make_state<four>();
  const auto all = all_results<four>(c, s, gathered(&sample::q), gathered(&sample::v), gathered(&sample::a));
  for (std::size_t k = 0; k < 4; ++k)
    CHECK(gap(all, results_in<digits50>(c, x[k]), [k](const four& y) { return y[k]; }) < roundings * 0x1p-52);
}

TEST_CASE("derivatives of a runtime chain by dual numbers") {
  using number = dual<double, 1>;
  const runtime_chain c = creature();
  random_numbers random(13);
  const sample x(c, random);
  auto plain = c.make_state();
  const auto& r = inverse_dynamics_derivatives(c, plain, x.q, x.v, x.a);
  auto s = c.make_state<number>();
  runtime_vector<number> q = x.q.cast<number>(), v = x.v.cast<number>(), a = x.a.cast<number>();
  for (int i = 0; i < c.dofs(); ++i) {
    v[i].derivative[0] = 1;
    const auto& tau = inverse_dynamics(c, s, q, v, a);
    for (int k = 0; k < c.dofs(); ++k)
      CHECK(tau[k].derivative[0] == within(r.by_v(k, i), 1e-14 * r.by_v.lpNorm<Eigen::Infinity>()));
    v[i].derivative[0] = 0;
  }
}

TEST_CASE("derivatives of runtime chains of joints that share coordinates") { check_shared<double>(); }

TEST_CASE("what other scalars cannot do is said") {
  runtime_chain c = creature();
  c << spring_gen("hip", "knee", 0.0, 10.0);
  CHECK_NOTHROW(c.make_state());
  CHECK_THROWS_WITH(
      c.make_state<digits50>(),
      "kte: states of runtime chains in scalars other than double and packs support joints, links and bodies "
      "only; "
      "spring_gen (anchor1 'hip', anchor2 'knee') has its own force law");
  // passes move what follows others, and are for double
  const auto following = tandem("q", "p", "r");
  auto s = following.make_state<digits50>();
  const runtime_vector<digits50> q = Eigen::Vector3d(0.5, 0.25, 0.125).cast<digits50>();
  const auto says = Catch::Matchers::Message(
      "kte: this algorithm supports only frames that joints and links move, and 'nearest' follows others");
  CHECK_THROWS_MATCHES(forward_kinematics(following, s, q, "nearest"), bad_argument, says);
  CHECK_THROWS_MATCHES(jacobian(following, s, q, "nearest"), bad_argument, says);
  CHECK_THROWS_MATCHES(jacobian(following, s, q, "nearest", in_world_axes), bad_argument, says);
  CHECK_THROWS_MATCHES(relative_pose(following, s, q, "nearest", "a"), bad_argument, says);
  CHECK_NOTHROW(forward_kinematics(following, s, q, "c"));
}

}  // namespace runtime_scalars_test
