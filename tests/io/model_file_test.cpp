#include <kte/io/model_file.hpp>

#include <clocale>
#include <locale>

#include "catch.hpp"
#include "chain/models.hpp"
#include "robots/iiwa14.hpp"
#include "robots/ur5.hpp"

using namespace models;
using kte::test::contains_text;

namespace {

/// The pendulum of the tutorial, as its golden files hold it.
constexpr auto golden = pendulum.gravity(kte::along_y(-9.81));
const std::filesystem::path data = std::filesystem::path(__FILE__).parent_path().parent_path() / "data";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}
/// A decimal comma, as in half of the world.
struct comma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

}  // namespace

TEST_CASE("models survive XML and JSON, bit for bit") {
  const auto check = [](const auto& chain) {
    const auto r = record_of(chain);
    CHECK(kte::from_json(kte::to_json(r)) == r);
    CHECK(kte::from_xml(kte::to_xml(r)) == r);
    CHECK(record_of(kte::to_chain(kte::from_xml(kte::to_xml(r)))) == r);
    CHECK(record_of(kte::from_record(chain, kte::from_json(kte::to_json(r)))) == r);
  };
  check(golden);
  check(tree);
  check(robots::iiwa14);
  check(robots::ur5);
}

TEST_CASE("hard numbers and names survive") {
  kte::model_record m;
  m.gravity = {0.1, 1.0 / 3.0, -5e-324};
  m.elements.push_back(
      {"spring_gen",
       1,
       {{"anchor1", "a <b> & \"c\" 'd' \\ / \u00e9"}, {"anchor2", " with blanks "}},
       {{"rest_length", {1.7976931348623157e308}}, {"stiffness", {2.2250738585072014e-308}}, {"saturation", {-0.0}}}});
  for (const auto& back : {kte::from_json(kte::to_json(m)), kte::from_xml(kte::to_xml(m))}) {
    CHECK(back == m);
    CHECK(std::signbit(back.elements[0].parameters[2].values[0]));
  }
}

TEST_CASE("files written by this version can be read for ever") {
  CHECK(kte::load_model(data / "pendulum.json") == record_of(golden));
  CHECK(kte::load_model(data / "pendulum.xml") == record_of(golden));
}

TEST_CASE("the locale does not matter") {
  const auto r = record_of(golden);
  const std::string json = kte::to_json(r), xml = kte::to_xml(r);
  const std::locale before = std::locale::global(std::locale(std::locale(), new comma));
  CHECK(kte::to_json(r) == json);
  CHECK(kte::from_json(json) == r);
  CHECK(kte::to_xml(r) == xml);
  CHECK(kte::from_xml(xml) == r);
  std::locale::global(before);
}

TEST_CASE("files") {
  const auto path = std::filesystem::temp_directory_path() / "kte_model_file_test.json";
  kte::save_model(path, golden);
  CHECK(kte::load_model(path) == record_of(golden));
  std::filesystem::remove(path);
  CHECK_THROWS_WITH(kte::load_model(path),
                    contains_text("kte_model_file_test.json") && contains_text("cannot be read"));
  CHECK_THROWS_WITH(kte::save_model("/nonexistent/x.xml", golden),
                    contains_text("/nonexistent/x.xml: cannot be written"));
  CHECK_THROWS_WITH(kte::save_model("model.txt", golden), contains_text(".xml or .json"));
}

