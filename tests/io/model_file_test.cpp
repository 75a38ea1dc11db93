#include <kte/io/model_file.hpp>

#include <clocale>
#include <locale>

#include "catch.hpp"
#include "chain/models.hpp"
#include "io/scratch.hpp"
#include "robots/iiwa14.hpp"
#include "robots/ur5.hpp"

namespace model_file_test {

using namespace models;
using kte::test::contains_text;

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

TEST_CASE("models survive XML and JSON, bit for bit") {
  const auto check = [](const auto& chain) {
    const auto r = record_of(chain);
    CHECK(kte::from_json(kte::to_json(r)) == r);
    CHECK(kte::from_xml(kte::to_xml(r)) == r);
    CHECK(kte::from_binary(kte::to_binary(r)) == r);
    CHECK(record_of(models::registered(kte::from_xml(kte::to_xml(r)))) == r);
    CHECK(record_of(kte::from_record(chain, kte::from_json(kte::to_json(r)))) == r);
  };
  check(golden);
  check(tree);
  check(robots::iiwa14);
  check(robots::ur5);
}

TEST_CASE("files written by this version can be read for ever") {
  CHECK(kte::load_model(data / "pendulum.json") == record_of(golden));
  CHECK(kte::load_model(data / "pendulum.xml") == record_of(golden));
  CHECK(kte::load_model(data / "pendulum.kte") == record_of(golden));
  // and it still writes them so
  CHECK(kte::to_json(record_of(golden)) == kte::detail::read_file(data / "pendulum.json"));
  CHECK(kte::to_binary(record_of(golden)) == kte::detail::read_file(data / "pendulum.kte"));
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
  for (const char* extension : {".json", ".xml", ".JSON", ".Xml", ".KTE"}) {
    const kte::test::scratch file(extension, "what was there");
    kte::save_model(file.path, golden);
    CHECK(kte::load_model(file.path) == record_of(golden));
    CHECK(file.text().starts_with(extension == std::string(".KTE")             ? "\x89kte"
                                  : extension[1] == 'j' || extension[1] == 'J' ? "{"
                                                                               : "<?xml"));
  }
  CHECK_THROWS_WITH(kte::save_model("/nonexistent/x.xml", golden),
                    contains_text("cannot write '/nonexistent/x.xml': No such file or directory"));
  CHECK_THROWS_WITH(kte::save_model("model.txt", golden), contains_text(".xml, .json or .kte"));
}

/// What no file can hold.
struct own_map : kte::kte_map {
  void doMotion(kte::runtime_state&) const override {}
  void clearForce(kte::runtime_state&) const override {}
  void doForce(kte::runtime_state&) const override {}
  std::unique_ptr<kte::kte_map> clone() const override { return std::make_unique<own_map>(); }
  void for_each_element(const std::function<void(const kte::kte_element&)>&) const override {}
  void connect(kte::topology&) override {}
};

TEST_CASE("a chain with a part that is neither an element nor a chain is not saved") {
  kte::runtime_chain inner, outer;
  inner.append(std::make_unique<own_map>());
  outer << golden << kte::runtime_chain();
  CHECK_NOTHROW(record_of(outer));
  outer << inner;
  const kte::test::scratch file(".json", "what was there");
  CHECK_THROWS_WITH(kte::save_model(file.path, outer), contains_text("kte: the chain holds a '") &&
                                                           contains_text("own_map', which no record or file can hold"));
  CHECK(file.text() == "what was there");
}

TEST_CASE("a bad file says where, and gives nothing") {
  const std::string json = kte::to_json(record_of(golden)), xml = kte::to_xml(record_of(golden));
  const auto load = [](const std::string& text) { return models::registered(kte::from_json(text, "m.json")); };
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
        (void)models::registered(kte::from_xml(damaged));
      } catch (const kte::error&) {
      }
    }
  }
  SECTION("content") {
    CHECK_THROWS_WITH(load(replaced(json, "rigid_link_2D", "rigid_link_4D")),
                      contains_text("kte: m.json:19:25: element 2: there is no element type 'rigid_link_4D'"));
    CHECK_THROWS_WITH(load(replaced(json, "\"mass\"", "\"maas\"")),
                      contains_text("element 3: inertia_2D has no parameter 'mass'"));
    CHECK_THROWS_WITH(load(replaced(json, "\"mass\"", "\"charge\": 1, \"mass\"")),
                      contains_text("kte: m.json:37:21: element 3: inertia_2D has no parameter 'charge'"));
    CHECK_THROWS_WITH(load(replaced(json, "\"mass\": \"1\"", "\"mass\": [1, 2]")),
                      contains_text("kte: m.json:37:21: element 3: inertia_2D has 2 numbers as 'mass', not 1"));
    CHECK_THROWS_WITH(load(replaced(json, "\"frame\"", "\"body\": \"tip\", \"frame\"")),
                      contains_text("kte: m.json:34:21: element 3: inertia_2D has no connection 'body'"));
    CHECK_THROWS_WITH(kte::from_record(golden, kte::from_json(replaced(json, "\"mass\": \"1\"", "\"mass\": []"), "m")),
                      contains_text("kte: m:37:21: element 3 (inertia_2D), mass: holds too few numbers"));
    const auto heavy = replaced(json, "\"mass\": \"1\"", "\"mass\": \"-1\"");
    CHECK_THROWS_MATCHES(load(heavy), kte::bad_parameter,
                         kte::test::says("kte: m.json:31:25: element 3: inertia_2D (frame 'tip'): mass must be"));
    CHECK_THROWS_MATCHES(kte::from_record(golden, kte::from_json(heavy, "m")), kte::bad_parameter,
                         kte::test::says("kte: m:31:25: element 3 (inertia_2D): inertia_2D (frame 'tip'): mass must"));
    CHECK_THROWS_MATCHES(load(replaced(json, "\"base\": \"joint\"", "\"base\": \"jiont\"")), kte::bad_wiring,
                         kte::test::says("kte: m.json:19:25: element 2: rigid_link_2D (base 'jiont', end 'tip'): it"));
    CHECK(record_of(load(replaced(json, "\"mass\": \"1\"", "\"mass\": 1"))) == record_of(golden));
    CHECK(record_of(load(replaced(json, "\"0.5 0 0\"", "[0.5, 0, 0]"))) == record_of(golden));
    CHECK_THROWS_WITH(load(replaced(json, "\"version\": 1", "\"version\": 3")), contains_text("version 3 of"));
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

}  // namespace model_file_test
