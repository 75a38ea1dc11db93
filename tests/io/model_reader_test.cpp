#include <kte/io/model_reader.hpp>

#include "catch.hpp"
#include "scratch.hpp"

namespace model_reader_test {

using kte::from_json;
using kte::from_xml;
using kte::test::scratch;

/// A bad text for `from_json`, `from_xml`: the start of the message behind the file, "line:column: ...".
std::string json(const std::string& text) {
  const auto what = kte::test::message_of<kte::bad_file>([&] { (void)from_json(text, "m"); });
  return what.substr(what.starts_with("kte: m:") ? 7 : 0);
}
std::string xml(const std::string& text) {
  const auto what = kte::test::message_of<kte::bad_file>([&] { (void)from_xml(text, "m"); });
  return what.substr(what.starts_with("kte: m:") ? 7 : 0);
}
/// A model in one line around what is tested, which begins at column 1 of line 2 each time.
std::string json_model(const std::string& fields, const std::string& version = "\"version\":1,") {
  return R"({"kte_model":{)" + version + "\n" + fields + "}}";
}
std::string json_element(const std::string& fields) {
  return json_model(R"("elements":[{)"
                    "\n" +
                        fields + "}]",
                    R"("version":1,"gravity":"0 0 0",)");
}
std::string xml_model(const std::string& fields, const std::string& version = "<version>1</version>") {
  return "<cereal><kte_model>" + version + "\n" + fields + "</kte_model></cereal>";
}
std::string xml_element(const std::string& fields) {
  return xml_model("<elements size=\"dynamic\"><value0>\n" + fields + "</value0></elements>",
                   "<version>1</version><gravity>0 0 0</gravity>");
}
const std::string json_head = R"("type":"t","version":1,"ports":{},)", json_gravity = R"("gravity":"0 0 0",)";
const std::string xml_head = "<type>t</type><version>1</version><ports/>";

std::vector<double> json_numbers(const std::string& value) {
  const auto m = from_json(json_element(json_head + R"("parameters":{"p":)" + value + "}"));
  return m.elements.at(0).parameters.at(0).values;
}
std::vector<double> xml_numbers(const std::string& value) {
  const auto m = from_xml(xml_element(xml_head + "<parameters><p>" + value + "</p></parameters>"));
  return m.elements.at(0).parameters.at(0).values;
}
std::string json_name(const std::string& value) {
  const auto m = from_json(json_element(R"("type":"t","version":1,"parameters":{},"ports":{"f":")" + value + "\"}"));
  return m.elements.at(0).connections.at(0).name;
}
std::string xml_name(const std::string& value) {
  const auto m = from_xml(xml_element("<type>t</type><version>1</version><parameters/><ports>" + value + "</ports>"));
  return m.elements.at(0).connections.at(0).name;
}
std::string repeated(const std::string& text, int n) {
  std::string all;
  for (int i = 0; i < n; ++i) all += text;
  return all;
}

using list = std::vector<double>;

TEST_CASE("deep nesting is refused where it begins, not by a stack that overflows") {
  for (const char* tag : {"<a>", "<1>", "<é>", "<:>", "<a>/>", "<a b='/>'>", "<a><!--</-->", "<a><![CDATA[</]]>",
                          "<a><?p </?>", "<a \n>", "<a b=\"</a>\">", "<_><!-- <a/> -->", "<a/", "<!--", "<a b='"}) {
    CAPTURE(tag);
    const auto deep = repeated(tag, 50000);
    CHECK(xml(deep).starts_with("1:"));
    CHECK(xml("<cereal>" + deep).starts_with("1:"));
    CHECK_FALSE(xml("<cereal><kte_model>" + deep).empty());
    CHECK_FALSE(xml(xml_element(xml_head + "<parameters><p>" + deep)).empty());
  }
  for (const char* bracket : {"[", "{\"a\":", "[{\"a\":"}) {
    CAPTURE(bracket);
    const auto deep = repeated(bracket, 1000000);
    CHECK(json(deep).starts_with("1:"));
    CHECK(json(json_model("\"gravity\":" + deep)).starts_with("2:"));
    CHECK_FALSE(json(json_element(json_head + "\"parameters\":{\"p\":" + deep)).empty());
  }
}