TEST_CASE("a bad file says where, and gives nothing") {
  const std::string json = kte::to_json(record_of(golden)), xml = kte::to_xml(record_of(golden));
  const auto load = [](const std::string& text) { return kte::to_chain(kte::from_json(text, "m.json")); };
  SECTION("syntax") {
    CHECK_THROWS_WITH(load(json + "x"), contains_text("m.json:45:1: something follows the end"));
    CHECK_THROWS_WITH(load(replaced(json, "{", "{,")), contains_text("m.json:1:2"));
    CHECK_THROWS_WITH(load(""), contains_text("m.json:1:1: the file is empty"));
    CHECK_THROWS_AS(load("42"), kte::bad_file);
    CHECK_THROWS_AS(load("null"), kte::bad_file);
    CHECK_THROWS_AS(load("[]"), kte::bad_file);
    CHECK_THROWS_WITH(kte::from_xml(xml + "x", "m.xml"), contains_text("m.xml:"));
    CHECK_THROWS_WITH(kte::from_xml(xml + xml.substr(xml.find("<cereal")), "m.xml"),
                      contains_text("something follows"));
    CHECK_THROWS_WITH(kte::from_xml("", "m.xml"), contains_text("the file is empty"));
    CHECK_THROWS_AS(kte::from_xml("<a></b>"), kte::bad_file);
    CHECK_THROWS_AS(kte::from_xml("<a/>"), kte::bad_file);
  }
  SECTION("truncated anywhere") {
    for (std::size_t n = 0; n + 2 < json.size(); n += 7)
      CHECK_THROWS_AS(kte::from_json(json.substr(0, n)), kte::bad_file);
    for (std::size_t n = 0; n + 3 < xml.size(); n += 7) CHECK_THROWS_AS(kte::from_xml(xml.substr(0, n)), kte::bad_file);
  }
  SECTION("a letter lost or changed anywhere is an error or a model, never a crash") {
    for (std::size_t i = 0; i < json.size(); i += 3) {
      auto damaged = json;
      damaged[i] = static_cast<char>(damaged[i] ^ 5);
      try {
        (void)load(damaged);
      } catch (const kte::error&) {
      }
      damaged = json;
      damaged.erase(i, 1);
      try {
        (void)load(damaged);
      } catch (const kte::error&) {
      }
    }
    for (std::size_t i = 0; i < xml.size(); i += 3) {
      auto damaged = xml;
      damaged[i] = static_cast<char>(damaged[i] ^ 5);
      try {
        (void)kte::to_chain(kte::from_xml(damaged));
      } catch (const kte::error&) {
      }
    }
  }
  SECTION("deep nesting") {
    std::string deep(100000, '['), tags;
    for (int i = 0; i < 100000; ++i) tags += "<a>";
    CHECK_THROWS_WITH(load(deep), contains_text("too deep"));
    CHECK_THROWS_WITH(kte::from_xml(tags), contains_text("too deep"));
  }
  SECTION("content") {
    CHECK_THROWS_WITH(load(replaced(json, "rigid_link_2D", "rigid_link_4D")),
                      contains_text("element 2") && contains_text("no element type 'rigid_link_4D'"));
    CHECK_THROWS_WITH(load(replaced(json, "\"version\": 1", "\"version\": 2")), contains_text("version 2"));
    CHECK_THROWS_WITH(load(replaced(json, "\"version\": 1,\n                \"ports\"",
                                    "\"version\": 3,\n                \"ports\"")),
                      contains_text("element 1") && contains_text("version 3"));
    CHECK_THROWS_WITH(load(replaced(json, "\"base\": \"joint\",", "")),
                      contains_text("element 2") && contains_text("'base'"));
    CHECK_THROWS_WITH(load(replaced(json, "\"base\": \"joint\"", "\"base\": \"jiont\"")), contains_text("'jiont'"));
    CHECK_THROWS_WITH(load(replaced(json, "\"0.5 0 0\"", "\"0.5 0 0abc\"")),
                      contains_text("element 2") && contains_text("0abc"));
    CHECK_THROWS_WITH(load(replaced(json, "\"mass\": \"1\"", "\"mass\": \"-1\"")),
                      contains_text("inertia_2D (frame 'tip')") && contains_text("-1"));
    CHECK_THROWS_WITH(load(replaced(json, "\"mass\": \"1\"", "\"mass\": \"nan\"")),
                      contains_text("mass must be finite"));
    CHECK_THROWS_WITH(load(replaced(json, "\"mass\": \"1\"", "\"mass\": \"1e999\"")), contains_text("1e999"));
    CHECK_THROWS_WITH(load(replaced(json, "0 -9.81 0", "0 -9.81")), contains_text("gravity"));
    CHECK_THROWS_WITH(load(replaced(json, "\"type\"", "\"kind\"")),
                      contains_text("element 1") && contains_text("type"));
    CHECK_THROWS_WITH(load(replaced(json, "\"elements\"", "\"element\"")), contains_text("elements"));
  }
}
