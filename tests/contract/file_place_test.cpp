#include <kte/contract/file_place.hpp>
#include <kte/contract/record.hpp>

#include "catch.hpp"

namespace file_place_test {

using namespace kte;

TEST_CASE("a place in a file begins a message, one of a program does not") {
  const auto file = std::make_shared<const std::string>("arms/arm.json");
  CHECK(to_string(file_place{file, 12, 5}) == "arms/arm.json:12:5: ");
  CHECK(to_string(file_place{file, 0, 120}) == "arms/arm.json, byte 120: ");
  CHECK(to_string(file_place{}).empty());
  CHECK(to_string(file_place{nullptr, 12, 5}).empty());
}

TEST_CASE("places share the name of their file") {
  file_place a{std::make_shared<const std::string>("a.xml"), 1, 2};
  const file_place b = a;
  CHECK(b.file == a.file);
  a = {};
  CHECK(to_string(b) == "a.xml:1:2: ");
}

TEST_CASE("where it was read is no part of a value") {
  const file_place here{std::make_shared<const std::string>("a.xml"), 1, 2};
  CHECK(here == file_place{});
  const parameter_record number{"mass", {1.5}}, read{"mass", {1.5}, here}, other{"mass", {2.5}, here};
  CHECK(number == read);
  CHECK(number != other);
  const element_record made{"spring_gen", 1, {{"anchor1", "q"}}, {number}};
  CHECK(made == element_record{"spring_gen", 1, {{"anchor1", "q", here}}, {read}, here});
  CHECK(made != element_record{"spring_gen", 1, {{"anchor1", "p", here}}, {read}, here});
}

}  // namespace file_place_test
