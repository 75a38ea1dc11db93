#include "catch.hpp"
#include "data/problems/andrews.hpp"
#include "data/problems/elastic_pendulum.hpp"
#include "data/problems/euler_top.hpp"
#include "data/problems/hires.hpp"
#include "data/problems/kapitza.hpp"
#include "data/problems/pleiades.hpp"
#include "integrators/mechanism_error.hpp"

namespace problems_test {

// The problems of data/problems that are plain equations against their references.
//
// With the tolerance 1e-12 a step errs by less than 1e-12 (1 + |x|), and such a disturbance grows until the end by G at
// most, as measured by disturbing states on the way: after n steps the error is below n G 1e-12. In truth errors cancel
// in part, and grow little where most steps are. Bounds are three to six times the measured error and below that limit;
// in brackets n, G and the error. Rounding is 1e-16 a step, a part of 1e-4 of all that.

using namespace kte;
using namespace kte::problems;

template <class Problem>
auto output(const typename Problem::state& x) {
  if constexpr (requires { Problem::output(x); }) {
    return Problem::output(x);
  } else {
    return x;
  }
}
/// The largest error at the last reference, and that energies stay to `drift`.
template <class Problem>
double error_of(double drift = 0) {
  const Problem f;
  auto solver = test::solver_of<Problem>();
  double most = 0;
  for (const auto& r : Problem::references) {
    solver.integrate(static_cast<double>(r.time));
    const typename Problem::state x = solver.state();
    most = std::max(most, static_cast<double>(largest_error(output<Problem>(x), r.values)));
    if constexpr (requires { f.energy(f.start()); }) CHECK(f.energy(x) == within(f.energy(f.start()), drift));
  }
  return most;
}

TEST_CASE("plain problems reach their references with the order 5 that the library has", "[long]") {
  CHECK(error_of<pleiades<>>(1e-8) < 1e-9);           // [2400, 3e3, 1.6e-10]
  CHECK(error_of<kapitza<>>() < 2e-10);               // [8e4, 2e1, 3.5e-11]
  CHECK(error_of<elastic_pendulum<>>(2e-9) < 3e-10);  // [5700, 2e2, 5.6e-11]
  CHECK(error_of<euler_top<>>(2e-11) < 5e-10);        // [4200, 1e2, 1.2e-10]
  CHECK(error_of<andrews<>>(1e-11) < 2e-9);           // [920, 7e3, 3.3e-10]
  CHECK(error_of<hires<>>() < 1e-12);                 // [1.3e4, 6e1, 2.6e-13]: G at the start, then errors decay
}

TEST_CASE("PLEIADES in more digits", "[long]") {
  const pleiades<long double> f;
  dormand_prince45 solver(f, 0.0L, f.start(), {.absolute = 1e-15L, .relative = 1e-15L});
  solver.integrate(f.t_end);
  CHECK(largest_error(solver.state(), f.reference) < 1e-12L);  // a thousandth
}

TEST_CASE("constants of the motion have the values that are known") {
  CHECK(std::fabs(elastic_pendulum<long double>{}.energy(elastic_pendulum<long double>::start()) - 2) < 1e-18L);
  CHECK(euler_top<>{}.energy(euler_top<>::start()) == within_relative(0.647125279313836427131, 1e-15));
  const long double balance = andrews<long double>{}.energy(andrews<long double>::start());
  CHECK(std::fabs(balance - 1.437832957532139872622884772823L) < 1e-17L);
  // Its first acceleration, known to 30 digits from the equations with multipliers.
  const auto first = andrews<long double>{}(0.0L, andrews<long double>::start())[1];
  CHECK(std::fabs(first / 14222.4439199541138705911625887L - 1) < 1e-15L);
  auto top = test::solver_of<euler_top<>>();
  top.integrate(100);
  CHECK((euler_top<>::momentum(euler_top<>::state(top.state())) - euler_top<>::momentum(euler_top<>::start())).norm() <
        5e-10);
}

TEST_CASE("errors and digits of a solution") {
  const double x[]{1.0, 2.002, -3.0};
  const long double r[]{1.0L, 2.0L, -3.03L};
  CHECK(static_cast<double>(largest_error(x, r)) == within_relative(0.03, 2.3e-16));
  CHECK(scd(x, r) == within(-std::log10(0.03 / 3.03), 1e-15));
  CHECK(scd(r, r) == HUGE_VAL);
  const double nan[]{1.0, NAN, -3.03};
  CHECK(largest_error(nan, r) == HUGE_VALL);
  CHECK(scd(nan, r) == -HUGE_VAL);
}

}  // namespace problems_test
