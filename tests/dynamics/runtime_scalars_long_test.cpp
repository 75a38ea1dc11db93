#include "dynamics/runtime_scalars.hpp"

namespace runtime_scalars_long_test {

// Runtime chains in float and long double: all algorithms once more, which takes long to compile.

using namespace kte;
using namespace kte::test::runtime_scalars;

TEST_CASE("runtime chains in float and long double", "[long]") {
  const runtime_chain c = creature();
  random_numbers random(11);
  for (int i = 0; i < 5; ++i) {
    const sample x(c, random);
    const auto exact = results_in<kte::test::digits50>(c, x);
    check<long double>(c, x, exact), check<float>(c, x, exact);
  }
}

TEST_CASE("derivatives of runtime chains of joints that share coordinates, in float and long double", "[long]") {
  check_shared<float>();
  check_shared<long double>();
}

}  // namespace runtime_scalars_long_test
