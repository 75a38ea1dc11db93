#include <kte/elements/torsion_damper.hpp>

#include "catch.hpp"
#include "elements/laws.hpp"

namespace torsion_damper_test {

using namespace kte;
using namespace kte::test;

template <class S>
void check_laws() {
  random_numbers draw(1);
  const auto check = [&](const auto& damper) {
    CHECK(testing::loads_are_opposite<S>(damper, draw) <= rounding<S>);
    CHECK(testing::no_work_done<S>(damper, draw) <= rounding<S>);
    // Moved by one more motion, angular velocities are up to 5.
    CHECK(change_when_moved<S>(damper, draw) <= 2 * rounding<S>);
  };
  const auto flat = torsion_damper_2D("a", "b", S(7) / 3);
  const auto solid = torsion_damper_3D("a", "b", S(7) / 3);
  check(flat), check(solid);
  CHECK(planar_difference<S>(flat, solid, draw) <= rounding<S>);
}

TEST_CASE("torsion dampers obey the laws") {
  check_laws<double>();
  check_laws<digits50>();
}

TEST_CASE("a torsion damper in the plane") {
  auto x = trial_of(torsion_damper_2D("a", "b", 0.5), 1);
  x.at<0>().ang_velocity = 1.0, x.at<1>().ang_velocity = 5.0;
  x.doForce();
  CHECK(x.at<0>().torque == 2.0);
  CHECK(x.at<1>().torque == -2.0);
  CHECK(x.at<0>().force == vec2<>{});
  CHECK(x.at<1>().force == vec2<>{});
  x.at<0>().ang_velocity = not_a_number;
  x.doForce();
  CHECK(std::isnan(x.at<1>().torque));
}

TEST_CASE("a torsion damper in space compares angular velocities in the same axes") {
  auto x = trial_of(torsion_damper_3D("a", "b", 0.5), 1);
  x.at<0>() = {.ang_velocity = {1.0, 2.0, 3.0}};
  x.at<1>() = {.rotation = as<double>(quarter_turn_z), .ang_velocity = {4.0, 1.0, -1.0}};  // (-1, 4, -1) in the world
  x.doForce();
  CHECK(x.at<0>().torque == vec3{-1.0, 1.0, -2.0});
  CHECK(x.at<1>().torque == vec3{-1.0, -1.0, 2.0});
  CHECK(x.at<0>().force == vec3<>{});
  CHECK(x.at<1>().force == vec3<>{});
}

TEST_CASE("a torsion damper wants a damping that is not negative") {
  const std::string rest = " (anchor1 'hip', anchor2 'knee'): damping must be finite and not negative, got ";
  CHECK(complaint([] { (void)torsion_damper_2D("hip", "knee", -0.5); }) == "kte: torsion_damper_2D" + rest + "-0.5");
  CHECK(complaint([] { (void)torsion_damper_3D("hip", "knee", infinity); }) == "kte: torsion_damper_3D" + rest + "inf");
  CHECK(complaint([] { (void)torsion_damper_3D("hip", "knee", 0); }) == "");
}

}  // namespace torsion_damper_test
