#include <kte/contract/freedom.hpp>
#include <kte/dynamics/state_vectors.hpp>
#include <kte/elements/free_joint.hpp>
#include <kte/elements/mimic.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include <vector>

#include "catch.hpp"

// The degrees of freedom of a chain in a list: generalized coordinates that stand in a row are gone through as one.

namespace freedom_test {

using namespace kte;

/// Six coordinates and a pose: two in a row, a pose, one, one that follows, two in a row.
runtime_chain with_gaps() {
  runtime_chain c;
  c << revolute_joint_3D("a", "base", "A", axis::z) << revolute_joint_3D("b", "A", "B", axis::y)
    << free_joint_3D("pose", "B", "P") << revolute_joint_3D("c", "P", "C", axis::x) << mimic_gen("c", "follower", 2.0)
    << revolute_joint_3D("f", "C", "F", axis::y) << revolute_joint_3D("d", "F", "D", axis::z);
  return c;
}

TEST_CASE("rows of generalized coordinates end where another thing stands between") {
  const auto c = with_gaps();
  const auto& free = c.wiring().free;
  std::vector<int> rows;
  for (std::size_t i = 0; i < free.size(); i += static_cast<std::size_t>(free[i].in_row)) {
    rows.push_back(free[i].in_row);
    for (int k = 0; k < free[i].in_row; ++k) {
      const auto& x = free[i + static_cast<std::size_t>(k)];
      CHECK(x.what == free[i].what);
      CHECK(x.slot == free[i].slot + k);
      CHECK(x.q == free[i].q + k);
      CHECK(x.v == free[i].v + k);
    }
  }
  CHECK(rows == std::vector<int>{2, 1, 1, 2});
}

TEST_CASE("every number of a vector comes to its coordinate") {
  auto c = with_gaps();
  auto s = c.make_state();
  Eigen::VectorXd q = Eigen::VectorXd::LinSpaced(s.nq(), 1, s.nq()), v = Eigen::VectorXd::LinSpaced(s.dofs(), 21, 31);
  set_positions(s, q), set_velocities(s, v);
  CHECK(positions(s) == q);
  CHECK(velocities(s) == v);
  CHECK(s.coordinate("a").q == 1);
  CHECK(s.coordinate("b").q == 2);
  CHECK(s.coordinate("c").q == 10);
  CHECK(s.coordinate("f").q == 11);
  CHECK(s.coordinate("d").q == 12);
  CHECK(s.coordinate("d").q_dot == 31);
}

TEST_CASE("an input named as the time is the time") {
  STATIC_REQUIRE(detail::is_time(kind::input, chain_time_::name));
  STATIC_REQUIRE_FALSE(detail::is_time(kind::gen, chain_time_::name));
  STATIC_REQUIRE_FALSE(detail::is_time(kind::input, "torque"));
}

}  // namespace freedom_test
