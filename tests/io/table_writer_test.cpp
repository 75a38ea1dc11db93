#include <kte/io/table_reader.hpp>
#include <kte/io/table_writer.hpp>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "catch.hpp"
#include "scratch.hpp"

namespace table_writer_test {

using namespace kte;
using kte::test::contains_text;
using kte::test::scratch;

TEST_CASE("a text is a line of names and lines of numbers") {
  const auto text = [](const char* extension) {
    scratch file(extension);
    table_writer out(file.path, {"t", "q", "tip/x", "n", "f"});
    out.row(0.0, 0.1, -1e-3, 7, 0.25f);
    out.row(1.5, std::vector<double>{1.0 / 3, 2e22}, -8LL, std::array<double, 1>{5});
    CHECK(file.text().empty());
    out.flush();
    const auto flushed = file.text();
    out.row(1, 2, 3, 4, 5);
    out.close();
    CHECK(file.text().starts_with(flushed));
    out.close();
    CHECK_THROWS_WITH(out.row(1, 2, 3, 4, 5), contains_text("is closed"));
    CHECK_THROWS_AS(out.flush(), bad_file);
    return file.text();
  };
  const std::string spaces =
      "t q tip/x n f\n0.0 0.1 -0.001 7.0 0.25\n1.5 0.3333333333333333 2e+22 -8.0 5.0\n1.0 2.0 3.0 4.0 5.0\n";
  const auto with = [&spaces](char separator) {
    std::string s = spaces;
    std::replace(s.begin(), s.end(), ' ', separator);
    return s;
  };
  CHECK(text(".ssv") == spaces);
  CHECK(text(".txt") == spaces);
  CHECK(text(".csv") == with(','));
  CHECK(text(".tsv") == with('\t'));
}

TEST_CASE("no number looks like an integer and the first row has no exponent, as PlotJuggler guesses types by it") {
  using limits = std::numeric_limits<double>;
  scratch file(".csv");
  table_writer out(file.path, {"a", "b", "c", "d"});
  out.row(1e-17, -2e22, 3, -0.0);
  out.row(1e-17, -2e22, limits::infinity(), -limits::infinity());
  out.row(limits::quiet_NaN(), -limits::quiet_NaN(), 0, 1);
  out.close();
  CHECK(file.text() ==
        "a,b,c,d\n0.00000000000000001,-20000000000000000000000.0,3.0,-0.0\n1e-17,-2e+22,inf,-inf\nnan,nan,0.0,1.0\n");
  table_writer longest(file.path, {"a", "b", "c"});
  longest.row(-limits::denorm_min(), limits::max(), -limits::min());
  longest.close();
  const table t = read_table(file.path);
  CHECK(t["a"][0] == -limits::denorm_min());
  CHECK(t["b"][0] == limits::max());
  CHECK(t["c"][0] == -limits::min());
  CHECK(file.text().find('e') == std::string::npos);
}

TEST_CASE("in every format numbers are read back bit for bit") {
  using limits = std::numeric_limits<double>;
  std::vector<double> values = {
      0.0,      -0.0, limits::max(), limits::min(), -limits::denorm_min(), limits::infinity(), -limits::infinity(),
      0.1 + 0.2};
  std::mt19937_64 random(1);
  while (values.size() < 5000) {
    const double x =
        std::ldexp(std::uniform_real_distribution<>(-1, 1)(random), static_cast<int>(random() % 2000) - 1000);
    values.push_back(x);
  }
  for (const auto& extension : test::table_extensions) {
    CAPTURE(extension);
    scratch file(extension);
    table_writer out(file.path, {"i", "x/y"});
    for (std::size_t i = 0; i < values.size(); ++i) out.row(i, values[i]);
    out.row(values.size(), limits::quiet_NaN());
    out.close();
    const table t = read_table(file.path);
    CHECK(t.names == std::vector<std::string>{"i", "x/y"});
    REQUIRE(t.rows() == values.size() + 1);
    REQUIRE(t["x/y"].size() == values.size() + 1);
    for (std::size_t i = 0; i < values.size(); ++i) {
      REQUIRE(t["i"][i] == static_cast<double>(i));
      REQUIRE(std::memcmp(&t["x/y"][i], &values[i], sizeof(double)) == 0);
    }
    CHECK(std::isnan(t["x/y"].back()));
    CHECK_THROWS_WITH(t["y"], contains_text("no column 'y'"));
  }
}

TEST_CASE("tables without rows keep their names, and the destructor writes what is left") {
  for (const auto& extension : test::table_extensions) {
    CAPTURE(extension);
    scratch file(extension);
    table_writer(file.path, {"t", "x"}).flush();
    CHECK(read_table(file.path).names == std::vector<std::string>{"t", "x"});
    CHECK(read_table(file.path).rows() == 0);
    { table_writer(file.path, {"t"}).row(3); }
    CHECK(read_table(file.path)["t"] == std::vector<double>{3});
    CHECK_NOTHROW(table_writer("/dev/full", {"t"}, format_of(file.path)));
  }
}

TEST_CASE("rows flush automatically after a number of rows, and when the buffer is full") {
  for (const auto& extension : test::table_extensions) {
    CAPTURE(extension);
    scratch file(extension);
    const auto rows = [&file] { return file.text().empty() ? 0 : read_table(file.path).rows(); };
    table_writer out(file.path, {"t", "x"});
    out.flush_every(3);
    std::vector<std::size_t> there;
    for (int i = 0; i < 7; ++i) out.row(i, i), there.push_back(rows());
    CHECK(there == std::vector<std::size_t>{0, 0, 3, 3, 3, 6, 6});
    out.flush();
    CHECK(rows() == 7);
    out.row(7, 7), out.row(8, 8);
    CHECK(rows() == 7);  // counted from the last flush
    out.row(9, 9);
    CHECK(rows() == 10);
    out.flush_every(0);
    for (int i = 10; i < 30000; ++i) out.row(i, 0.1 * i);  // at least 200 kB
    const auto n = rows();
    CHECK(n > 10000);
    CHECK(n < 30000);
    CHECK(read_table(file.path)["t"].back() == static_cast<double>(n - 1));
  }
}

TEST_CASE("bad names and rows of the wrong size are rejected") {
  scratch file(".txt", "untouched");
  using names = std::vector<std::string>;
  const auto message = [&file](const names& n) {
    return test::message_of<bad_argument>([&] { table_writer(file.path, n); });
  };
  CHECK(message({}) == "kte: a table needs a column");
  CHECK(message({"a", "", "b"}) == "kte: a column of a table has no name");
  CHECK(message({"a", "b c"}) == "kte: the column name 'b c' has a blank");
  CHECK(message({"a\n"}) == "kte: the column name 'a\n' has a blank");
  CHECK(message({"a,b"}) == "kte: the column name 'a,b' has a comma");
  CHECK(message({"a'"}) == "kte: the column name 'a'' has a quote or a backslash");
  CHECK(message({"a\""}) == "kte: the column name 'a\"' has a quote or a backslash");
  CHECK(message({"a\\b"}) == "kte: the column name 'a\\b' has a quote or a backslash");
  CHECK(message({"a\xC2\x85"}) == "kte: the column name 'a\xC2\x85' has a control character");
  CHECK(message({"a\x01"}) == "kte: the column name 'a\x01' has a control character");
  CHECK(message({"a", "b", "a"}) == "kte: two columns are named 'a'");
  CHECK(file.text() == "untouched");
  table_writer out(file.path, {"a", "b"});
  CHECK_THROWS_WITH(out.row(1),
                    contains_text("a row of 1 numbers in a table of 2 columns") && contains_text(file.path.string()));
  CHECK_THROWS_AS(out.row(1, std::vector<double>{2, 3}), bad_argument);
  out.row(1, 2);
  out.close();
  CHECK(file.text() == "a b\n1.0 2.0\n");
}

TEST_CASE("the extension chooses the format, and an unknown one is an error that lists the known ones") {
  scratch file(".dat", "untouched");
  const std::string message = "kte: the name '" + file.path.string() +
                              "' has no extension of a table: .ssv .txt .csv .tsv .npy .mcap (or give a table_format)";
  CHECK(test::message_of<bad_argument>([&] { table_writer(file.path, {"a"}); }) == message);
  CHECK(test::message_of<bad_argument>([&] { (void)read_table(file.path); }) == message);
  CHECK(file.text() == "untouched");
  table_writer out(file.path, {"a", "b"}, table_format::csv);
  out.row(1, 2);
  out.close();
  CHECK(file.text() == "a,b\n1.0,2.0\n");
  CHECK(read_table(file.path, table_format::csv)["b"] == std::vector<double>{2});
}

TEST_CASE("files that cannot be opened are errors") {
  CHECK_THROWS_WITH(table_writer("/no/such/folder/x.txt", {"a"}),
                    contains_text("cannot open '/no/such/folder/x.txt': No such file"));
  CHECK_THROWS_WITH(read_table("/no/such/file.csv"), contains_text("cannot open '/no/such/file.csv': No such file"));
  CHECK_THROWS_WITH(read_table("/tmp", table_format::npy), contains_text("cannot read '/tmp': Is a directory"));
}

TEST_CASE("in every format a full disk is an error") {
  if (!std::filesystem::exists("/dev/full")) return;
  const auto full = contains_text("cannot write '/dev/full': No space left on device");
  for (const auto& extension : test::table_extensions) {
    CAPTURE(extension);
    const auto format = format_of("x" + extension);
    {
      table_writer out("/dev/full", {"a"}, format);
      out.row(1);
      CHECK_THROWS_WITH(out.close(), full);
      CHECK_NOTHROW(out.close());
      CHECK_THROWS_AS(out.row(1), bad_file);
    }
    {
      table_writer out("/dev/full", {"a"}, format);
      CHECK_THROWS_WITH(out.flush(), full);
    }
    {
      table_writer out("/dev/full", {"a"}, format);
      CHECK_THROWS_WITH(
          [&] {
            for (int i = 0; i < 100000; ++i) out.row(i);
          }(),
          full);
    }
  }
}

}  // namespace table_writer_test
