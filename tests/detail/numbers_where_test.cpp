#include <kte/detail/numbers_where.hpp>

#include <type_traits>

#include "catch.hpp"

namespace numbers_where_test {

using kte::detail::numbers_where;

TEST_CASE("numbers for which something holds, as a type") {
  using some = numbers_where<std::array{false, true, true, false, true}>;
  STATIC_REQUIRE(some::count == 3);
  STATIC_REQUIRE(std::is_same_v<some::type, std::index_sequence<1, 2, 4>>);
  STATIC_REQUIRE(std::is_same_v<numbers_where<std::array{false, false}>::type, std::index_sequence<>>);
  STATIC_REQUIRE(std::is_same_v<numbers_where<std::array<bool, 0>{}>::type, std::index_sequence<>>);
}

}  // namespace numbers_where_test
