// Tables first: numbers of models and of tables as text have once been functions of one name.
// clang-format off
#include <kte/io/text_table.hpp>
#include <kte/io/model_writer.hpp>
// clang-format on

#include "catch.hpp"

namespace model_writer_test {

using kte::test::contains_text;

kte::model_record spring(const std::string& anchor = "b") {
  kte::model_record m;
  m.elements.push_back({"spring_gen", 1, {{"anchor1", "a"}, {"anchor2", anchor}}, {{"stiffness", {100}}}});
  return m;
}

TEST_CASE("hard numbers and names survive") {
  kte::model_record m = spring("a <b> & \"c\" 'd' \\ / \u00e9 ]]> --> \U0001F600");
  m.gravity = {0.1, 1.0 / 3.0, -5e-324};
  m.elements[0].connections[0].name = " with blanks ";
  m.elements[0].parameters = {{"rest_length", {1.7976931348623157e308}},
                              {"stiffness", {2.2250738585072014e-308}},
                              {"saturation", {-0.0}},
                              {"infinite", {-std::numeric_limits<double>::infinity()}},
                              {"none", {}}};
  for (const auto& back : {kte::from_json(kte::to_json(m)), kte::from_xml(kte::to_xml(m))}) {
    CHECK(back == m);
    CHECK(std::signbit(back.elements[0].parameters[2].values[0]));
  }
  CHECK(kte::from_json(kte::to_json({})) == kte::model_record{});
  CHECK(kte::from_xml(kte::to_xml({})) == kte::model_record{});
}

TEST_CASE("what could not be read again is not written") {
  const auto both = [](const kte::model_record& m, const std::string& why) {
    CHECK_THROWS_WITH(kte::to_json(m), contains_text(why));
    CHECK_THROWS_WITH(kte::to_xml(m), contains_text(why));
  };
  kte::model_record m;
  m.gravity = {0, 0, std::nan("")};
  both(m, "kte: the gravity of a model must be three finite numbers, it is '0 0 nan'");
  m.gravity = {0, 0};
  both(m, "three finite numbers, it is '0 0'");
  both(spring("a\nb"), "kte: element 1 (spring_gen): the name 'a\nb' of its anchor2 has a control character");
  both(spring("\x80"), "is not UTF-8");
  both(spring(""), "is empty");
  m = spring();
  m.elements[0].parameters.push_back({"stiffness", {1}});
  both(m, "kte: element 1 (spring_gen): it has two parameters 'stiffness'");
  m = spring();
  m.elements[0].connections[0].role = "the first";
  CHECK(kte::from_json(kte::to_json(m)) == m);
  CHECK_THROWS_WITH(kte::to_xml(m), contains_text("'the first' is a port, but not a name for an XML tag"));
}

}  // namespace model_writer_test
