#include <kte/io/printable.hpp>
#include <kte/robots/detail/identifiers.hpp>

#include "catch.hpp"

namespace printable_test {

using kte::detail::printable, kte::detail::cpp_text;

TEST_CASE("hidden characters of names are escaped in messages and in headers, and others stay") {
  CHECK(printable("elbow \xC3\xA9 \xE6\xA9\x9F") == "elbow \xC3\xA9 \xE6\xA9\x9F");
  CHECK(printable("\x1B[31m\n\x7F\xC2\x85") == "\\x1B[31m\\x0A\\x7F\\xC2\\x85");
  CHECK(printable("\xE2\x80\xAExyz\xE2\x80\xAC \xE2\x81\xA6\xE2\x80\x8F\xD8\x9C\xE2\x80\xA8") ==
        "\\xE2\\x80\\xAExyz\\xE2\\x80\\xAC \\xE2\\x81\\xA6\\xE2\\x80\\x8F\\xD8\\x9C\\xE2\\x80\\xA8");
  CHECK(printable("a\xFFz") == "a\\xFFz");
  CHECK(printable("first\n  second") == "first\n  second");
  CHECK(cpp_text("x\"\\\xC3\xA9") == "\"x\\\"\\\\\xC3\xA9\"");
  CHECK(cpp_text("\x01\xE2\x80\xAE\xC2\x85\xFF") == "\"\\001\\342\\200\\256\\302\\205\\377\"");
}

}  // namespace printable_test
