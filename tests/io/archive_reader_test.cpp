#include <kte/io/binary_file.hpp>
#include <kte/io/model_reader.hpp>

#include "catch.hpp"
#include "scratch.hpp"

namespace archive_reader_test {

using kte::archive_record, kte::model_format, kte::read_options;

archive_record read(const std::string& text, model_format format = model_format::json, const read_options& o = {}) {
  return kte::detail::read_archive(text, "m", format, o);
}
/// The message behind the file, of a bad text.
std::string fault(const std::string& text, model_format format = model_format::json, const read_options& o = {}) {
  const auto what = kte::test::message_of<kte::bad_file>([&] { (void)read(text, format, o); });
  return what.substr(what.starts_with("kte: m") ? 6 : 0);
}
/// The roots begin at column 1 of line 2.
std::string json_roots(const std::string& roots) {
  return "{\"kte_archive\":{\"version\":2,\"roots\":[\n" + roots + "]}}";
}
std::string json_root(const std::string& content) { return json_roots("{\"name\":\"r\"," + content + "}"); }
std::string xml_roots(const std::string& roots) {
  return "<cereal><kte_archive><version>2</version><roots>\n" + roots + "</roots></kte_archive></cereal>";
}
const std::string chain = R"("chain":{"gravity":"0 0 0","elements":[]})";

/// A binary file by hand.
struct bytes {
  std::string all{kte::detail::binary_magic};
  bytes& operator<<(const std::string& more) {
    all += more;
    return *this;
  }
};
std::string text_of(const std::string& t) { return "\3" + std::string(1, static_cast<char>(t.size())) + t; }

TEST_CASE("archives by hand: roots in any order, what may be left out") {
  const auto a = read(json_roots(R"({"mass_matrix_calc":{"chain":"arm"},"name":"m"},)"
                                 R"({"name":"arm","chain":{"elements":[],"limits":[{"upper":[1.5],"coordinate":"q"}],)"
                                 R"("gravity":[0,0,-9.81],"tools":["hand"],"inputs":[{"name":"u","value":2}]}},)"
                                 R"({"name":"x","thing":{"name":"q","values":{"q":0.1},"type":"coordinate"}},)"
                                 R"({"name":"s","state":[]},{"name":"n","numbers":"0.1 0.1L nan"})"));
  REQUIRE(a.roots.size() == 5);
  CHECK(std::get<kte::calculator_record>(a.roots[0].content) == kte::calculator_record{"arm", true, {}, {}});
  const auto& m = std::get<kte::model_record>(a.roots[1].content);
  CHECK(m.tools == std::vector<std::string>{"hand"});
  CHECK(m.limits == std::vector<kte::limit_record>{{"q", {{"upper", {1.5}}}}});
  CHECK(m.inputs == std::vector<kte::parameter_record>{{"u", {2}}});
  CHECK(std::get<kte::thing_record>(a.roots[2].content) == kte::thing_record{kte::kind::gen, "q", {{"q", {0.1}}}});
  const auto& n = std::get<kte::numbers_record>(a.roots[4].content);
  CHECK((n.at(0) == 0.1 && n.at(1) == 0.1L && std::isnan(n.at(2))));
  const auto b =
      read(xml_roots("<value><name>m</name><mass_matrix_calc><chain>c</chain><inertias><value>e</value></inertias>"
                     "</mass_matrix_calc></value><value><chain><gravity>0 0 0</gravity><elements/></chain>"
                     "<name>c</name></value>"),
           model_format::xml);
  CHECK(std::get<kte::calculator_record>(b.roots.at(0).content) == kte::calculator_record{"c", false, {"e"}, {}});
}

TEST_CASE("what an archive must not be") {
  CHECK(fault(json_root(chain)).empty());
  CHECK(fault(json_roots("{" + chain + "}")) == ":2:1: root 1: the root has no 'name'");
  CHECK(fault(json_root("\"numbers\":[]," + chain)) == ":2:26: root 1: a root is one thing, not a 'chain' too");
  CHECK(fault(json_roots(R"({"name":"r"})")) ==
        ":2:1: root 1: the root has none of chain, thing, state, mass_matrix_calc, numbers");
  CHECK(fault(json_roots(R"({"name":"r","numbers":[]},{"name":"r","numbers":[]})")).ends_with("root 2: a second 'r'"));
  CHECK(fault(json_root(R"("mass_matrix_calc":{"chain":"r"})")) ==
        ":2:1: root 'r' is of the chain 'r', which is not a root of the archive");
  CHECK(fault(json_root(R"("thing":{"type":"coord","name":"q","values":{}})")) ==
        ":2:29: root 1: there is no thing of type 'coord'");
  const std::string q = R"({"type":"coordinate","name":"q","values":{}})",
                    f = R"({"type":"frame_2D","name":"q","values":{}})";
  CHECK(fault(json_root("\"state\":[" + q + "," + f + "]")).empty());
  CHECK(fault(json_root("\"state\":[" + q + "," + q + "]")).ends_with("root 1, thing 2: a second thing 'q'"));
  const auto limits = [](const std::string& some) {
    return fault(json_root(R"("chain":{"gravity":"0 0 0","elements":[],"limits":[)" + some + "]}"));
  };
  CHECK(limits(R"({"coordinate":"q","lower":1},{"coordinate":"q"})").ends_with("root 1, limit 2: a second 'q'"));
  CHECK(limits(R"({"coordinate":"q","speed":1})")
            .ends_with(
                "limit 1: unknown field 'speed'; the limit has coordinate, lower, upper, rate, acceleration, jerk, "
                "effort"));
  CHECK(fault(json_root(R"("numbers":"1e-5000L")")).ends_with("holds a number too large or too small for a double"));
  CHECK(fault(json_root(R"("numbers":"1L2")")).ends_with("is not a list of numbers"));
  CHECK(fault(R"({"kte_archive":{"version":3,"roots":[]}})") ==
        ":1:27: version 3 of the format; this library reads versions 1 and 2");
  CHECK(fault(R"({"kte_archive":{"version":1,"roots":[]}})") ==
        ":1:27: version 1 of the format; this library reads versions 1 and 2");
  CHECK(fault(R"({"kte_model":{"version":1,"gravity":"0 0 0","elements":[],"tools":[]}})")
            .ends_with("tools, limits and inputs are there from version 2 on, this is version 1"));
  CHECK(fault(R"({"kte_archive":{"version":2,"roots":[]},"kte_model":{}})")
            .ends_with("a file has either a 'kte_model' or a 'kte_archive'"));
}

TEST_CASE("fields that begin with x_ are left out if somebody is told so") {
  const std::string text = json_root("\"x_note\":[1,2],\"numbers\":[]");
  CHECK(fault(text) == ":2:13: root 1: unknown field 'x_note', which may be omitted if read_options::warn is set");
  std::vector<std::string> told;
  const read_options listens{.warn = [&told](const std::string& what) { told.push_back(what); }};
  CHECK(read(text, model_format::json, listens) == read(json_root("\"numbers\":[]")));
  CHECK(told == std::vector<std::string>{"kte: m:2:13: root 1: unknown field 'x_note' is left out"});
  CHECK(
      fault(json_root("\"x_note\":{},\"numbers\":[]"), model_format::json, listens).ends_with("nor a list of numbers"));
  CHECK(fault(json_root("\"note\":1,\"numbers\":[]"), model_format::json, listens).find("unknown field 'note';") !=
        std::string::npos);
}

TEST_CASE("bytes: what counts claim is not believed") {
  const std::string begin = "\3\11kte_model\1";
  const auto bad = [](const std::string& rest) { return fault((bytes() << rest).all, model_format::binary); };
  CHECK(bad("") == ", byte 8: the file ends in the middle of the model");
  CHECK(bad("\2") == ", byte 8: 'the model' must be a group");
  CHECK(bad(std::string("\1\4\0", 3)) == ", byte 9: 'the name of a field': there is no such text before it");
  CHECK(bad("\1\4\5") == ", byte 9: 'the name of a field': there is no such text before it");
  CHECK(bad("\1\3\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF\x01").ends_with("the file ends in the middle of the model"));
  CHECK(bad("\1\3\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF\x02").ends_with("a count that does not fit in 64 bits"));
  CHECK(bad("\1\3\x80\x80\x80\x80\x80\x80\x80\x80\x80\x80\x01").ends_with("a count that does not fit in 64 bits"));
  CHECK(bad("\1\3\1\xC0") == ", byte 9: this is not UTF-8");
  CHECK(bad("\1" + begin + text_of("gravity") + "\5\xFF\xFF\xFF\xFF\xFF\xFF\xFF\x3F")
            .ends_with("the file ends in the middle of the model"));
  CHECK(bad("\1" + begin + text_of("gravity") + std::string("\5\0", 2)).ends_with("'gravity' has 0 numbers, not 3"));
  CHECK(bad("\1" + begin + text_of("elements") + "\1").ends_with("'elements' must be a list"));
  CHECK(bad("\1" + begin + text_of("version") + "\5\1").ends_with("'version' is not a text"));
  CHECK(bad("\1" + begin + text_of("note")).find("unknown field 'note'") != std::string::npos);
  CHECK(fault("\x89kte\n\x1a\n", model_format::binary) == ", byte 0: this is not a binary model file");
  const auto good = kte::to_binary(kte::model_record{});
  CHECK(fault(good, model_format::binary).empty());
  CHECK(fault(good + "x", model_format::binary).ends_with("unexpected content after the end of the model"));
  // a text of more than 64 bytes is not one that is known later
  const auto named = [](std::size_t n) {
    archive_record a;
    for (const char* name : {"a", "b"})
      a.roots.push_back({name, kte::thing_record{kte::kind::gen, std::string(n, 'n'), {}}, {}});
    const auto written = kte::to_binary(a);
    CHECK(read(written, model_format::binary) == a);
    return written.size();
  };
  CHECK(named(64) < 64 + 150);
  CHECK(named(65) > 130);
}

TEST_CASE("deep, long and cut off: refused or read in the time and memory of their size, never half") {
  std::string deep_bytes = (bytes() << "\1").all;
  for (int i = 0; i < 1000000; ++i) deep_bytes += "\3\1a\1";
  CHECK(fault(deep_bytes, model_format::binary).starts_with(", byte 9: unknown field 'a'"));
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += R"({"chain":)";
  CHECK(fault(json_roots(deep)).find("root 1: 'chain' must") == std::string::npos);
  CHECK_FALSE(fault(json_roots(deep)).empty());
  deep.clear();
  for (int i = 0; i < 100000; ++i) deep += "<chain>";
  CHECK_FALSE(fault(xml_roots("<value>" + deep), model_format::xml).empty());

  archive_record a;
  kte::model_record m;
  for (int i = 0; i < 100; ++i)
    m.elements.push_back({"rigid_link_gen", 1, {{"base", "b" + std::to_string(i)}, {"end", "e"}}, {{"offset", {0.1}}}});
  m.tools = {"e"}, m.limits = {{"q", {{"lower", {-1}}}}};
  a.roots.push_back({"arm", m, {}});
  a.roots.push_back({"n", kte::numbers_record{0.1L, 1}, {}});
  const auto all = kte::to_binary(a);
  CHECK(read(all, model_format::binary) == a);
  for (std::size_t n = 0; n < all.size(); n += 3) CHECK_FALSE(fault(all.substr(0, n), model_format::binary).empty());
  for (std::size_t i = 0; i < all.size(); i += 7)
    for (const char* change : {"", "\1", "\5", "\x7f", "\xff"}) {
      auto damaged = all;
      (void)fault(damaged.replace(i, 1, change), model_format::binary);
    }

  // caps, which the caller may raise: 102 roots and elements, 3 ports and parameters each, a tool, a limit
  CHECK(fault(all, model_format::binary, {.max_bytes = all.size()}).empty());
  CHECK(fault(all, model_format::binary, {.max_bytes = all.size() - 1}).ends_with("(read_options::max_bytes)"));
  CHECK(fault(json_root(chain), model_format::json, {.max_bytes = 10}) ==
        ":1:1: the file has more than 10 bytes (read_options::max_bytes)");
  CHECK(fault(all, model_format::binary, {.max_items = 404}).empty());
  CHECK(
      fault(all, model_format::binary, {.max_items = 403}).ends_with("more than 403 things (read_options::max_items)"));
}

}  // namespace archive_reader_test
