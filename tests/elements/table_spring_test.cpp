#include <kte/elements/table_spring.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/models/manipulator_dynamics_model.hpp>
#include <kte/runtime_chain/from_record.hpp>
#include <kte/static.hpp>

#include <numbers>

#include "catch.hpp"
#include "chain/registered.hpp"
#include "elements/laws.hpp"

namespace table_spring_test {

using namespace kte;
using namespace kte::test;

constexpr std::array lengths{-3.0, -1.0, 0.5, 1.0, 4.0}, pulls{-9.0, -4.0, 1.0, 1.0, 25.0};
const auto cubed = [](const auto& x) { return x * x * x; };
const auto energy_of_cubed = [](const auto& x) { return x * x * x * x / 4; };

template <class S>
void check_laws() {
  random_numbers draw(1);
  const auto check = [&](const auto& spring) {
    CHECK(testing::loads_are_opposite<S>(spring, draw) <= rounding<S>);
    CHECK(testing::force_is_gradient<S>(spring, draw, energy_of(spring)) <= 100 * by_differences<S>);
  };
  check(law_spring_gen("a", "b", cubed, energy_of_cubed));
  check(law_spring_2D("a", "b", cubed, energy_of_cubed));
  check(law_spring_3D("a", "b", cubed, energy_of_cubed));
  check(table_spring_3D("a", "b", std::array{0.0, 10.0}, std::array{-2.0, 3.0}));
  // Across the points of a table second derivatives jump, and differences err by a power of their step.
  const auto table = table_spring_gen("a", "b", lengths, pulls);
  CHECK(testing::force_is_gradient<S>(table, draw, energy_of(table)) <= 100 * pow(eps<S>, S(1) / S(3)));
}
template <class Spring>
double pull(const Spring& spring, double x) {
  auto e = trial_of(spring, 1);
  e.template at<0>() = {.q = 1}, e.template at<1>() = {.q = 1 + x};
  e.doForce();
  CHECK(e.template at<1>().f == -e.template at<0>().f);
  return e.template at<0>().f;
}

TEST_CASE("springs by laws and tables obey the laws") { check_laws<double>(), check_laws<digits50>(); }

TEST_CASE("a table goes through its points, monotone and smooth, and straight beyond them") {
  const monotone_cubic curve(lengths, pulls);
  for (std::size_t i = 0; i < 5; ++i) CHECK(curve(lengths[i]) == within(pulls[i], 1e-14));
  CHECK(curve(-5.0) == within(-9 - 2 * 2.5, 1e-14));
  CHECK(curve(6.0) == within(25 + 2 * 8, 1e-14));
  for (const double x : {0.5, 0.6, 0.9, 1.0}) CHECK(curve(x) == 1.0);  // where forces stay, so does the curve
  double before = curve(-4.0);
  for (double x = -4; x < 5; x += 0.01) {
    CHECK(curve(x) >= before - 1e-14);
    before = curve(x);
  }
  using number = dual<double, 1>;
  const auto slope = [&](double x) {
    number at(x);
    at.derivative[0] = 1;
    CHECK(curve.integral(at).derivative[0] == within(curve(x), 1e-13));
    return curve(at).derivative[0];
  };
  for (const double x : lengths) CHECK(slope(x - 1e-9) == within(double(slope(x + 1e-9)), 1e-7));
  // At -1, by (1): rises of 5/2 over 2 and 10/3 over 3/2.
  CHECK(slope(-1.0) == within(3 * 3.5 / ((3 + 2) / 2.5 + (1.5 + 4) / (10.0 / 3)), 1e-14));
  CHECK(curve.integral(-3.0) == 0.0);
  CHECK(std::isnan(curve(not_a_number)));
}

TEST_CASE("springs of any law pull as it says") {
  CHECK(pull(law_spring_gen("a", "b", cubed), 2.0) == 8.0);
  CHECK(pull(table_spring_gen("a", "b", lengths, pulls), 4.0) == 25.0);
  const std::vector<double> x{0, 1}, y{0, 5};
  CHECK(pull(table_spring_gen("a", "b", x, y), 0.5) == 2.5);
  auto e = trial_of(law_spring_2D("a", "b", cubed), 1);
  e.at<0>() = {}, e.at<1>() = {.position = {0, 2}};
  e.doForce();
  CHECK(e.at<0>().force == vec2{0.0, 8.0});
}

TEST_CASE("Duffing's oscillator keeps its period") {
  // x'' = -x^3 from x = A: T = 4 K(1/sqrt 2)/A with K = Gamma(1/4)^2 / (4 sqrt pi).
  static constexpr struct q_ final : coord_key<"q"> {
  } q;
  static constexpr struct wall_ final : coord_key<"wall"> {
  } wall;
  constexpr double A = 2;
  const auto c = chain(base_gen(wall), inertia_gen(q, 1.0), law_spring_gen(wall, q, cubed, energy_of_cubed));
  const manipulator_dynamics_model model(c);
  dormand_prince45 solver(std::cref(model), 0.0, model.make_x(std::array{A}, std::array{0.0}),
                          {.absolute = 1e-12, .relative = 1e-12});
  const double gamma = std::tgamma(0.25), K = gamma * gamma / (4 * std::sqrt(std::numbers::pi));
  solver.integrate(4 * K / A);
  CHECK(solver.state()[0] == within(A, 1e-9));
  CHECK(solver.state()[1] == within(0, 1e-8));
  CHECK(potential_energy(c, std::array{2.0}) == 4.0);
}

TEST_CASE("tables are saved and loaded, functions are refused") {
  runtime_chain c;
  c << base_gen("wall") << inertia_gen("q", 1.0) << table_spring_gen("wall", "q", lengths, pulls) << base_3D("a")
    << base_3D("b") << table_spring_3D("a", "b", std::vector{0.0, 1.0}, std::vector{0.0, 5.0});
  const auto r = record_of(c);
  CHECK(r.elements[2].parameters[0].values == std::vector(lengths.begin(), lengths.end()));
  CHECK(record_of(models::registered(r)) == r);
  static constexpr struct q_ final : coord_key<"q"> {
  } q;
  static constexpr struct wall_ final : coord_key<"wall"> {
  } wall;
  constexpr auto fixed = chain(base_gen(wall), inertia_gen(q, 1.0), table_spring_gen(wall, q, lengths, pulls));
  auto other = record_of(fixed);
  other.elements[2].parameters[1].values = {0, 0, 0, 0, 3};
  CHECK(potential_energy(from_record(fixed, other), std::array{1.0}) ==
        0.0);  // what is derived from a table follows it
  other.elements[2].parameters[1].values = {0, 0, 0, 0};
  CHECK_THROWS_MATCHES(from_record(fixed, other), bad_file, says("too few numbers"));
  c << law_spring_gen("wall", "q", cubed);
  CHECK_THROWS_MATCHES(
      record_of(c), bad_argument,
      says("kte: law_spring_gen (anchor1 'wall', anchor2 'q') holds a function of its program, which no "
           "record or file can hold"));
}

TEST_CASE("tables reject invalid input") {
  using list = std::vector<double>;
  const auto what = [](const list& x, const list& y) {
    return complaint([&] { (void)table_spring_gen("a", "b", x, y); });
  };
  const std::string where = "kte: table_spring_gen (anchor1 'a', anchor2 'b'): ";
  CHECK(what({0, 1}, {0, 1, 2}) == where + "there must be as many forces as lengths, at least two, got 3");
  CHECK(what({0}, {0}) == where + "there must be as many forces as lengths, at least two, got 1");
  CHECK(what({0, 2, 2}, {0, 1, 2}) == where + "lengths must increase, got 2");
  CHECK(what({0, infinity}, {0, 1}) == where + "lengths must be finite, got inf");
  CHECK(what({0, 1}, {0, not_a_number}).starts_with(where + "forces must be finite"));
}

}  // namespace table_spring_test
