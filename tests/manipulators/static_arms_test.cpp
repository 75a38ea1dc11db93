#include <kte/manipulators/iiwa14.hpp>
#include <kte/manipulators/nearest.hpp>
#include <kte/manipulators/panda.hpp>
#include <kte/manipulators/ssrms.hpp>
#include <kte/manipulators/three_r.hpp>
#include <kte/manipulators/three_r_three_r.hpp>
#include <kte/manipulators/ur.hpp>

#include "arms.hpp"
#include "chain/registered.hpp"

// Static arms have the answers of the runtime chains of the same elements.

namespace static_arms_test {

using namespace kte;

joint_limits<> listed(const auto& limits) {
  const auto list = [](const auto& x) { return std::vector<double>(x.begin(), x.end()); };
  return {list(limits.lower),        list(limits.upper), list(limits.rate),
          list(limits.acceleration), list(limits.jerk),  list(limits.effort)};
}
/// The largest difference of an angle. Axes are read off static chains by their rotations, off runtime chains by the
/// Jacobian: so both have them to rounding.
template <class Arm, class... Request>
double difference(const char* name, const Arm& arm, const Request&... request) {
  INFO(name);
  const manipulator twin(models::registered(record_of(arm.chain())), "tool", listed(arm.limits()));
  CHECK(twin.family() == arm.family());
  CHECK(twin.structure().form == arm.structure().form);
  CHECK(twin.limits() == listed(arm.limits()));
  double most = 0;
  random_numbers random(1);
  for (int k = 0; k < 20; ++k) {
    const auto q = arms::random_posture(random, twin.dofs());
    const auto x = twin.getDependentPoses(q)[0];
    const auto one = inverse_kinematics(arm, x, request...);
    const auto two = inverse_kinematics(twin, x, request...);
    REQUIRE(one.size() == two.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
      CHECK(one[i].branch == two[i].branch);
      CHECK(one[i].exact == two[i].exact);
      CHECK(one[i].free == two[i].free);
      CHECK(one[i].within_limits == two[i].within_limits);
      if (one[i].exact) most = test::worse(most, (one[i].q - two[i].q).cwiseAbs().maxCoeff());
    }
  }
  return most;
}

TEST_CASE("static = runtime, to rounding: an arm for each of the formulas") {
  static_assert(ur().with_axes_within(1e-4).family() == arm_family::three_parallel);
  CHECK(difference("3R in the plane", three_r_2D()) <= 1e-12);
  CHECK(difference("3R3R", three_r_three_r()) <= 1e-12);
  CHECK(difference("UR5", ur()) <= 1e-12);
  CHECK(difference("iiwa14", iiwa14(), arm_angle(0.3)) <= 1e-12);
  CHECK(difference("Panda", panda(), locked("q7", 0.3)) <= 1e-12);
  CHECK(difference("SSRMS", ssrms(), locked("q7", 0.3)) <= 1e-12);
}

}  // namespace static_arms_test
