#include <kte/elements/constant_force.hpp>

#include "catch.hpp"
#include "chain/registered.hpp"
#include "elements/laws.hpp"

namespace constant_force_test {

using namespace kte;
using namespace kte::test;

template <class S>
void check_laws() {
  random_numbers draw(1);
  const auto energy_of_one = [](const auto& e) {
    return [core = e.core](const auto& x) { return core.potential_energy(spatial(x)); };
  };
  const S f = S(7) / 3;
  const auto flat = constant_force_2D("a", vec2{f, S(-2 * f)});
  const auto solid = constant_force_3D("a", vec3{f, S(-2 * f), S(3 * f)});
  CHECK(testing::force_is_gradient<S>(flat, draw, energy_of_one(flat)) <= 4 * f * by_differences<S>);
  CHECK(testing::force_is_gradient<S>(solid, draw, energy_of_one(solid)) <= 4 * f * by_differences<S>);
}

TEST_CASE("constant forces obey the laws") { check_laws<double>(), check_laws<digits50>(); }

TEST_CASE("a constant force keeps its direction in the world, a follower in its frame") {
  auto dead = trial_of(constant_force_2D("a", vec2{3.0, 4.0}, 5), 1);
  dead.at<0>().rotation = {0, 1};  // a quarter turn
  dead.doForce();
  CHECK(dead.at<0>().force == vec2{4.0, -3.0});
  CHECK(dead.at<0>().torque == 5.0);
  auto follower = trial_of(follower_force_2D("a", vec2{3.0, 4.0}, 5), 1);
  follower.doForce();
  CHECK(follower.at<0>().force == vec2{3.0, 4.0});
  CHECK(follower.at<0>().torque == 5.0);
  const vec3 f{1.0, 2.0, 3.0}, t{4.0, 5.0, 6.0};
  auto solid = trial_of(constant_force_3D("a", f, t), 1);
  solid.at<0>().rotation = as<double>(quarter_turn_x);  // y to z
  solid.doForce();
  CHECK(solid.at<0>().force == vec3{1.0, 3.0, -2.0});
  CHECK(solid.at<0>().torque == vec3{4.0, 6.0, -5.0});
  auto thruster = trial_of(follower_force_3D("a", f, t), 1);
  thruster.doForce();
  CHECK(thruster.at<0>().force == f);
  CHECK(thruster.at<0>().torque == t);
}

TEST_CASE("constant forces are saved and loaded, and reject what is not finite") {
  runtime_chain c;
  c << base_2D("a") << constant_force_2D("a", vec2{1.0, 2.0}, 3.0) << follower_force_2D("a", vec2{4.0, 5.0}, 6.0)
    << base_3D("b") << constant_force_3D("b", along_x(7.0), along_y(8.0)) << follower_force_3D("b", along_z(9.0));
  CHECK(record_of(models::registered(record_of(c))) == record_of(c));
  CHECK(complaint([] {
          (void)constant_force_2D("a", vec2{1.0, infinity});
        }) == "kte: constant_force_2D (frame 'a'): force must be finite, got inf");
  CHECK(complaint([] {
          (void)follower_force_3D("a", along_x(1.0), along_x(not_a_number));
        }).starts_with("kte: follower_force_3D (frame 'a'): torque must be finite"));
}

}  // namespace constant_force_test
