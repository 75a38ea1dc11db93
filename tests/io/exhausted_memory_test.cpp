#include <kte/io/archive_file.hpp>
#include <kte/reak/mass_matrix_calc.hpp>

#include "allocation_count.hpp"
#include "catch.hpp"
#include "chain/models.hpp"
#include "scratch.hpp"

// Whichever allocation fails (those of table_allocation_test.cpp, of the same program), and if all do that follow:
// files are as before, or as they were to be.

namespace exhausted_memory_test {

using namespace kte;
using kte::test::scratch;

/// A file in its own folder.
struct kept_file : test::scratch_folder {
  std::filesystem::path file;
  explicit kept_file(const char* extension)
      : file(path / (std::string("a model of a long name that needs separate memory") + extension)) {
    detail::replace_file(file, "what was there");
  }
};
/// save(path) with each of its allocations failing.
template <class Save>
void check_saving(const char* extension, const Save& save) {
  CAPTURE(extension);
  const kept_file good(extension);
  save(good.file);
  const auto whole = detail::read_file(good.file);
  allocations::fail_each([&] { return std::make_unique<kept_file>(extension); }, [&](auto& f) { save(f->file); },
                         [&](auto& f, bool threw) {
                           REQUIRE(detail::read_file(f->file) == (threw ? "what was there" : whole));
                           REQUIRE(f->entries() == 1);
                         });
}

TEST_CASE("a file that cannot be written for want of memory is as before") {
  runtime_chain c;
  c << models::pendulum << rigid_link_2D("tip", "a frame of a name that streams need new memory for", along_x(0.1))
    << rigid_link_2D("tip", "short", along_x(1.0 / 3));
  auto s = c.make_state();
  s.coordinate("q").q = 0.1;
  archive a;
  a.add("chain", c)
      .add("start", s)
      .add("numbers", std::array{0.1L, 0.5L})
      .add("calc", mass_matrix_calc(c) << all_inertias << all_coordinates);
  auto limits = unlimited(c);
  limits.upper[0] = 1.5;
  for (const char* extension : {".xml", ".json", ".kte"}) {
    check_saving(extension, [&](const auto& path) { save_model(path, c, limits); });
    check_saving(extension, [&](const auto& path) { save_archive(path, a); });
  }
  check_saving(".json", [](const auto& path) { detail::replace_file(path, "new", {.sync = true}); });
}

TEST_CASE("a file that cannot be read for want of memory gives nothing, and is read the next time") {
  runtime_chain c;
  c << models::pendulum;
  auto s = c.make_state();
  s.coordinate("q").q = 0.1;
  archive a;
  a.add("chain", c).add("start", s).add("numbers", std::array{0.1L, 0.5L});
  for (const char* extension : {".xml", ".json", ".kte"}) {
    CAPTURE(extension);
    const scratch file(extension);
    save_archive(file.path, a);
    allocations::fail_each([] { return archive(); }, [&](archive& b) { b = load_archive(file.path); },
                           [&](archive& b, bool threw) { REQUIRE(b.record() == (threw ? archive() : a).record()); });
    allocations::fail_each([] { return model_record(); }, [&](model_record& m) { m = load_model(file.path); },
                           [&](model_record& m, bool threw) { REQUIRE(m == (threw ? model_record() : record_of(c))); });
  }
  // into a state, and into an archive
  const auto fresh = [&c] { return c.make_state(); };
  allocations::fail_each(
      fresh, [&](runtime_state& t) { a.restore("start", t); },
      [&](runtime_state& t, bool threw) { REQUIRE(t.coordinate("q").q == (threw ? 0 : 0.1)); });
  allocations::fail_each([&a] { return a; }, [&](archive& b) { b.add("more", c); },
                         [&](archive& b, bool threw) { REQUIRE(b.has("more") == !threw); });
  allocations::fail_each([] { return runtime_chain(); },
                         [&](runtime_chain& d) { d = a.chain("chain", models::registry()); },
                         [&](runtime_chain& d, bool threw) { REQUIRE(d.dofs() == (threw ? 0 : 1)); });
}

}  // namespace exhausted_memory_test