TEST_CASE("numbers may be texts, numbers, or lists of numbers") {
  CHECK(json_numbers("\"1\"") == list{1});
  CHECK(json_numbers("1") == list{1});
  CHECK(json_numbers("[0, -0.0, 0.36]") == list{0, 0, 0.36});
  CHECK(json_numbers("[ 1e3 ,2E-1,-0.5e+2\n]") == list{1000, 0.2, -50});
  CHECK(json_numbers("\" 1\\t2\\n 3 \"") == list{1, 2, 3});
  CHECK(json_numbers("[]").empty());
  CHECK(json_numbers("\"inf\"") == list{std::numeric_limits<double>::infinity()});
  CHECK(json_numbers("0.1000000000000000055511151231257827") == list{0.1});
  CHECK(from_json(json_model(R"("elements":[],"gravity":[0,0,-9.81])")).gravity == list{0, 0, -9.81});
  CHECK(from_json(json_model(R"("elements":[],"gravity":"1 2 3")", R"("version":"1",)")).gravity == list{1, 2, 3});

  const auto bad = [](const std::string& value) {
    return json(json_element(json_head + "\"parameters\":{\n\"p\":" + value + "}"));
  };
  CHECK(bad("true") == "4:5: 'p' is neither a number, nor a text, nor a list of numbers");
  CHECK(bad("[1,null]") == "4:8: 'p' is neither a number, nor a text, nor a list of numbers");
  CHECK(bad("[[1]]") == "4:6: 'p' is neither a number, nor a text, nor a list of numbers");
  CHECK(bad("[\"1\"]").starts_with("4:6: 'p' is neither"));
  CHECK(bad("{}").starts_with("4:5: 'p' is neither"));
  CHECK(bad("NaN").starts_with("4:5: 'p' is neither"));
  CHECK(bad("+1").starts_with("4:5: 'p' is neither"));
  CHECK(bad(".5").starts_with("4:5: 'p' is neither"));
  CHECK(bad("1.").starts_with("4:5: 'p' is neither"));
  CHECK(bad("1e").starts_with("4:5: 'p' is neither"));
  CHECK(bad("01") == "4:5: 'p': '01' is not a JSON number");
  CHECK(bad("[0, 0x1F]") == "4:9: 'p': '0x1F' is not a JSON number");
  CHECK(bad("1 2") == "4:7: expected ',' or '}'");
  CHECK(bad("[1 2]") == "4:8: expected ',' or ']'");
  CHECK(bad("[1,]") == "4:8: expected a value after the comma");
  CHECK(bad("\"1x\"") == "4:5: element 1: 'p': '1x' is not a list of numbers");
  CHECK(bad("\"1,2\"") == "4:5: element 1: 'p': '1,2' is not a list of numbers");
  CHECK(bad("1e999") == "4:5: element 1: 'p': '1e999' holds a number too large or too small for a double");
  CHECK(bad("\"1e-999\"") == "4:5: element 1: 'p': '1e-999' holds a number too large or too small for a double");
}

TEST_CASE("fields are known, once each, and none is missing: JSON") {
  CHECK(json(json_model(json_gravity + R"("gravity":"0 0 1","elements":[])")) == "2:19: a second 'gravity'");
  CHECK(json(json_model(json_gravity + R"("elements":[],"elements":[])")) == "2:33: a second 'elements'");
  CHECK(json(json_model(json_gravity + R"("element":[])")) ==
        "2:19: unknown field 'element'; 'kte_model' has version, gravity, elements, tools, limits, inputs");
  CHECK(json(R"({"kte_model":{"version":1,"gravity":"0 0 0"}})") == "1:14: 'kte_model' has no 'elements'");
  CHECK(json("{}") == "1:1: the file has no 'kte_model'");
  CHECK(json(R"({"model":{}})") == "1:2: unknown field 'model'; the file has kte_model, kte_archive");
  CHECK(json(R"({"kte_model":{"version":1,"gravity":"0 0 0","elements":[]},"x":1})")
            .starts_with("1:60: unknown field 'x'"));

  CHECK(json(json_element(R"("type":"a","type":"b")")) == "3:12: element 1: a second 'type'");
  CHECK(json(json_element(R"("typ":"a")")) ==
        "3:1: element 1: unknown field 'typ'; the element has type, version, ports, parameters");
  CHECK(json(json_element(R"("type":"a")")) == "2:13: element 1: the element has no 'version'");
  CHECK(json(json_element(json_head + R"("parameters":{"m":"1","m":"2"})")) ==
        "3:57: element 1: a second 'm' in 'parameters'");
  CHECK(json(json_element(R"("ports":{"f":"a","\u0066":"a"})")) == "3:18: element 1: a second 'f' in 'ports'");
  CHECK(json(json_element(R"("type":1)")) == "3:8: 'type' is not a text in quotes");
  CHECK(json(json_element(R"("type":["a"])")) == "3:8: 'type' is not a text in quotes");
  CHECK(json(json_element(R"("ports":"a")")) == "3:9: 'ports' must be an object {...}");
  CHECK(json(json_element(R"("ports":{"a":{}})")) == "3:14: 'a' is not a text in quotes");
  CHECK(json(json_model(R"("elements":{})")) == "2:12: 'elements' must be a list [...]");
  CHECK(json(json_model(R"("elements":[1])")) == "2:13: 'element 1' must be an object {...}");
}

