#include <kte/elements/free_joint.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/models/joint_limits.hpp>

#include <cmath>

#include "catch.hpp"

namespace joint_limits_test {

using namespace kte;
using test::says;

constexpr struct q1_ final : coord_key<"q1"> {
} q1;
constexpr struct q2_ final : coord_key<"q2"> {
} q2;
constexpr struct ground_ final : frame_2D_key<"ground"> {
} ground;
constexpr struct arm_ final : frame_2D_key<"arm"> {
} arm;
constexpr struct hand_ final : frame_2D_key<"hand"> {
} hand;
constexpr auto two = chain(revolute_joint_2D(q1, ground, arm), revolute_joint_2D(q2, arm, hand));
constexpr double inf = joint_limits<>::none;

/// A trunk and a head.
runtime_chain floating() {
  runtime_chain c;
  c << free_joint_3D("trunk", "world", "body") << revolute_joint_3D("neck", "body", "head");
  return c;
}

TEST_CASE("limits are infinite unless they are given") {
  constexpr auto all = unlimited(two);
  static_assert(std::is_same_v<decltype(all), const joint_limits<std::array<double, 2>>>);
  static_assert(all == joint_limits<std::array<double, 2>>{});
  for (const auto* list : {&all.upper, &all.rate, &all.acceleration, &all.jerk, &all.effort})
    CHECK(*list == std::array{inf, inf});
  CHECK(all.lower == std::array{-inf, -inf});

  constexpr joint_limits<std::array<double, 2>> above{.upper = {1, 2}};
  for (const auto* list : {&above.rate, &above.acceleration, &above.jerk, &above.effort})
    CHECK(*list == std::array{inf, inf});

  const auto same = unlimited(floating());
  for (const auto* list : {&same.upper, &same.rate, &same.acceleration, &same.jerk, &same.effort})
    CHECK(*list == std::vector<double>(7, inf));
  CHECK(same.lower == std::vector<double>(7, -inf));
  CHECK_NOTHROW(check_limits(floating(), same));
  CHECK_NOTHROW(check_limits(two, all));
}

TEST_CASE("limits of a static chain are checked by the compiler") {
  constexpr bool good = [] {
    auto limits = unlimited(two);
    limits.lower = {-1, 0.5}, limits.upper = {1, 0.5}, limits.rate = {0, 2};
    check_limits(two, limits);
    return true;
  }();
  CHECK(good);
}

TEST_CASE("limits that is invalid are refused, with the coordinate") {
  auto limits = unlimited(two);
  limits.lower[1] = 2, limits.upper[1] = 1;
  CHECK_THROWS_MATCHES(check_limits(two, limits), bad_parameter,
                       says("kte: limits of coordinate 'q2': lower must not be above upper, got 2 and 1"));
  limits = unlimited(two), limits.upper[0] = std::nan("");
  CHECK_THROWS_MATCHES(check_limits(two, limits), bad_parameter, says("'q1': lower must not be above upper"));

  const auto c = floating();
  const auto refused = [&c](std::vector<double> joint_limits<>::*list, std::size_t i, double x, const char* text) {
    auto l = unlimited(c);
    (l.*list)[i] = x;
    CHECK_THROWS_MATCHES(check_limits(c, l), bad_parameter, says(text));
  };
  refused(&joint_limits<>::rate, 6, -1, "coordinate 'neck': rate must not be negative, got -1");
  refused(&joint_limits<>::acceleration, 6, std::nan(""), "coordinate 'neck': acceleration must not be negative");
  refused(&joint_limits<>::jerk, 0, -2, "coordinate 'trunk', number 1 of v: jerk");
  refused(&joint_limits<>::effort, 5, -2, "coordinate 'trunk', number 6 of v: effort");

  auto sizes = unlimited(c);
  sizes.jerk.pop_back();
  CHECK_THROWS_MATCHES(check_limits(c, sizes), bad_parameter,
                       says("jerk must have 7 numbers, one for each of v, got 6"));
  CHECK_THROWS_MATCHES(check_limits(c, joint_limits<>{}), bad_parameter, says("lower must have 7 numbers"));
}

}  // namespace joint_limits_test
