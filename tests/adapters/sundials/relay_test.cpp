#include <kte/adapters/sundials/relay.hpp>

#include <stdexcept>

#include "catch.hpp"

namespace relay_test {

using kte::sundials::detail::relay;

TEST_CASE("SUNDIALS: an exception is kept, the flag says stop, and it is thrown once") {
  relay r;
  CHECK(r.guard([] { return 0; }) == 0);
  CHECK(r.guard([] { return 1; }) == 1);  // to be cured by a shorter step
  CHECK(!r.has_exception());
  CHECK_NOTHROW(r.rethrow());
  struct own {
    int number;
  };
  static_assert(noexcept(r.guard([]() -> int { throw own{3}; })));
  CHECK(r.guard([]() -> int { throw own{3}; }) < 0);
  CHECK(r.guard([] { return 0; }) == 0);  // what goes well later does not hide it
  REQUIRE(r.has_exception());
  try {
    r.rethrow();
    FAIL("nothing was thrown");
  } catch (const own& e) {
    CHECK(e.number == 3);
  }
  CHECK(!r.has_exception());
  CHECK_NOTHROW(r.rethrow());
  CHECK(r.guard([]() -> int { throw std::domain_error("f"); }) < 0);
  CHECK_THROWS_AS(r.rethrow(), std::domain_error);
}

TEST_CASE("SUNDIALS: the last message is kept, in a copy, until the next step") {
  relay r;
  CHECK(r.message().empty());
  char text[] = "first";
  relay::keep_message(-1, "CVODE", "CVode", text, &r);
  text[0] = 'F';
  CHECK(r.message() == "first");
  relay::keep_message(-1, "CVODE", "CVode", text, &r);
  CHECK(r.message() == "First");
  r.clear_message();
  CHECK(r.message().empty());
  CHECK(!r.has_exception());
}

}  // namespace relay_test
