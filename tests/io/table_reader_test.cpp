#include <kte/io/table_reader.hpp>

#include <cmath>
#include <limits>

#include "catch.hpp"
#include "scratch.hpp"

namespace table_reader_test {

using namespace kte;
using kte::test::scratch;

std::string message(const std::string& content, const char* extension = ".txt") {
  scratch file(extension, content);
  return test::message_about<bad_file>(file, [&] { (void)read_table(file.path); });
}

TEST_CASE("a bad text is reported by line and column") {
  CHECK(message("a b\n").empty());
  CHECK(message("a\tb\r\n 1   2 \r\n").empty());
  CHECK(message("") == "line 1: no column names");
  CHECK(message("\n1\n") == "line 1: no column names");
  CHECK(message("a b") == "line 1: no line end, the file is cut off");
  CHECK(message("a b a\n") == "line 1, column 3: 'a' is there twice");
  CHECK(message("a b\n1 2\n3 x4\n") == "line 3, column 2: 'x4' is not a number");
  CHECK(message("a b\n1 2z\n") == "line 2, column 2: '2z' is not a number");
  CHECK(message("a b\n1 1e999\n") == "line 2, column 2: '1e999' is not a number");
  CHECK(message("a b\n1 2 3\n") == "line 2, column 3: '3' is one too many");
  CHECK(message("a b\n1\n") == "line 2: 1 numbers for 2 columns");
  CHECK(message("a b\n1 2\n\n") == "line 3: 0 numbers for 2 columns");
  CHECK(message("a b\n1 2\n3 4.") == "line 3: no line end, the file is cut off");
}

TEST_CASE("zero bytes and other encodings than UTF-8 are said") {
  using namespace std::string_literals;
  CHECK(message("a b\n1 2\0\n"s) == "line 2: here is a zero byte, after 3 bytes of the line");
  CHECK(message("a\0b\n1 2\n"s) == "line 1: here is a zero byte, after 1 bytes of the line");
  for (const std::string& text : {"\xFF\xFE"
                                  "a\0\n\0"s,
                                  "\xFE\xFF\0a\0\n"s, "a\0\n\0"s})
    CHECK_THAT(message(text, ".csv"),
               test::contains_text(".csv': this is UTF-16, and kte reads UTF-8: save the file as UTF-8"));
}

TEST_CASE("commas and tabs separate cells one by one, with blanks around them") {
  const auto cells = [](const char* extension, const std::string& content) {
    scratch file(extension, content);
    return read_table(file.path);
  };
  const table commas = cells(".csv", "t, q 1\r\n1,inf\r\n-2 , NaN\r\n");
  CHECK(commas.names == std::vector<std::string>{"t", "q 1"});
  CHECK(commas["t"] == std::vector<double>{1, -2});
  CHECK(commas["q 1"][0] == std::numeric_limits<double>::infinity());
  CHECK(std::isnan(commas["q 1"][1]));
  CHECK(cells(".tsv", "t\tq 1\n1\t 2\n")["q 1"] == std::vector<double>{2});

  CHECK(message("a,b\n1 2\n", ".csv") == "line 2, column 1: '1 2' is not a number");
  CHECK(message("a,b\n1,,2\n", ".csv") == "line 2, column 2: '' is not a number");
  CHECK(message("a,,b\n", ".csv") == "line 1, column 2: '' is not a name");
  CHECK(message("a,b\n1,\n", ".csv") == "line 2, column 2: '' is not a number");
  CHECK(message("a,b\n1,2,\n", ".csv") == "line 2, column 3: '' is one too many");
  CHECK(message("a,b,\n1,2,\n", ".csv") == "line 1, column 3: '' is not a name");
  CHECK(message("a\tb\n1,2\n", ".tsv") == "line 2, column 1: '1,2' is not a number");
}

TEST_CASE("cells may be in quotes, and a byte order mark may come first") {
  const auto read = [](const char* extension, const std::string& content) {
    scratch file(extension, content);
    return read_table(file.path);
  };
  const table t = read(".csv",
                       "\xEF\xBB\xBF"
                       "t, \"a,b\" ,\"say \"\"a\"\"\",\"\"\"\"\r\n1,\"2.5\",3, 4\r\n");
  CHECK(t.names == std::vector<std::string>{"t", "a,b", "say \"a\"", "\""});
  CHECK(t["a,b"] == std::vector<double>{2.5});
  CHECK(t["\""] == std::vector<double>{4});
  CHECK(read(".CSV", "\"t\",\"x\"\n1,2\n")["x"] == std::vector<double>{2});
  CHECK(read(".tsv", "\"t\"\t\"a\tb\"\n1\t2\n")["a\tb"] == std::vector<double>{2});
  CHECK(read(".ssv", "\"t\"  \"a b\" c\n1 2 3\n")["a b"] == std::vector<double>{2});
  CHECK(read(".csv", "5\" disk\n1\n").names == std::vector<std::string>{"5\" disk"});

  CHECK(message("t,\"a\n1,2\n", ".csv") == "line 1, column 2: 'a' does not end at its closing quote");
  CHECK(message("t,\"a\"b,c\n", ".csv") == "line 1, column 2: 'a' does not end at its closing quote");
  CHECK(message("t,\"a\"\"\n", ".csv") == "line 1, column 2: 'a\"' does not end at its closing quote");
  CHECK(message("t,\"\"\n", ".csv") == "line 1, column 2: '' is not a name");
  CHECK(message("t,\"a\",\"a\"\n", ".csv") == "line 1, column 3: 'a' is there twice");
  CHECK(message("\"a,b\"\n1,2\n", ".csv") == "line 2, column 2: '2' is one too many");
  CHECK(message("a b\n1 \"2 3\"\n") == "line 2, column 2: '2 3' is not a number");
}

}  // namespace table_reader_test
