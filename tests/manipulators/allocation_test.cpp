#include <kte/manipulators/accelerations_towards.hpp>
#include <kte/manipulators/nearest.hpp>
#include <kte/manipulators/numerical_inverse_kinematics.hpp>
#include <kte/manipulators/three_r_three_r.hpp>

#include "allocations.hpp"
#include "catch.hpp"

namespace allocation_test {

using namespace kte;

TEST_CASE("rates and poses of static arms take no memory from the heap") {
  constexpr auto arm = three_r_three_r();
  const joint_vector<double, 6> q{{0.1, 0.4, 0.3, 0.2, 0.6, 0.1}}, still = joint_vector<double, 6>::Zero();
  const Eigen::Matrix<double, 6, 1> twist{{0.1, 0.2, 3, 0.1, 0.2, 0.3}};
  const auto wanted = forward_kinematics(arm, q, arm_names::tool);
  bool reached = true;
  CHECK(allocations::during([&] {
          reached &= rates_towards(arm, q, still, twist, 0.01).v.norm() > 0;
          reached &= accelerations_towards(arm, q, still, twist, 0.01).a.norm() > 0;
          for (const bool numeric : {true, false})
            reached &=
                numerical_inverse_kinematics(arm, reach(arm_names::tool, wanted), still, {.numeric = numeric}).status ==
                numerical_ik_status::reached;
          reached &= numerical_inverse_kinematics(arm, goals(reach(arm_names::tool, wanted), away_from_limits()), still)
                         .status == numerical_ik_status::reached;
        }) == 0);
  CHECK(reached);
}

TEST_CASE("closed forms of static arms take no memory from the heap") {
  constexpr auto arm = three_r_three_r();
  static_assert(arm.family() == arm_family::spherical_wrist);  // found while compiling
  const joint_vector<double, 6> q{{0.1, 0.4, 0.3, 0.2, 0.6, 0.1}};
  const auto wanted = forward_kinematics(arm, q, arm_names::tool);
  std::size_t answers = 0;
  double off = 0;
  CHECK(allocations::during([&] {
          answers = inverse_kinematics(arm, wanted).size();
          off = (inverse_kinematics(arm, wanted, nearest(q)).q - q).norm();
        }) == 0);
  CHECK(answers == 8);
  CHECK(off == within(0, 1e-13));
}

}  // namespace allocation_test
