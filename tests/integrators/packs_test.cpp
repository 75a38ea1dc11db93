#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/euler.hpp>
#include <kte/integrators/prince_dormand87.hpp>
#include <kte/integrators/runge_kutta4.hpp>
#include <kte/integrators/solution.hpp>
#include <kte/math/pack.hpp>

#include "catch.hpp"

namespace packs_test {

using kte::test::says;

using P = kte::pack<double, 8>;
template <class S>
using pair = Eigen::Matrix<S, 2, 1>;

/// A spring that stiffens, different in each lane.
template <class S>
struct duffing {
  S k;
  pair<S> operator()(double t, const pair<S>& x) const {
    return {x[1], -k * x[0] - x[0] * x[0] * x[0] - S(0.1) * x[1] + S(t)};
  }
};
double stiffness(std::size_t i) { return 1 + static_cast<double>(i * i); }
duffing<P> eight() {
  P k;
  for (std::size_t i = 0; i < 8; ++i) k.set(i, stiffness(i));
  return {k};
}
const pair<P> start{P(1.0), P(0.0)};
pair<double> lane(const pair<P>& x, std::size_t i) { return {x[0][i], x[1][i]}; }

/// In a lane that no other one shares: all of them are equal.
duffing<P> alone(std::size_t i) { return {P(stiffness(i))}; }

TEMPLATE_TEST_CASE("fixed steps on packs: a lane is a state integrated alone", "", (kte::euler<duffing<P>, pair<P>>),
                   (kte::runge_kutta4<duffing<P>, pair<P>>)) {
  TestType many(eight(), 0.0, start, 0.01);
  int samples = 0;
  many.integrate(1.005, kte::every(0.1), [&](double, const pair<P>&) { ++samples; });
  CHECK(samples == 12);
  for (std::size_t i = 0; i < 8; ++i) {
    TestType one(alone(i), 0.0, start, 0.01);
    one.integrate(1.005);
    CHECK(lane(many.state(), i) == lane(one.state(), 0));
    CHECK(lane(many.interpolate(1.002), i) == lane(one.interpolate(1.002), 0));
  }
}

TEST_CASE("fixed steps on packs and on numbers are equal, to rounding") {
  kte::runge_kutta4 many(eight(), 0.0, start, 0.01);
  many.integrate(1.0);
  for (std::size_t i = 0; i < 8; ++i) {
    kte::runge_kutta4 one(duffing<double>{stiffness(i)}, 0.0, pair<double>(1, 0), 0.01);
    one.integrate(1.0);
    CHECK((lane(many.state(), i) - one.state()).norm() < 1e-14);
  }
}

TEMPLATE_TEST_CASE("adaptive steps on packs: all lanes are within the tolerances", "",
                   (kte::dormand_prince45<duffing<P>, pair<P>>), (kte::prince_dormand87<duffing<P>, pair<P>>)) {
  const kte::tolerances<double> tight{.absolute = 1e-9, .relative = 1e-9};
  TestType many(eight(), 0.0, start, tight);
  kte::solution path(many);
  many.integrate(2.0, path);
  long long most = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    kte::dormand_prince45 exact(duffing<double>{stiffness(i)}, 0.0, pair<double>(1, 0),
                                {.absolute = 1e-13, .relative = 1e-13});
    exact.integrate(2.0);
    CHECK((lane(many.state(), i) - exact.state()).norm() < 5e-7);
    CHECK((lane(path(2.0), i) - exact.state()).norm() < 5e-7);
    TestType one(alone(i), 0.0, start, tight);
    one.integrate(2.0);
    most = std::max(most, one.statistics().steps);
  }
  CHECK(many.statistics().steps >= most);  // the worst lane rules
  CHECK(many.statistics().steps <= most + most / 4);
}

TEST_CASE("a lane without a number stops a pack, whichever it is") {
  pair<P> bad = start;
  bad[1].set(5, std::numeric_limits<double>::quiet_NaN());
  CHECK_THROWS_MATCHES(kte::runge_kutta4(eight(), 0.0, bad, 0.01), kte::bad_argument,
                       says("start state must be finite, got nan"));
  P k = eight().k;
  k.set(5, -1e300);
  kte::runge_kutta4 solver(duffing<P>{k}, 0.0, start, 0.1);
  CHECK_THROWS_MATCHES(solver.integrate(100.0), kte::integration_failure, says("not a finite number"));
}

}  // namespace packs_test
