#include <kte/io/table_reader.hpp>
#include <kte/io/table_writer.hpp>

#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>

#include "catch.hpp"

using namespace kte;
using kte::test::contains_text;

namespace {

/// A file of its own, removed at the end.
struct scratch {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("kte_table_" + std::to_string(std::random_device{}()) + ".txt");

  explicit scratch(const std::string& content = "") { std::ofstream(path, std::ios::binary) << content; }
  ~scratch() { std::filesystem::remove(path); }
  std::string text() const {
    std::ostringstream s;
    s << std::ifstream(path, std::ios::binary).rdbuf();
    return s.str();
  }
};

TEST_CASE("A table is a line of names and lines of numbers") {
  scratch file;
  table_writer out(file.path, {"t", "q", "qd", "n", "f"});
  out.row(0.0, 0.1, -1e-300, 7, 0.1f);
  out.row(1.5, std::vector<double>{1.0 / 3, 2e22}, -8LL, std::array<double, 1>{5});
  CHECK(file.text().empty());
  out.flush();
  CHECK(file.text() == "t q qd n f\n0 0.1 -1e-300 7 0.1\n1.5 0.3333333333333333 2e+22 -8 5\n");
  out.row(1, 2, 3, 4, 5);
  out.close();
  CHECK(file.text().ends_with("\n1 2 3 4 5\n"));
  out.close();
  CHECK_THROWS_WITH(out.row(1, 2, 3, 4, 5), contains_text("is closed"));
  CHECK_THROWS_AS(out.flush(), bad_file);
}

TEST_CASE("The destructor writes what is left") {
  scratch file;
  { table_writer(file.path, {"x"}).row(3); }
  CHECK(file.text() == "x\n3\n");
}

TEST_CASE("Numbers are read back bit for bit") {
  scratch file;
  using limits = std::numeric_limits<double>;
  std::vector<double> values = {
      0.0,      -0.0, limits::max(), limits::min(), -limits::denorm_min(), limits::infinity(), -limits::infinity(),
      0.1 + 0.2};
  std::mt19937_64 random(1);
  while (values.size() < 20000) {
    const double x =
        std::ldexp(std::uniform_real_distribution<>(-1, 1)(random), static_cast<int>(random() % 2000) - 1000);
    values.push_back(x);
  }
  table_writer out(file.path, {"i", "x"});
  for (std::size_t i = 0; i < values.size(); ++i) out.row(i, values[i]);
  out.row(-1, limits::quiet_NaN());
  out.close();
  const table t = read_table(file.path);
  CHECK(t.names == std::vector<std::string>{"i", "x"});
  REQUIRE(t["x"].size() == values.size() + 1);
  for (std::size_t i = 0; i < values.size(); ++i) {
    REQUIRE(t["i"][i] == static_cast<double>(i));
    REQUIRE(std::memcmp(&t["x"][i], &values[i], sizeof(double)) == 0);
  }
  CHECK(std::isnan(t["x"].back()));
  CHECK_THROWS_WITH(t["y"], contains_text("no column 'y'"));
}

TEST_CASE("Bad names and rows of the wrong size are rejected") {
  scratch file("untouched");
  using names = std::vector<std::string>;
  CHECK_THROWS_WITH(table_writer(file.path, names{}), contains_text("needs a column"));
  CHECK_THROWS_WITH(table_writer(file.path, {"a", "", "b"}), contains_text("no name"));
  CHECK_THROWS_WITH(table_writer(file.path, {"a", "b c"}), contains_text("'b c' has a blank"));
  CHECK_THROWS_AS(table_writer(file.path, {"a", "b\nc"}), bad_argument);
  CHECK_THROWS_WITH(table_writer(file.path, {"a", "b", "a"}), contains_text("two columns are named 'a'"));
  CHECK(file.text() == "untouched");
  table_writer out(file.path, {"a", "b"});
  CHECK_THROWS_WITH(out.row(1),
                    contains_text("a row of 1 numbers in a table of 2 columns") && contains_text(file.path.string()));
  CHECK_THROWS_AS(out.row(1, std::vector<double>{2, 3}), bad_argument);
  out.row(1, 2);
  out.close();
  CHECK(file.text() == "a b\n1 2\n");
}

TEST_CASE("Files that cannot be opened or written are errors") {
  CHECK_THROWS_WITH(table_writer("/no/such/folder/x.txt", {"a"}),
                    contains_text("cannot open '/no/such/folder/x.txt': No such file"));
  CHECK_THROWS_WITH(read_table("/no/such/file"), contains_text("cannot open '/no/such/file': No such file"));
  CHECK_THROWS_WITH(read_table("/tmp"), contains_text("cannot read '/tmp': Is a directory"));
}

TEST_CASE("A full disk is an error") {
  if (!std::filesystem::exists("/dev/full")) return;
  const auto full = contains_text("cannot write '/dev/full': No space left on device");
  {
    table_writer out("/dev/full", {"a"});
    out.row(1);
    CHECK_THROWS_WITH(out.close(), full);
    CHECK_NOTHROW(out.close());
    CHECK_THROWS_AS(out.row(1), bad_file);
  }
  {
    table_writer out("/dev/full", {"a"});
    CHECK_THROWS_WITH(out.flush(), full);
  }
  {
    table_writer out("/dev/full", {"a"});
    CHECK_THROWS_WITH(
        [&] {
          for (int i = 0; i < 100000; ++i) out.row(i);
        }(),
        full);
  }
  CHECK_NOTHROW(table_writer("/dev/full", {"a"}));
}

TEST_CASE("A bad file is reported by line and column") {
  const auto message = [](const std::string& content) {
    scratch file(content);
    try {
      read_table(file.path);
    } catch (const bad_file& e) {
      const std::string what = e.what(), path = "'" + file.path.string() + "', ";
      return what.substr(what.find(path) + path.size());
    }
    return std::string();
  };
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

}  // namespace
