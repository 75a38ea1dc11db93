#include <kte/elements/rigid_link.hpp>

#include "catch.hpp"
#include "elements/laws.hpp"

namespace rigid_link_test {

using namespace kte;
using namespace kte::test;

template <class S>
void check_laws() {
  random_numbers draw(1);
  const auto check = [&](const auto& link) {
    CHECK(testing::motion_is_derivative<S>(link, draw) <= by_differences<S>);
    CHECK(testing::power_is_kept<S>(link, draw) <= rounding<S>);
  };
  const vec3<S> r{S(1) / 3, S(-2) / 5, S(1) / 7};
  const auto q = to_quaternion(r);
  check(rigid_link_2D("a", "b", along_x(S(1) / 3)));
  check(rigid_link_2D("a", "b", vec2{S(1) / 3, S(2) / 7}, rotation_by(S(7) / 5)));
  check(rigid_link_2D("a", "b", zero3{}, quarter_turn));
  check(rigid_link_3D("a", "b", r));
  check(rigid_link_3D("a", "b", r, quarter_turn_x));
  check(rigid_link_3D("a", "b", along_z(S(1) / 3), half_turn_z * quarter_turn_x));
  check(rigid_link_3D("a", "b", r, q));
  check(rigid_link_3D("a", "b", r, matrix(q)));
  check(rigid_link_gen("a", "b", S(1) / 3));
}

TEST_CASE("rigid links obey the laws") {
  check_laws<double>();
  check_laws<digits50>();
}

TEST_CASE("a link by quaternion, by matrix and by typed turns is the same") {
  const vec3 r{0.3, -0.2, 0.7};
  const auto turn = quarter_turn_x * quarter_turn_z;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    auto a = trial_of(rigid_link_3D("a", "b", r, turn), seed);
    auto b = trial_of(rigid_link_3D("a", "b", r, as<double>(turn)), seed);
    auto c = trial_of(rigid_link_3D("a", "b", r, to_quaternion(turn)), seed);
    CHECK(near(a.output().position, b.output().position, 2 * eps<double>));
    CHECK(near(a.output().velocity, b.output().velocity, rounding<double>));
    CHECK(near(a.output().acceleration, b.output().acceleration, rounding<double>));
    CHECK(near(c.output().velocity, b.output().velocity, rounding<double>));
    CHECK(near(c.output().acceleration, b.output().acceleration, rounding<double>));
    CHECK(near(c.output().rotation.y, b.output().rotation.y, rounding<double>));
  }
}

TEST_CASE("a lever: the force at its end, with its torque, reaches the base") {
  auto x = trial_of(rigid_link_2D("a", "b", along_x(2.0), quarter_turn), 1);
  x.output().force = {3.0, 0.0};  // along y of the base
  x.output().torque = 0.5;
  x.doForce();
  CHECK(x.at<0>().force == vec2{0.0, 3.0});
  CHECK(x.at<0>().torque == 6.5);
}

TEST_CASE("a coordinate at a distance follows, and hands its force back") {
  auto x = trial_of(rigid_link_gen("a", "b", 0.25), 1);
  x.at<0>() = {.q = 1.5, .q_dot = -2.0, .q_ddot = 3.0, .f = 10.0};
  x.doMotion();
  CHECK(x.output().q == 1.75);
  CHECK(x.output().q_dot == -2.0);
  CHECK(x.output().q_ddot == 3.0);
  x.output().f = 7.0;
  x.doForce();
  CHECK(x.at<0>().f == 17.0);
}

TEST_CASE("a rigid link keeps NaN") {
  auto x = trial_of(rigid_link_3D("a", "b", along_x(1.0)), 1);
  x.at<0>().ang_velocity.z = not_a_number;
  x.doMotion();
  CHECK(std::isnan(x.output().velocity.y));
}

TEST_CASE("a rigid link wants a finite position and a rotation") {
  const auto what = [](const auto&... arguments) {
    return complaint([&] { (void)rigid_link_3D("shoulder", "elbow", arguments...); });
  };
  const std::string where = "kte: rigid_link_3D (base 'shoulder', end 'elbow'): ";
  CHECK(what(vec3{0.0, not_a_number, 0.0}) == where + "position must be finite, got nan");
  CHECK(what(along_z(-infinity)) == where + "position must be finite, got -inf");
  const std::string rotation = where + "rotation must be orthonormal and right-handed";
  const auto with = [&](const mat3<>& m) { return what(zero3{}, m); };
  CHECK(with({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) == "");
  CHECK(with({{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}) == rotation + ", got -1");  // left-handed
  CHECK(with({{1, 0, 0}, {0, 2, 0}, {0, 0, 0.5}}).starts_with(rotation));
  CHECK(with({{1, 0, 0}, {0.6, 0.8, 0}, {0, 0, 1}}) == rotation + ", got 0.80000000000000004");  // oblique
  CHECK(with({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}) == rotation + ", got 0");
  CHECK(with({{1, 0, 0}, {0, not_a_number, 0}, {0, 0, 1}}) == rotation + ", got nan");
  CHECK(what(zero3{}, unit_quaternion<>{0.6, 0.0, 0.0, 0.8}) == "");
  CHECK(what(zero3{}, unit_quaternion<>{0.5, 0.0, 0.0, 0.8}).starts_with(rotation));
  CHECK(what(zero3{}, unit_quaternion<>{2.0, 0.0, 0.0, 0.0}).starts_with(rotation));
  CHECK(what(zero3{}, unit_quaternion<>{0.0, 0.0, 0.0, 0.0}).starts_with(rotation));
  CHECK(complaint([] {
          (void)rigid_link_2D("a", "b", zero3{}, rotation_2D{0.9, 0.9});
        }).starts_with("kte: rigid_link_2D (base 'a', end 'b'): rotation must be orthonormal and right-handed"));
  CHECK(complaint([] { (void)rigid_link_gen("a", "b", not_a_number); }) ==
        "kte: rigid_link_gen (base 'a', end 'b'): offset must be finite, got nan");
}

}  // namespace rigid_link_test
