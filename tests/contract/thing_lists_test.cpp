#include <kte/contract/thing_lists.hpp>

#include <array>

#include "catch.hpp"

// All things of a runtime chain.

namespace thing_lists_test {

using namespace kte;

TEST_CASE("things of a chain are lists by kind, as long as is requested") {
  detail::thing_lists<double> all([](kind k) { return k == kind::gen ? 3 : k == kind::frame_3D ? 2 : 0; });
  all.get<kind::gen>(2).q = 0.5;
  all.get<kind::frame_3D>(1).position.z = 4;
  const auto copy = all;
  all.get<kind::gen>(2).q = 1.5;
  CHECK(copy.get<kind::gen>(2).q == 0.5);
  CHECK(copy.get<kind::gen>(1).q == 0);
  CHECK(copy.get<kind::frame_3D>(1).position.z == 4);
  // One behind the other, as rows of coordinates are gone through (contract/freedom.hpp)
  CHECK(&all.get<kind::gen>(0) + 2 == &all.get<kind::gen>(2));
}

}  // namespace thing_lists_test