TEST_CASE("fields are known, once each, and none is missing: XML") {
  const std::string gravity = "<gravity>0 0 0</gravity>";
  CHECK(xml(xml_model(gravity + "<gravity>0 0 1</gravity>")) == "2:25: a second 'gravity'");
  CHECK(xml(xml_model("<gravitation>0 0 1</gravitation>")) ==
        "2:1: unknown field 'gravitation'; 'kte_model' has version, gravity, elements, tools, limits, inputs");
  CHECK(xml(xml_model(gravity)) == "1:9: 'kte_model' has no 'elements'");
  CHECK(xml("<cereal/>") == "1:1: the file has no 'kte_model'");
  CHECK(xml("<kte_model/>") == "1:1: a model file begins with <cereal>");
  CHECK(xml(xml_element("<type>a</type><type>b</type>")) == "3:15: element 1: a second 'type'");
  CHECK(xml(xml_element("<typ>a</typ>")).starts_with("3:1: element 1: unknown field 'typ'"));
  CHECK(xml(xml_element(xml_head + "<parameters><m>1</m><m>2</m></parameters>")) ==
        "3:63: element 1: a second 'm' in 'parameters'");
  CHECK(xml(xml_element("<type><a/></type>")) == "3:7: 'type' holds a text, not tags");
  CHECK(xml(xml_element("<ports>a</ports>")) == "3:8: expected a tag, got text");

  CHECK(xml(xml_model("x" + gravity)) == "2:1: expected a tag, got text");
  CHECK(xml(xml_model(gravity + "<![CDATA[ ]]>")) == "2:25: expected a tag");
  CHECK(xml(xml_model("<gravity unit=\"m\">0 0 0</gravity>")) == "2:10: 'gravity' has an unknown attribute 'unit'");
  CHECK(xml(xml_model("<gravity size=\"dynamic\">0 0 0</gravity>")) == "2:10: 'gravity' has no attribute 'size'");
  CHECK(xml(xml_model("<elements size=\"3\"/>")) == "2:11: the size of 'elements' must be \"dynamic\"");
  CHECK(xml(xml_model("<elements size=\"\"/>")) == "2:11: the size of 'elements' must be \"dynamic\"");
  CHECK(xml(xml_model("<elements size='dynamic' size='dynamic'/>")) == "2:26: a second attribute 'size'");
  CHECK(xml(xml_model("<elements><value1/></elements>")) == "2:11: expected <value0> or <value>, got <value1>");
  CHECK(from_xml(xml_model(gravity + "<elements/>")).elements.empty());
  CHECK(from_xml(xml_model(gravity + "<elements><value><parameters/>" + xml_head + "</value></elements>"))
            .elements.size() == 1);
}

