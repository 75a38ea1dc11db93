#include <kte/io/memory_table.hpp>
#include <kte/io/table_reader.hpp>
#include <kte/io/table_writer.hpp>

#include <Eigen/Core>

#include <array>

#include "catch.hpp"
#include "digits50.hpp"
#include "scratch.hpp"

namespace memory_table_test {

using namespace kte;
using kte::test::scratch;

template <class Table>
void fill(Table& out) {
  out.flush_every(2);
  out.row(0.0, std::array{1.0f, 0.1f}, 7u);
  out.row(1, std::vector<double>{2}, 1.0 / 3, true);
  out.flush();
  out.close();
}

TEST_CASE("a table in memory is what the same rows give in a file of any format") {
  const std::vector<std::string> names{"t", "a", "b/x", "c"};
  memory_table in_memory(names);
  fill(in_memory);
  const table& t = in_memory.contents();
  CHECK(t.names == names);
  CHECK(t.columns == std::vector<std::vector<double>>{{0, 1}, {1, 2}, {double{0.1f}, 1.0 / 3}, {7, 1}});
  CHECK(t.rows() == 2);
  CHECK(&in_memory["c"] == &t.columns[3]);
  for (const auto& extension : test::table_extensions) {
    scratch file(extension);
    table_writer out(file.path, names);
    fill(out);
    const table read = read_table(file.path);
    CHECK(read.names == t.names);
    CHECK(read.columns == t.columns);
  }
}

TEST_CASE("rows take numbers and vectors of any scalar type") {
  using many_digits = kte::test::digits50;
  memory_table out({"a", "b", "c", "d"});
  out.row(many_digits(1) / 3, 0.5L, Eigen::Vector2f(0.25f, -2));
  CHECK(out.contents().columns == std::vector<std::vector<double>>{{1.0 / 3}, {0.5}, {0.25}, {-2}});
}

TEST_CASE("a table in memory rejects what files reject") {
  using test::message_of;
  CHECK(message_of<bad_argument>([] { memory_table({}); }) == "kte: a table needs a column");
  CHECK(message_of<bad_argument>([] { memory_table({"a,b"}); }) == "kte: the column name 'a,b' has a comma");
  memory_table out({"a", "b"});
  CHECK(message_of<bad_argument>([&] { out.row(1); }) == "kte: a row of 1 numbers in a table of 2 columns");
  CHECK(message_of<unknown_name>([&] { (void)out["c"]; }) == "kte: the table has no column 'c'");
  CHECK(out.contents().rows() == 0);
}

}  // namespace memory_table_test
