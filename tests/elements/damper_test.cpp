#include <kte/elements/damper.hpp>

#include "catch.hpp"
#include "elements/laws.hpp"

using namespace kte;
using namespace kte::test;

namespace {

template <class S>
void check_laws() {
  random_numbers draw(1);
  const auto damper = damper_gen("a", "b", S(7) / 3);
  CHECK(testing::loads_are_opposite<S>(damper, draw) == 0);
  CHECK(testing::no_work_done<S>(damper, draw) == 0);
}

auto push(double c, double v1, double v2) {
  auto x = trial_of(damper_gen("a", "b", c), 1);
  x.at<0>() = {.q_dot = v1};
  x.at<1>() = {.q_dot = v2};
  x.doForce();
  return std::pair{x.at<0>().f, x.at<1>().f};
}

}  // namespace

TEST_CASE("dampers obey the laws", "[elements][damper]") {
  check_laws<double>();
  check_laws<digits50>();
}

TEST_CASE("a damper pulls its anchors to one speed", "[elements][damper]") {
  CHECK(push(0.5, 1.0, 5.0) == std::pair{2.0, -2.0});
  CHECK(push(0.5, 5.0, 1.0) == std::pair{-2.0, 2.0});
  CHECK(push(0.5, 3.0, 3.0) == std::pair{0.0, 0.0});
  CHECK(std::isnan(push(0.5, not_a_number, 3.0).second));
}

TEST_CASE("a damper wants a damping that is not negative", "[elements][damper]") {
  const std::string where = "kte: damper_gen (anchor1 'hip', anchor2 'knee'): damping must be finite and not negative";
  const auto what = [](double c) { return complaint([&] { damper_gen("hip", "knee", c); }); };
  CHECK(what(-0.5) == where + ", got -0.5");
  CHECK(what(not_a_number) == where + ", got nan");
  CHECK(what(infinity) == where + ", got inf");
  CHECK(what(0) == "");
}