TEST_CASE("versions are whole numbers, gravity is finite") {
  const std::string rest = json_gravity + "\"elements\":[]";
  const auto version = [&](const std::string& v) { return json(json_model(rest, "\"version\":" + v + ",")); };
  CHECK(version("0x1").ends_with("'version': '0x1' is not a JSON number"));
  CHECK(version("\"1\"").empty());
  CHECK(version("2").empty());
  CHECK(version("3") == "1:25: version 3 of the format; this library reads versions 1 and 2");
  CHECK(version("\"1abc\"") == "1:25: 'version': '1abc' is not a whole number");
  CHECK(version("1.0") == "1:25: 'version': '1.0' is not a whole number");
  CHECK(version("\"\"") == "1:25: 'version': '' is not a whole number");
  CHECK(version("99999999999") == "1:25: 'version': '99999999999' is not a whole number");
  CHECK(xml(xml_model("", "<version>1abc</version>")) == "1:29: 'version': '1abc' is not a whole number");
  CHECK(json(json_element("\"version\":\"1abc\"")) == "3:11: element 1: 'version': '1abc' is not a whole number");

  const auto gravity = [](const std::string& g) { return json(json_model("\"gravity\":" + g)); };
  CHECK(gravity("\"0 0 nan\"") == "2:11: 'gravity' must be finite, got nan");
  CHECK(gravity("\"-inf 0 0\"") == "2:11: 'gravity' must be finite, got -inf");
  CHECK(gravity("[0, 0]") == "2:11: 'gravity' has 2 numbers, not 3");
  CHECK(gravity("-9.81") == "2:11: 'gravity' has 1 numbers, not 3");
  CHECK(xml(xml_model("<gravity>\n 0 0 nan</gravity>")) == "3:2: 'gravity' must be finite, got nan");
}

TEST_CASE("texts: escapes, blanks, remarks") {
  CHECK(json_name(R"(\"\\\/\u00e9\u20AC\uD83D\ude00)") == "\"\\/é€\U0001F600");
  CHECK(xml_name("<f>&lt;&gt;&amp;&quot;&apos;&#233;&#x20AC;</f>") == "<>&\"'é€");
  CHECK(xml_name("<f><![CDATA[<a> & ]]]]> b</f>") == "<a> & ]] b");
  CHECK(xml_name("<f>\n a b </f>") == "a b");
  CHECK(xml_name("<f xml:space=\"preserve\"> a </f>") == " a ");
  CHECK(xml_name("<f ><!-- x --> a <?p q?><!----></f >") == "a");
  CHECK(xml_numbers("1 0\r\n 0") == list{1, 0, 0});
  CHECK(xml_numbers("<![CDATA[1]]>2") == list{12});

  const auto in_json = [](const std::string& text) { return json(json_element("\"type\":\"" + text + "\"")); };
  CHECK(in_json("a\\u0000") == "3:10: this escape stands for a zero byte");
  CHECK(in_json("\\u001b[0m") == "3:9: this escape stands for a control character");
  CHECK(in_json("\\u0085") == "3:9: this escape stands for a control character");
  CHECK(in_json("\xC2\x85").ends_with("here is a control character"));
  CHECK(in_json("\xC2\xA0").find("control") == std::string::npos);
  CHECK(in_json("\\ud800") == "3:9: this escape stands for no character");
  CHECK(in_json("\\udc00\\ud800") == "3:9: this escape stands for no character");
  CHECK(in_json("\\ud800\\ue000") == "3:9: this escape stands for no character");
  CHECK(in_json("\\ud800\\u0041") == "3:9: this escape stands for no character");
  CHECK(in_json("\\x41") == "3:9: this is not an escape of a text");
  CHECK(in_json("\\b") == "3:9: this is not an escape of a text");
  CHECK(in_json("\\u12g4") == "3:9: \\u needs four hexadecimal digits");
  CHECK(in_json("a\nb") == "3:10: a line end or tab within quotes");
  CHECK(in_json("a\\nb") == "3:8: element 1: 'type' has a control character");
  CHECK(in_json("") == "3:8: element 1: 'type' is empty");

  const auto in_xml = [](const std::string& text) { return xml(xml_element("<type>" + text + "</type>")); };
  CHECK(in_xml("&#0;") == "3:7: this escape stands for a zero byte");
  CHECK(in_xml("&#x1b;") == "3:7: this escape stands for a control character");
  CHECK(in_xml("a&#xD800;") == "3:8: this escape stands for no character");
  CHECK(in_xml("&#x110000;") == "3:7: this escape stands for no character");
  CHECK(in_xml("&#99999999999;") == "3:7: this escape stands for no character");
  CHECK(in_xml("&#-1;") == "3:7: this escape stands for no character");
  CHECK(in_xml("&#65x;") == "3:7: this escape stands for no character");
  CHECK(in_xml("&#;") == "3:7: this escape stands for no character");
  CHECK(in_xml("a & b") == "3:9: '&' begins no known entity (write &amp; for the character itself)");
  CHECK(in_xml("&nbsp;") == "3:7: '&' begins no known entity (write &amp; for the character itself)");
  CHECK(in_xml("1<!-- c -->2") == "3:18: the text of 'type' goes on behind a comment");
  CHECK(in_xml("1<?c?>&#50;") == "3:13: the text of 'type' goes on behind a comment");
  CHECK(in_xml("<!-- a -- b -->x") == "3:16: '--' must not stand within a comment");
  CHECK(in_xml(" ") == "3:7: element 1: 'type' is empty");
  CHECK(xml(xml_element("<type/><version>1</version>")) == "3:8: element 1: 'type' is empty");
  CHECK(in_xml("a\nb") == "3:7: element 1: 'type' has a control character");
}

