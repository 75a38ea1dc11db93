#include <kte/errors.hpp>

#include <stdexcept>
#include <string>

#include "catch.hpp"

namespace raise_test {

using kte::detail::raise;
using kte::detail::require;

constexpr int positive(int x) {
  require<std::invalid_argument>(
      x > 0, [] { return std::string("not positive"); }, "positive", x);
  return x;
}

TEST_CASE("errors are thrown with what they are made of") {
  CHECK_THROWS_WITH(raise<std::runtime_error>("why"), "why");
  CHECK_THROWS_AS(raise<std::out_of_range>("why"), std::out_of_range);
}

TEST_CASE("zero bytes do not cut a message short") {
  CHECK_THROWS_WITH(raise<kte::unknown_name>(std::string("no '\0a\0'", 8) + ", but others"),
                    "no '\\x00a\\x00', but others");
}

TEST_CASE("what is required says why it fails, and costs constant expressions nothing") {
  STATIC_REQUIRE(positive(3) == 3);
  CHECK_THROWS_WITH(positive(-1), "not positive");
}

}  // namespace raise_test
