#include <kte/io/table_reader.hpp>
#include <kte/io/table_writer.hpp>

#include <cstdlib>

#include "catch.hpp"
#include "scratch.hpp"

#if __has_include(<sys/wait.h>)
#  include <sys/wait.h>
#  include <unistd.h>

namespace table_crash_test {

using namespace kte;
using kte::test::scratch;

/// Runs f in its own process, which must end by itself.
template <class F>
void in_child(const F& f) {
  const auto child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    f();
    std::_Exit(1);
  }
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  CHECK((WIFEXITED(status) && WEXITSTATUS(status) == 7));
}

TEST_CASE("in every format, what was flushed outlives a program that ends without closing") {
  for (const auto& extension : test::table_extensions) {
    CAPTURE(extension);
    scratch file(extension);
    in_child([&] {
      table_writer out(file.path, {"t", "x"});
      for (int i = 0; i < 1000; ++i) out.row(i, 0.1 * i);
      out.flush();
      for (int i = 1000; i < 1010; ++i) out.row(i, 0.1 * i);  // stay in the buffer
      std::_Exit(7);
    });
    const table t = read_table(file.path);
    REQUIRE(t.rows() == 1000);
    CHECK(t["x"].back() == 0.1 * 999);

    in_child([&] {
      table_writer out(file.path, {"t", "x"});
      out.flush_every(10);
      for (int i = 0; i < 1015; ++i) out.row(i, 0.1 * i);
      std::_Exit(7);
    });
    CHECK(read_table(file.path).rows() == 1010);
  }
}

}  // namespace table_crash_test
#endif
