#include <kte/events/events.hpp>
#include <kte/integrators/dormand_prince45.hpp>

#include "catch.hpp"
#include "digits50.hpp"

// Events of states and times of every kind.

namespace event_states_test {

using namespace kte;
using kte::test::within_relative;

constexpr double pi = 3.14159265358979323846;

/// A disc that turns at a steady rate: the state is cos, sin and rate; the first two are a rotation.
struct disc {
  using rate = Eigen::Vector2d;
  Eigen::Vector2d operator()(double, const Eigen::Vector3d& x) const { return {x[2], 0}; }
  Eigen::Index rates() const { return 2; }
  void displace(const Eigen::Vector3d& x, const rate& d, Eigen::Vector3d& out) const {
    const double c = std::cos(d[0]), s = std::sin(d[0]);
    out = {x[0] * c - x[1] * s, x[0] * s + x[1] * c, x[2] + d[1]};
  }
  void pull_back(const rate&, rate&) const {}
  void magnitudes(const Eigen::Vector3d& x, rate& m) const { m = {1, x[2]}; }
};

TEST_CASE("events of states with rotations: a disc that strikes turns back") {
  const auto upright = event([](double, const Eigen::Vector3d& x) {
                         return x[0];
                       }).reset([](double, Eigen::Vector3d& x) { x[2] *= -0.5; });
  dormand_prince45 solver(disc{}, 0.0, Eigen::Vector3d(1, 0, 1));
  const auto report = integrate(solver, 50.0, events(upright));
  double t = pi / 2, w = 1;
  REQUIRE(report.count == 4);  // at 90, -90, ... degrees, ever slower
  for (const auto& e : report.events) {
    CHECK(e.time == within_relative(t, 1e-14));
    CHECK(e.before.head<2>().norm() == within_relative(1, 1e-15));
    w /= 2;
    t += pi / w;
  }
}

TEST_CASE("events in every scalar, and of dynamic states") {
  const auto check = [](auto one, double accuracy) {
    using S = decltype(one);
    using state = Eigen::Matrix<S, 2, 1>;
    const auto g = [](const S&, const state& x) { return S(x[0]); };
    const auto f = [](const S&, const state& x) { return state(x[1], S(-10)); };
    const auto back = [](const S&, state& x) { x[1] = -x[1] / 2; };
    dormand_prince45 solver(f, S(0), state(S(5), S(0)));
    const auto report = integrate(solver, S(2.75), events(event(g).reset(back)));
    REQUIRE(report.count >= 3);
    CHECK(std::abs(static_cast<double>(report.events[0].time - 1)) < accuracy);
    CHECK(std::abs(static_cast<double>(report.events[1].time - 2)) < accuracy);
    CHECK(std::abs(static_cast<double>(report.events[2].time - S(2.5))) < 3 * accuracy);
  };
  check(1.0f, 1e-6);
  check(1.0, 3e-15);
  check(1.0l, 2e-18);
  check(kte::test::digits50(1), 1e-47);

  const auto f = [](double, const Eigen::VectorXd& x) -> Eigen::VectorXd { return Eigen::VectorXd::Ones(x.size()); };
  dormand_prince45 solver(f, 0.0, Eigen::VectorXd(Eigen::VectorXd::Zero(5)));
  const auto report = integrate(solver, 3.0, events(event([](double, const auto& x) { return x[4] - 1.25; })));
  CHECK(report.events.at(0).time == within_relative(1.25, 1e-15));
}

TEST_CASE("late times are resolved to their ulp") {
  const auto f = [](double, const Eigen::Vector2d&) { return Eigen::Vector2d(1, 0); };
  dormand_prince45 solver(f, 1e9, Eigen::Vector2d(-0.7, 0));
  const auto report = integrate(solver, 1e9 + 1, events(event([](double, const Eigen::Vector2d& x) { return x[0]; })));
  CHECK(report.events.at(0).time == within_relative(1e9 + 0.7, 4e-16));
}

}  // namespace event_states_test
