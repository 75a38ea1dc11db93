#include <kte/events/events.hpp>
#include <kte/integrators/adams.hpp>
#include <kte/integrators/adams_BM.hpp>
#include <kte/integrators/bdf.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/euler.hpp>
#include <kte/integrators/implicit_midpoint.hpp>
#include <kte/integrators/prince_dormand87.hpp>
#include <kte/integrators/rodas.hpp>
#include <kte/integrators/stormer_verlet.hpp>
#include <kte/integrators/tr_bdf2.hpp>
#include <kte/io/table_writer.hpp>

#include "allocations.hpp"
#include "catch.hpp"

namespace allocation_test {

using namespace kte;

TEST_CASE("integration of a fixed size and the rows of a table do not allocate") {
  const auto f = [](double, const Eigen::Vector2d& x) { return Eigen::Vector2d(x[1], -std::sin(x[0])); };
  table_writer out("/dev/null", {"t", "q", "qd"}, table_format::ssv);
  long long rows = 0;
  const auto record = [&](double t, const Eigen::Vector2d& x) { out.row(t, x), ++rows; };

  CHECK(allocations::during([] { ::operator delete(::operator new(1)); }) == 1);
  CHECK(allocations::during([&] {
          dormand_prince45 a(f, 0.0, Eigen::Vector2d(1, 0));
          a.integrate(1);
          a.integrate(10, record);
          a.integrate(100, every(0.01), record);
          euler b(f, 0.0, Eigen::Vector2d(1, 0), 0.01);
          b.integrate(100, every(0.015), record);
        }) == 0);
  const auto run = [&](auto solver) { solver.integrate(100, every(0.01), record); };
  const Eigen::Vector2d x0(1, 0);
  CHECK(allocations::during([&] {
          run(prince_dormand87(f, 0.0, x0)), run(adams(f, 0.0, x0)), run(adams_BM5(f, 0.0, x0, 0.01));
          run(rodas(f, 0.0, x0)), run(tr_bdf2(f, 0.0, x0)), run(bdf(f, 0.0, x0));
          dormand_prince45 swinging(f, 0.0, x0);
          const auto lowest = event([](double, const auto& x) { return x[0]; }).restart();
          integrate(swinging, 100.0, events(lowest).report_to([](const auto&) {}), every(0.01), record);
          run(implicit_midpoint(f, 0.0, x0, 0.01)), run(stormer_verlet(f, 0.0, x0, 0.01));
        }) == 0);
  CHECK(rows > 15000);
}

}  // namespace allocation_test
