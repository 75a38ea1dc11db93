#include "dynamics/tree_motion.hpp"

// Forward dynamics by articulated bodies in a tree with everything that it can do, and of arguments that are not
// finite.

namespace articulated_tree_test {

using namespace kte;
using namespace kte::test::trees;
using models::element_by_element;

TEST_CASE("a tree in space") {
  STATIC_REQUIRE(by_articulated_bodies<decltype(tree_3D)>);
  check(tree_3D, 1, usual, base, cart, motor);
}

TEST_CASE("articulated bodies with arguments that are not finite") {
  const auto model = element_by_element(tree_3D);
  auto s = make_state(tree_3D);
  auto r = model.make_state();
  random_numbers random(10);
  const trial<std::remove_const_t<decltype(tree_3D)>> good(random);
  const auto rejected = [&](const auto& x) {
    CHECK_THROWS_AS(forward_dynamics(tree_3D, x.q, x.v, x.tau), bad_argument);
    CHECK_THROWS_AS(forward_dynamics(model, r, x.q, x.v, x.tau), bad_argument);
    set_positions(s, x.q), set_velocities(s, x.v);
    if (x.tau == good.tau) CHECK_THROWS_AS(forward_dynamics(tree_3D, s), bad_argument);
  };
  CHECK_NOTHROW(forward_dynamics(model, r, good.q, good.v, good.tau));
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -HUGE_VAL}) {
    CAPTURE(bad);
    for (Eigen::Index i = 0; i < good.q.size(); ++i) {
      auto x = good;
      x.q[i] = bad;
      rejected(x);
    }
    for (Eigen::Index i = 0; i < good.v.size(); ++i) {
      auto x = good;
      x.v[i] = bad;
      rejected(x);
      x = good;
      x.tau[i] = bad;
      rejected(x);
    }
  }
  // rotations of length 0
  for (const Eigen::Index i : {4, 8}) {
    auto x = good;
    x.q.segment<4>(i).setZero();
    const auto no_rotation = kte::test::contains_text("has length 0");
    rejected(x);
    CHECK_THROWS_WITH(forward_dynamics(tree_3D, x.q, x.v, x.tau), no_rotation);
    CHECK_THROWS_WITH(forward_dynamics(model, r, x.q, x.v, x.tau), no_rotation);
  }
  // what comes from outside
  const auto given = [&](const auto& spoil) {
    auto t = make_state(tree_3D);
    set_positions(t, good.q), set_positions(r, good.q), set_velocities(r, good.v);
    spoil(t);
    CHECK_THROWS_AS(forward_dynamics(tree_3D, t), bad_argument);
    auto u = model.make_state();
    set_positions(u, good.q);
    spoil(u);
    CHECK_THROWS_AS(forward_dynamics(model, u), bad_argument);
  };
  const double bad = std::numeric_limits<double>::quiet_NaN();
  given([&](auto& t) { thing_of(t, base).acceleration.y = bad; });
  given([&](auto& t) { thing_of(t, cart).ang_velocity.x = bad; });
  given([&](auto& t) { thing_of(t, cart).position.x = bad; });
  given([&](auto& t) { thing_of(t, motor) = bad; });
}

}  // namespace articulated_tree_test
