#include <kte/sweep.hpp>

#include "catch.hpp"
#include "sweep/folder.hpp"

namespace python_test {

TEST_CASE("a file has the bytes of the same sweep in Python") {  // python/tests/test_sweep.py
  const folder at;
  const auto cases = kte::random_cases(8, 7, {kte::uniform("u", -1, 3)}) *
                     kte::sobol_cases(4, {kte::uniform("s", 0, 1), kte::uniform("t", 1, 9)});
  kte::sweep(cases, {"sum", "product"}, [](const auto& c) {
    return std::array{c["u"] + c["s"], c["s"] * c["t"]};
  }).to(at / "x.csv");
  CHECK(bytes_of(at / "x.csv") ==
        bytes_of(std::filesystem::path(__FILE__).parent_path().parent_path() / "data/sweep_cases.csv"));
}

}  // namespace python_test