TEST_CASE("what is no JSON") {
  CHECK(json("") == "1:1: the file is empty");
  CHECK(json(" \n") == "1:1: the file is empty");
  CHECK(json("[]") == "1:1: a model must be an object {...}");
  CHECK(json("42") == "1:1: a model must be an object {...}");
  CHECK(json("{,") == "1:2: expected a name in quotes");
  CHECK(json("{'a'") == "1:2: expected a name in quotes");
  CHECK(json("{\"a\" 1") == "1:6: expected ':'");
  CHECK(json(json_model("\"elements\":[],")) == "2:15: expected a value after the comma");
  CHECK(json(json_model("\"elements\":[] \"gravity\"")) == "2:15: expected ',' or '}'");
  CHECK(json("// a model\n{").starts_with("1:1: "));
  CHECK(json(json_model(json_gravity + "\"elements\":[]") + " x") ==
        "2:35: unexpected content after the end of the model");
  CHECK(json("{\"kte_model\":{\"version\":\"") == "1:26: the file ends in the middle of the model");
}

TEST_CASE("what is no XML") {
  CHECK(xml("") == "1:1: the file is empty");
  CHECK(xml("<!-- -->") == "1:9: the file ends in the middle of the model");
  CHECK(xml("x") == "1:1: expected a tag, got text");
  CHECK(xml("<a></b>") == "1:1: a model file begins with <cereal>");
  CHECK(xml("<!DOCTYPE a [<!ENTITY b '<'>]><cereal/>") == "1:1: a model file has no DOCTYPE");
  CHECK(xml(" <?xml version='1.0'?><cereal/>").ends_with("the declaration of XML belongs at the start"));
  CHECK(xml(xml_model("<gravity>0 0 0</gravit>")) == "2:15: expected </gravity>");
  CHECK(xml(xml_model("</elements>")) == "2:1: expected </kte_model>");
  CHECK(xml(xml_model("<gravity/ >")) == "2:10: expected '>'");
  CHECK(xml(xml_model("<gravity size>")) == "2:14: expected '='");
  CHECK(xml(xml_model("<gravity size=1>")) == "2:15: expected a quote");
  CHECK(xml(xml_model("<gravity size='<'>")) == "2:10: 'gravity' has no attribute 'size'");
  CHECK(xml(xml_model("< gravity>")) == "2:2: expected a name");
  const auto good = xml_model("<gravity>0 0 0</gravity><elements/>");
  CHECK(xml("<?xml version=\"1.0\"?><!-- a --> <?b?>" + good + "\n<!-- c -->\n").empty());
  CHECK(xml("<?xml version='1.0' encoding='latin1'?>" + good) == "1:21: the encoding must be UTF-8");
  CHECK(xml("<?xml encoding='UTF-8'?>" + good).ends_with(": the version of XML must be 1.0"));
  CHECK(xml("<?xml version='1.0' coding='UTF-8'?>" + good) == "1:21: 'xml' has an unknown attribute 'coding'");
  CHECK(xml("<?xml version='1.0'" + good) == "1:20: expected '?'");
  CHECK(xml(good + "x") == "2:57: unexpected content after the end of the model");
  CHECK(xml(good + good) == "2:57: unexpected content after the end of the model");
}

