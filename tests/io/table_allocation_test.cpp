#include <kte/io/recorder.hpp>
#include <kte/io/table_writer.hpp>

#include "allocations.hpp"
#include "catch.hpp"
#include "chain/models.hpp"
#include "scratch.hpp"

using namespace kte;
using kte::test::scratch;

namespace {

TEST_CASE("Rows of tables and of recorders do not allocate, nor do their flushes") {
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

}  // namespace
