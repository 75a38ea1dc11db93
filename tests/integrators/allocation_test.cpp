#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/euler.hpp>
#include <kte/io/table_writer.hpp>

#include <cstdlib>
#include <new>

#include "catch.hpp"

namespace {
long long allocations = 0;
}

[[gnu::noinline]] void* operator new(std::size_t n) {
  ++allocations;
  if (void* p = std::malloc(n == 0 ? 1 : n)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }

using namespace kte;

TEST_CASE("Integration of a fixed size and the rows of a table do not allocate") {
  const auto f = [](double, const Eigen::Vector2d& x) { return Eigen::Vector2d(x[1], -std::sin(x[0])); };
  table_writer out("/dev/null", {"t", "q", "qd"});
  long long rows = 0;
  const auto record = [&](double t, const Eigen::Vector2d& x) { out.row(t, x), ++rows; };

  auto before = allocations;
  ::operator delete(::operator new(1));
  const auto counted = allocations;
  CHECK(counted == before + 1);

  before = allocations;
  dormand_prince45 a(f, 0.0, Eigen::Vector2d(1, 0));
  a.integrate(1);
  a.integrate(10, record);
  a.integrate(100, every(0.01), record);
  euler b(f, 0.0, Eigen::Vector2d(1, 0), 0.01);
  b.integrate(100, every(0.015), record);
  const auto after = allocations;
  CHECK(after == before);
  CHECK(rows > 15000);
}
