#include <kte/elements/damper.hpp>

#include "catch.hpp"
#include "elements/laws.hpp"

namespace damper_test {

using namespace kte;
using namespace kte::test;

/// Moved by one more motion, positions and velocities are up to 5, with some 8 roundings each, in a product, which may
/// be small when they are not: relative to the force, four times the usual.
template <class S>
S along_a_line() {
  return 4 * rounding<S>;
}

template <class S>
void check_laws() {
  random_numbers draw(1);
  const auto damper = damper_gen("a", "b", S(7) / 3);
  CHECK(testing::loads_are_opposite<S>(damper, draw) == 0);
  CHECK(testing::no_work_done<S>(damper, draw) == 0);
  const auto check = [&](const auto& element) {
    CHECK(testing::loads_are_opposite<S>(element, draw) <= rounding<S>);
    CHECK(testing::no_work_done<S>(element, draw) <= rounding<S>);
    CHECK(change_when_moved<S>(element, draw) <= along_a_line<S>());
  };
  const auto flat = damper_2D("a", "b", S(7) / 3);
  const auto solid = damper_3D("a", "b", S(7) / 3);
  check(flat), check(solid);
  CHECK(planar_difference<S>(flat, solid, draw) <= along_a_line<S>());
}

auto push(double c, double v1, double v2) {
  auto x = trial_of(damper_gen("a", "b", c), 1);
  x.at<0>() = {.q_dot = v1};
  x.at<1>() = {.q_dot = v2};
  x.doForce();
  return std::pair{x.at<0>().f, x.at<1>().f};
}

TEST_CASE("dampers obey the laws") {
  check_laws<double>();
  check_laws<digits50>();
}

TEST_CASE("a damper pulls its anchors to one speed") {
  CHECK(push(0.5, 1.0, 5.0) == std::pair{2.0, -2.0});
  CHECK(push(0.5, 5.0, 1.0) == std::pair{-2.0, 2.0});
  CHECK(push(0.5, 3.0, 3.0) == std::pair{0.0, 0.0});
  CHECK(std::isnan(push(0.5, not_a_number, 3.0).second));
}

TEST_CASE("a damper wants a damping that is not negative") {
  const std::string where = "kte: damper_gen (anchor1 'hip', anchor2 'knee'): damping must be finite and not negative";
  const auto what = [](double c) { return complaint([&] { (void)damper_gen("hip", "knee", c); }); };
  CHECK(what(-0.5) == where + ", got -0.5");
  CHECK(what(not_a_number) == where + ", got nan");
  CHECK(what(infinity) == where + ", got inf");
  CHECK(what(0) == "");
  const std::string on_frames = "(anchor1 'hip', anchor2 'knee'): damping must be finite and not negative, got ";
  CHECK(complaint([] { (void)damper_2D("hip", "knee", -0.5); }) == "kte: damper_2D " + on_frames + "-0.5");
  CHECK(complaint([] { (void)damper_3D("hip", "knee", not_a_number); }) == "kte: damper_3D " + on_frames + "nan");
  CHECK(complaint([] { (void)damper_3D("hip", "knee", 0); }) == "");
}

TEST_CASE("a damper between frames works along the line through them") {
  auto x = trial_of(damper_2D("a", "b", 0.5), 1);
  x.at<0>() = {.position = {1.0, 1.0}, .velocity = {2.0, 0.0}, .ang_velocity = 7.0};
  x.at<1>() = {.position = {4.0, 5.0}, .rotation = {0.0, 1.0}, .velocity = {0.0, -10.0}};  // (10, 0) in the world
  x.doForce();
  // The line is (0.6, 0.8); 8 m/s have 4.8 along it; 2.4 N are (1.44, 1.92).
  const auto is = [](const vec2<>& v, double a, double b) {  // some 4 roundings of numbers up to 10
    return std::abs(v.x - a) <= 20 * eps<double> && std::abs(v.y - b) <= 20 * eps<double>;
  };
  CHECK(is(x.at<0>().force, 1.44, 1.92));
  CHECK(is(x.at<1>().force, -1.92, 1.44));
  CHECK(x.at<0>().torque == 0.0);
  CHECK(x.at<1>().torque == 0.0);
}

TEST_CASE("a damper does nothing to what moves across its line") {
  auto x = trial_of(damper_3D("a", "b", 0.5), 1);
  x.at<0>() = {};
  x.at<1>() = {.position = {0.0, 0.0, 2.0}, .velocity = {3.0, -5.0, 0.0}, .ang_velocity = {1.0, 2.0, 3.0}};
  x.doForce();
  CHECK(x.at<0>().force == vec3<>{});
  CHECK(x.at<1>().force == vec3<>{});
}

TEST_CASE("a damper whose ends coincide gives no force, and no NaN") {
  auto x = trial_of(damper_3D("a", "b", 0.5), 1);
  x.at<0>().position = x.at<1>().position;
  x.doForce();
  CHECK(x.at<0>().force == vec3<>{});
  CHECK(x.at<1>().force == vec3<>{});
  x.at<0>().velocity.x = not_a_number;
  x.doForce();
  CHECK(std::isnan(x.at<1>().force.x));
}

}  // namespace damper_test
