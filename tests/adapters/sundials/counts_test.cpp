#include <kte/adapters/sundials/counts.hpp>

#include "catch.hpp"

namespace counts_test {

using namespace kte;
using kte::sundials::detail::accountant;
using kte::sundials::detail::counts;

TEST_CASE("SUNDIALS: what is counted from zero at each start adds up") {
  accountant a;
  step_statistics all;
  all.rejected = 100, all.jacobians = 200, all.factorizations = 300;
  CHECK(a.add({1, 2, 3, 4}, all) == 3);  // refused for the error, and because Newton's method failed
  CHECK(all.rejected == 103);
  CHECK(all.jacobians == 203);
  CHECK(all.factorizations == 304);
  CHECK(a.add({1, 2, 3, 4}, all) == 0);  // nothing new
  CHECK(a.add({5, 3, 4, 6}, all) == 5);
  CHECK(all.rejected == 108);
  CHECK(all.jacobians == 204);
  CHECK(all.factorizations == 306);
  a.restart();
  CHECK(a.add({2, 0, 1, 1}, all) == 2);
  CHECK(all.rejected == 110);
  CHECK(all.jacobians == 205);
  CHECK(all.factorizations == 307);
  CHECK(all.steps == 0);
  CHECK(all.evaluations == 0);
}

}  // namespace counts_test
