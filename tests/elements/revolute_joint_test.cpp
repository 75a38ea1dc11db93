#include <kte/elements/revolute_joint.hpp>

#include "catch.hpp"
#include "elements/laws.hpp"

namespace revolute_joint_test {

using namespace kte;
using namespace kte::test;

/// The direction (2, 3, 6)/7 to all digits of S.
template <class S>
vec3<S> oblique() {
  return {S(2) / 7, S(3) / 7, S(6) / 7};
}

template <class S>
void check_laws() {
  random_numbers draw(1);
  const auto check = [&](const auto& joint) {
    CHECK(testing::motion_is_derivative<S>(joint, draw) <= by_differences<S>);
    CHECK(testing::power_is_kept<S>(joint, draw) <= rounding<S>);
  };
  check(revolute_joint_2D("q", "base", "end"));
  check(revolute_joint_3D("q", "base", "end"));
  check(revolute_joint_3D("q", "base", "end", axis::x));
  check(revolute_joint_3D("q", "base", "end", axis::y));
  check(revolute_joint_3D("q", "base", "end", axis::minus_x));
  check(revolute_joint_3D("q", "base", "end", axis::minus_y));
  check(revolute_joint_3D("q", "base", "end", axis::minus_z));
  check(revolute_joint_3D("q", "base", "end", oblique<S>()));
  check(revolute_joint_3D("q", "base", "end", vec3{S(3) / 5, zero, S(4) / 5}));
}

TEST_CASE("revolute joints obey the laws") {
  check_laws<double>();
  check_laws<digits50>();
}

TEST_CASE("a joint about a typed axis is one about a general axis") {
  const auto check = [](const auto& axis) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
      auto typed = trial_of(revolute_joint_3D("q", "b", "e", axis), seed);
      auto general = trial_of(revolute_joint_3D("q", "b", "e", as<double>(axis)), seed);
      const auto &x = typed.output(), &y = general.output();
      CHECK(x.position == y.position);
      const auto close = [](const vec3<>& v, const vec3<>& w) { CHECK(near(v, w, rounding<double>)); };
      close(x.rotation.x, y.rotation.x), close(x.rotation.y, y.rotation.y), close(x.rotation.z, y.rotation.z);
      close(x.velocity, y.velocity), close(x.ang_velocity, y.ang_velocity);
      close(x.acceleration, y.acceleration), close(x.ang_acceleration, y.ang_acceleration);
    }
  };
  check(axis::x), check(axis::y), check(axis::z);
  check(axis::minus_x), check(axis::minus_y), check(axis::minus_z);
}

TEST_CASE("a revolute joint turns by the right-hand rule") {
  const auto x_axis_after_quarter_turn = [](const auto& axis) {
    return as<double>(core::revolute_joint<kind::frame_3D, std::remove_cvref_t<decltype(axis)>>(axis)
                          .relative(coordinate{1.0, zero, zero, 0.0, 1.0})
                          .rotation *
                      vec3{0.5, 2.0, 3.0});
  };
  CHECK(x_axis_after_quarter_turn(axis::x) == vec3{0.5, -3.0, 2.0});
  CHECK(x_axis_after_quarter_turn(axis::y) == vec3{3.0, 2.0, -0.5});
  CHECK(x_axis_after_quarter_turn(axis::z) == vec3{-2.0, 0.5, 3.0});
  CHECK(x_axis_after_quarter_turn(axis::minus_z) == vec3{2.0, -0.5, 3.0});
}

TEST_CASE("a revolute joint leaves no torque along its axis to the base but f") {
  auto x = trial_of(revolute_joint_3D("q", "b", "e", oblique<double>()), 7);
  x.output().force = {1.0, -2.0, 0.5}, x.output().torque = {0.25, 3.0, -1.0};
  x.doForce();
  const double along = dot(oblique<double>(), x.output().torque);
  CHECK(x.at<0>().f == within(along, 4 * eps<double>));
  CHECK(dot(oblique<double>(), x.at<1>().torque) == within(along, rounding<double>));
}

TEST_CASE("a revolute joint keeps NaN") {
  auto x = trial_of(revolute_joint_3D("q", "b", "e"), 3);
  x.at<0>().q = std::numeric_limits<double>::quiet_NaN();
  x.doMotion();
  CHECK(std::isnan(x.output().rotation.x.x));
  CHECK(std::isnan(x.output().velocity.x));
}

TEST_CASE("a revolute joint wants an axis of length 1") {
  const auto what = [](const vec3<>& axis) {
    return complaint([&] { (void)revolute_joint_3D("elbow angle", "upper arm", "forearm", axis); });
  };
  const std::string where = "kte: revolute_joint_3D (coordinate 'elbow angle', base 'upper arm', end 'forearm'): ";
  CHECK(what({0, 0, 0}) == where + "axis must have length 1, got 0");
  CHECK(what({0, 0, 2}) == where + "axis must have length 1, got 2");
  CHECK(what({not_a_number, 0, 1}) == where + "axis must have length 1, got nan");
  CHECK(what({0, -infinity, 1}) == where + "axis must have length 1, got -inf");
  CHECK(what({0.6, 0, 0.8001}) != "");
  CHECK(what({0.6, 0, 0.8}) == "");
  CHECK(what({0.57735026919, 0.57735026919, 0.57735026919}) == "");  // rounded to the digits of a data sheet
}

}  // namespace revolute_joint_test
