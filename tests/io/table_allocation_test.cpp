#include <kte/io/recorder.hpp>
#include <kte/io/table_reader.hpp>
#include <kte/io/table_writer.hpp>

#include "allocations.hpp"
#include "catch.hpp"
#include "chain/models.hpp"
#include "scratch.hpp"

namespace table_allocation_test {

using namespace kte;
using kte::test::scratch;

TEST_CASE("rows of tables and of recorders do not allocate, nor do their flushes") {
  const std::vector<double> x(40, 1.0 / 3);
  std::vector<std::string> names{"t"};
  for (std::size_t i = 0; i < x.size(); ++i) names.push_back("x/" + std::to_string(i));
  const auto s = make_state(models::tree);
  for (const auto& extension : test::table_extensions) {
    CAPTURE(extension);
    scratch file(extension), other(extension);
    table_writer out(file.path, names);
    recorder rec(other.path, models::tree);
    out.flush_every(70);
    CHECK(allocations::during([&] {
            for (int i = 0; i < 1000; ++i) out.row(0.1 * i, x), rec.row(0.1 * i, s);
            out.flush(), rec.flush();
          }) == 0);
    CHECK(file.text().size() > 3 * 65536);  // more than the buffer
    CHECK(other.text().size() > 3 * 65536);
  }
  memory_table in_memory(names);
  in_memory.reserve(1000);
  CHECK(allocations::during([&] {
          for (int i = 0; i < 1000; ++i) in_memory.row(0.1 * i, x);
        }) == 0);
}

TEST_CASE("a row for which there is no memory is not there, also not half of it") {
  std::vector<std::string> names{"t"};
  for (int i = 0; i < 20000; ++i) names.push_back("x" + std::to_string(i));
  const std::vector<double> x(20000, 1.0 / 3), short_as_text(20000, 0.0);
  for (const auto& extension : test::table_extensions) {
    CAPTURE(extension);
    const scratch file(extension);
    allocations::fail_each(
        [&] {
          auto out = std::make_unique<table_writer>(file.path, names);
          out->row(1, short_as_text);
          return out;
        },
        [&](auto& out) { out->row(2, x); },
        [&](auto& out, bool threw) {
          out->row(3, x);
          out->close();
          const table t = read_table(file.path);
          REQUIRE(t["t"] == (threw ? std::vector<double>{1, 3} : std::vector<double>{1, 2, 3}));
          REQUIRE(t.columns.back().size() == t.rows());
        });
  }
  allocations::fail_each(
      [] {
        return memory_table({"t", "q", "v"});
      },
      [](auto& out) { out.row(1, 2, 3); },
      [](auto& out, bool threw) {
        for (const auto& c : out.contents().columns) REQUIRE(c.size() == (threw ? 0 : 1));
      });
}

}  // namespace table_allocation_test
