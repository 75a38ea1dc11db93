#include <kte/contract/nearest_name.hpp>

#include "catch.hpp"

namespace nearest_name_test {

using namespace kte::detail;

TEST_CASE("letters put in, left out, changed and exchanged are counted, over again for more") {
  CHECK(edit_distance("elbow", "elbow") == 0);
  CHECK(edit_distance("", "elbow") == 5);
  CHECK(edit_distance("elbow", "") == 5);
  CHECK(edit_distance("elbw", "elbow") == 1);
  CHECK(edit_distance("ellbow", "elbow") == 1);
  CHECK(edit_distance("elbou", "elbow") == 1);
  CHECK(edit_distance("eblow", "elbow") == 1);
  CHECK(edit_distance("kitten", "sitting") == 3);
  CHECK(edit_distance("ca", "abc") == 3);  // of aligned strings: none is edited twice
  STATIC_REQUIRE(edit_distance("hip", "knee") == edit_distance("knee", "hip"));
  const std::string long_name(64, 'a');
  CHECK(edit_distance(long_name, long_name) == 63);
}

TEST_CASE("the nearest name differs in a letter, or in a third of them") {
  const std::vector<std::string> known{"shoulder", "elbow", "elbow2", "q", "hip", "lip"};
  CHECK(nearest_name("elbw", known) == 1);
  CHECK(nearest_name("elbow3", known) == 1);  // the first of two that are as near
  CHECK(nearest_name("sholder", known) == 0);
  CHECK(nearest_name("shuolder", known) == 0);
  CHECK(nearest_name("sh0u1der", known) == 0);  // two of eight
  CHECK(nearest_name("hop", known) == 4);
  CHECK(nearest_name("zip", known) == 4);
  for (const char* far : {"wrist", "p", "hinge", ""}) CHECK(nearest_name(far, known) == known.size());
  CHECK(did_you_mean("elbw", known) == ", did you mean 'elbow'?");
  CHECK(did_you_mean("wrist", known).empty());
}

TEST_CASE("the first eight names are listed") {
  CHECK(list_of_names({}) == "there are none");
  CHECK(list_of_names({"base", "elbow"}) == "there are 'base', 'elbow'");
  CHECK(list_of_names({"1", "2", "3", "4", "5", "6", "7", "8", "9", "10"}) ==
        "there are '1', '2', '3', '4', '5', '6', '7', '8' and 2 more");
}

}  // namespace nearest_name_test