TEST_CASE("files are UTF-8, with a byte order mark or without") {
  const auto model = json_model(json_gravity + "\"elements\":[]");
  CHECK(json("\xEF\xBB\xBF" + model).empty());
  CHECK(json("\xEF\xBB\xBF{,") == "1:2: expected a name in quotes");
  CHECK(xml("\xEF\xBB\xBF<?xml version='1.0'?>" + xml_model("<gravity>0 0 0</gravity><elements/>")).empty());
  using namespace std::string_literals;
  const std::string utf16 = "1:1: this is UTF-16, and kte reads UTF-8: save the file as UTF-8";
  for (const std::string& text : {"\xFF\xFE{"s, "\xFE\xFF"s, "{\0\n\0"s, "\0{\0\n"s}) CHECK(json(text) == utf16);
  CHECK(xml("\xFF\xFE<\0"s) == utf16);
  CHECK(json("\xFF\xFE\0\0{\0\0\0"s) == "1:1: this is UTF-32, and kte reads UTF-8: save the file as UTF-8");
  CHECK(json("{\0\n "s) == "1:2: here is a zero byte");
  CHECK(json(model + std::string(1, '\0')) == "2:34: here is a zero byte");
  CHECK(xml("<cereal>\x1b") == "1:9: here is a control character");
  for (const char* bad :
       {"\x80", "\xC0\xAF", "\xC3", "\xE0\x80\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xF5", "\xE2\x82"})
    CHECK(json(json_element(std::string("\"type\":\"") + bad + "\"")) == "3:9: this is not UTF-8");
  // places count characters
  CHECK(json(json_element("\"type\":\"é€\U0001F600\" x")) == "3:14: expected ',' or '}'");
}

TEST_CASE("records know where they were read") {
  const auto m = from_json(
      json_element("\"type\":\"t\",\"version\":1,\n\"ports\":{\"f\":\"a\"},\"parameters\":{ \"p\":1}"), "m.json");
  const auto& e = m.elements.at(0);
  CHECK(to_string(e.place) == "m.json:3:8: ");
  CHECK(to_string(e.connections.at(0).place) == "m.json:4:10: ");
  CHECK(to_string(e.parameters.at(0).place) == "m.json:4:34: ");
  CHECK(e == kte::element_record{"t", 1, {{"f", "a"}}, {{"p", {1}}}});
}

TEST_CASE("a file cut off anywhere is refused, with a byte changed anywhere refused or a model") {
  const auto data = std::filesystem::path(__FILE__).parent_path().parent_path() / "data";
  for (const bool is_xml : {false, true}) {
    const std::string text = kte::detail::read_file(data / (is_xml ? "pendulum.xml" : "pendulum.json"));
    const auto read = [is_xml](const std::string& t) { return is_xml ? xml(t) : json(t); };
    CHECK(read(text).empty());
    const std::size_t end = text.find_last_not_of(" \n\r\t");
    for (std::size_t n = 0; n < end; n += 3) CHECK_FALSE(read(text.substr(0, n)).empty());
    for (std::size_t i = 0; i < text.size(); ++i)
      for (const char* change : {"", "<", "\"", "\\", "&", "/", "\x80", "}", "-->"}) {
        auto damaged = text;
        (void)read(damaged.replace(i, 1, change));
      }
  }
}

TEST_CASE("model files by their name") {
  const auto load = [](const std::filesystem::path& path) {
    return kte::test::message_of<kte::bad_file>([&] { (void)kte::load_model(path); });
  };
  const auto json_text = json_model(json_gravity + "\"elements\":[]");
  const auto xml_text = xml_model("<gravity>0 0 0</gravity><elements/>");
  CHECK(load(scratch(".JSON", json_text).path).empty());
  CHECK(load(scratch(".Xml", xml_text).path).empty());
  CHECK(load("model.txt") == "kte: 'model.txt': a model file ends in .xml, .json or .kte");
  CHECK(load("/nonexistent/m.json") == "kte: cannot open '/nonexistent/m.json': No such file or directory");
  const scratch directory(".json");
  std::filesystem::remove(directory.path);
  std::filesystem::create_directory(directory.path);
  CHECK(load(directory.path) == "kte: cannot read '" + directory.path.string() + "': Is a directory");
}

}  // namespace model_reader_test
