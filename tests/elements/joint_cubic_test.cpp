#include <kte/dynamics/derivatives.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/models/manipulator_dynamics_model.hpp>
#include <kte/static.hpp>
#include <kte/testing/file_round_trip.hpp>
#include <kte/testing/static_is_runtime.hpp>

#include <cmath>

#include "catch.hpp"
#include "chain/registered.hpp"
#include "elements/laws.hpp"

namespace joint_cubic_test {

using namespace kte;
using namespace kte::test;

// clang-format off
inline constexpr struct q_ final : coord_key<"q"> {} q;
// clang-format on

const auto spring = joint_cubic_stiffness_gen("q", {1.0, 2.0, 3.0, 0.25});
const auto damper = joint_cubic_damping_gen("q", {1.0, 2.0, 3.0});

template <class S, class Element>
S force(const Element& e, const S& x, const S& v) {
  auto t = trial_of<S>(e, 1);
  t.template at<0>() = {.q = x, .q_dot = v};
  t.doForce();
  return t.template at<0>().f;
}

TEST_CASE("springs and dampers of cubic laws are as their formulas say") {
  random_numbers draw(1);
  CHECK(force(spring, 0.75, 0.0) == -(0.5 + 2 * 0.25 + 3 * 0.125));
  CHECK(force(spring, -0.25, 0.0) == -(-0.5 + 2 * 0.25 - 3 * 0.125));
  CHECK(force(damper, 0.0, 2.0) == -(2 + 2 * 4 + 3 * 8));
  CHECK(force(damper, 0.0, -2.0) == 2 + 2 * 4 + 3 * 8);
  CHECK(force(damper, 0.0, 0.0) == 0);
  CHECK((std::isnan(force(spring, not_a_number, 0.0)) && std::isnan(force(damper, 0.0, not_a_number))));
  for (int i = 0; i < 20; ++i) {
    const digits50 v = draw(3.0), x = v - 0.25;
    CHECK(abs(force<digits50>(damper, 0, v) + v + 2 * abs(v) * v + 3 * v * v * v) <= 1e3 * eps<digits50>);
    CHECK(abs(force<digits50>(spring, v, 0) + x + 2 * x * x + 3 * x * x * x) <= 1e3 * eps<digits50>);
  }
  CHECK(testing::no_work_done<double>(damper, draw) == 0);
  CHECK(testing::force_is_gradient<double>(
            spring, draw, [](const auto& c) { return spring.core.potential_energy(c); }) < by_differences<double>);
  CHECK(testing::static_is_runtime(spring, draw) < rounding<double>);
  CHECK(testing::static_is_runtime(damper, draw) < rounding<double>);
  CHECK(testing::file_round_trip(spring, element_registry::standard(), draw) == 0);
  CHECK(testing::file_round_trip(damper, element_registry::standard(), draw) == 0);
}

TEST_CASE("the derivatives of cubic laws are exact, at rest too") {
  constexpr auto c = chain(inertia_gen(q, 2.0), joint_cubic_stiffness_gen(q, {1.0, 2.0, 3.0, 0.25}),
                           joint_cubic_damping_gen(q, {4.0, 5.0, 6.0}));
  const auto at = [&](double x, double v) {
    const auto d = inverse_dynamics_derivatives(c, std::array{x}, std::array{v}, std::array{0.0});
    return std::pair{double(d.by_q(0, 0)), double(d.by_v(0, 0))};
  };
  CHECK(at(0.25, 0) == std::pair{1.0, 4.0});
  CHECK(at(1.25, 2) == std::pair{1.0 + 4 + 9, 4.0 + 2 * 5 * 2 + 3 * 6 * 4});
  CHECK(at(-0.75, -2) == std::pair{1.0 - 4 + 9, 4.0 + 2 * 5 * 2 + 3 * 6 * 4});
  CHECK(potential_energy(c, std::array{1.25}) == within(0.5 + 2.0 / 3 + 0.75, 1e-15));
}

TEST_CASE("a mass with a damper of one power slows down as its closed form says") {
  constexpr double m = 2, v_0 = 3, t = 1.5;
  const auto rate = [&](double quadratic, double cubic) {
    const auto c = chain(inertia_gen(q, m), joint_cubic_damping_gen(q, {0.0, quadratic, cubic}));
    const manipulator_dynamics_model model(c);
    dormand_prince45 solver(std::cref(model), 0.0, model.make_x(std::array{0.0}, std::array{v_0}),
                            {.absolute = 1e-12, .relative = 1e-12});
    solver.integrate(t);
    return solver.state()[1];
  };
  CHECK(rate(0.5, 0) == within(v_0 / (1 + 0.5 * v_0 * t / m), 1e-10));
  CHECK(rate(0, 0.5) == within(v_0 / std::sqrt(1 + 2 * 0.5 * v_0 * v_0 * t / m), 1e-10));
}

TEST_CASE("cubic laws reject invalid input") {
  const std::string k = "kte: joint_cubic_stiffness_gen (coordinate 'q'): ",
                    d = "kte: joint_cubic_damping_gen (coordinate 'q'): ";
  CHECK(complaint([] {
          (void)joint_cubic_stiffness_gen("q", {infinity, 0, 0});
        }) == k + "stiffness must be finite, got inf");
  CHECK(complaint([] {
          (void)joint_cubic_stiffness_gen("q", {1, infinity, 0});
        }) == k + "quadratic must be finite, got inf");
  CHECK(complaint([] {
          (void)joint_cubic_stiffness_gen("q", {1, 0, infinity});
        }) == k + "cubic must be finite, got inf");
  CHECK(complaint([] {
          (void)joint_cubic_stiffness_gen("q", {1, 0, 0, infinity});
        }) == k + "rest must be finite, got inf");
  CHECK(complaint([] {
          (void)joint_cubic_damping_gen("q", {infinity, 0, 0});
        }) == d + "damping must be finite, got inf");
  CHECK(complaint([] {
          (void)joint_cubic_damping_gen("q", {0, infinity, 0});
        }) == d + "quadratic must be finite, got inf");
  CHECK(complaint([] { (void)joint_cubic_damping_gen("q", {0, 0, infinity}); }) == d + "cubic must be finite, got inf");
}

}  // namespace joint_cubic_test
