#include <kte/view/svg/raised_text.hpp>

#include "catch.hpp"
#include "view/svg_document.hpp"

namespace svg_text_test {

using namespace kte::detail::svg;

TEST_CASE("texts of any bytes are text of XML, and what cannot be shown is U+FFFD") {
  const std::string lost = "\xEF\xBF\xBD";
  CHECK(printable("a\tb\r\nc") == "a b  c");
  CHECK(printable("\x01\x1F\x7F") == lost + lost + lost);
  CHECK(printable(std::string("\0", 1)) == lost);
  CHECK(printable("\xC2\x85\xC2\xA0") == lost + "\xC2\xA0");
  CHECK(printable("\xEF\xBF\xBE\xEF\xBF\xBF") == lost + lost);
  CHECK(printable("\xF0\x9F\xBF\xBF") == lost);                                         // U+1FFFF
  CHECK(printable("\xFF\xC3(\xED\xA0\x80") == lost + lost + "(" + lost + lost + lost);  // not UTF-8, a surrogate
  CHECK(printable("\xE2\x80\xAE") == lost);                                             // from right to left
  CHECK(printable("π😀é") == "π😀é");
  std::string out;
  append_xml(out, "<a b=\"c\">&'");
  CHECK(out == "&lt;a b=&quot;c&quot;&gt;&amp;'");
}

TEST_CASE("elements end, and attributes are in quotes") {
  svg_writer out;
  out.begin("g").set("fill", "a\"b").begin("path").set("x", -0.5).set("y", 12.345).end().element("title", "<&>").end();
  CHECK(out.document() ==
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<g fill=\"a&quot;b\">\n<path x=\"-.5\" y=\"12.35\"/>\n"
        "<title>&lt;&amp;&gt;</title></g>\n");
}

TEST_CASE("lengths have two decimals at most") {
  CHECK(decimal(0) == "0");
  CHECK(decimal(-0.001) == "0");
  CHECK(decimal(1.1) == "1.1");
  CHECK(decimal(-12.345) == "-12.35");
  CHECK(decimal(100) == "100");
  CHECK(decimal(0.07) == ".07");
  CHECK(decimal(1e300) == "100000");
  CHECK(decimal(-1e300) == "-100000");
}

TEST_CASE("texts that are too wide lose their middle, never half a character") {
  CHECK(shortened("tool/position/x", 100) == "tool/position/x");
  const std::string name(10000, 'a'), cut = shortened(name + "/v", 10);
  CHECK(text_width(cut) <= 10);
  CHECK(text_width(cut) > 9);
  CHECK(cut.starts_with("aaa"));
  CHECK(cut.ends_with("a/v"));
  CHECK(shortened("ππππππππ", 3) == "π…π");
  CHECK(shortened("abc", 0) == "…");
  CHECK(shortened("", 0).empty());
}

TEST_CASE("exponents are raised and what follows is not") {
  svg_writer out;
  put_raised(out.begin("text"), {"energy (10", "−9", " J)"}, 2);
  CHECK(out.end().document() ==
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<text>energy (10<tspan font-size=\"1.4\" dy=\"-.7\">−9</tspan>"
        "<tspan dy=\".7\"> J)</tspan></text>\n");
}

}  // namespace svg_text_test
