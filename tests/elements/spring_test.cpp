#include <kte/elements/spring.hpp>

#include "catch.hpp"
#include "elements/laws.hpp"

namespace spring_test {

using namespace kte;
using namespace kte::test;

template <class S>
void check_laws() {
  random_numbers draw(1);
  const S k = S(50) / 3, rest = S(1) / 7, most = S(5);
  const auto stretch = [&](const auto& a, const auto& b) { return S(b.q - a.q - rest); };
  const auto spring = spring_gen("a", "b", rest, k);
  CHECK(testing::loads_are_opposite<S>(spring, draw) == 0);
  // The force grows with k: so does its error.
  CHECK(testing::force_is_gradient<S>(spring, draw, [&](const auto& a, const auto& b) {
          const S e = stretch(a, b);
          return S(k / 2 * e * e);
        }) <= k * by_differences<S>);
  CHECK(testing::force_is_gradient<S>(spring, draw, energy_of(spring)) <= k * by_differences<S>);
  const auto limited = spring_gen("a", "b", rest, k, most);
  CHECK(testing::loads_are_opposite<S>(limited, draw) == 0);
  if constexpr (!std::is_same_v<S, double>) {  // by differences in double some tries would reach across the kink
    CHECK(testing::force_is_gradient<S>(limited, draw, energy_of(limited)) <= k * by_differences<S>);
    CHECK(testing::force_is_gradient<S>(limited, draw, [&](const auto& a, const auto& b) {
            const S e = stretch(a, b), size = e < 0 ? S(-e) : e, kink = most / k;
            return size < kink ? S(k / 2 * e * e) : S(most * (size - kink / 2));
          }) <= k * by_differences<S>);
  }
}

/// The force of a spring on its first anchor, which stands at 0, with the second at q.
template <class Element>
double pull(const Element& e, double q) {
  auto x = trial_of(e, 1);
  x.template at<0>() = {.q = 0.0};
  x.template at<1>() = {.q = q};
  x.doForce();
  if (!std::isnan(q)) CHECK(x.template at<1>().f == -x.template at<0>().f);
  return x.template at<0>().f;
}

TEST_CASE("springs obey the laws") {
  check_laws<double>();
  check_laws<digits50>();
}

TEST_CASE("a spring has no jump where its anchors cross") {
  const auto spring = spring_gen("a", "b", 0.25, 8.0);
  for (int i = -32; i <= 32; ++i) CHECK(pull(spring, i / 16.0) == 8.0 * (i / 16.0 - 0.25));
  CHECK(pull(spring, 0.0) == -2.0);
  CHECK(pull(spring, 1e-300) == -2.0);
  CHECK(pull(spring, -1e-300) == -2.0);
}

TEST_CASE("a spring saturates") {
  const auto spring = spring_gen("a", "b", 0.25, 8.0, 3.0);
  CHECK(pull(spring, 0.5) == 2.0);
  CHECK(pull(spring, 0.625) == 3.0);
  CHECK(pull(spring, 7.0) == 3.0);
  CHECK(pull(spring, infinity) == 3.0);
  CHECK(pull(spring, -0.125) == -3.0);
  CHECK(pull(spring, -7.0) == -3.0);
  CHECK(pull(spring, -infinity) == -3.0);
  CHECK(pull(spring_gen("a", "b", 0.25, 8.0, 0.0), 100.0) == 798.0);  // no saturation
}

TEST_CASE("a spring holds energy, beyond saturation as the work of its force") {
  const auto energy = [](const auto& spring, double q) {
    return energy_of(spring)(gen_coord<>{.q = 0.0}, gen_coord<>{.q = q});
  };
  const auto spring = spring_gen("a", "b", 0.25, 8.0);
  const auto limited = spring_gen("a", "b", 0.25, 8.0, 3.0);
  CHECK(energy(spring, 0.75) == 1.0);
  CHECK(energy(spring, -0.25) == 1.0);
  CHECK(energy(limited, 0.5) == 0.25);
  CHECK(energy(limited, 0.625) == 0.5625);              // where it saturates
  CHECK(energy(limited, 2.625) == 0.5625 + 3.0 * 2.0);  // 2 m further
  CHECK(energy(limited, -2.125) == 0.5625 + 3.0 * 2.0);
  CHECK(energy(spring_gen("a", "b", 0.25, 8.0, 0.0), 10.25) == 400.0);  // no saturation
  CHECK(energy(spring_gen("a", "b", 0.25, 0.0, 3.0), 10.25) == 0.0);
  CHECK(energy(spring_gen("a", "b", zero, zero, 3.0), 10.25) == 0.0);
  CHECK(std::isnan(energy(limited, not_a_number)));
}

TEST_CASE("a spring with typed constants is limited too") {
  CHECK(pull(spring_gen("a", "b", zero, 8.0, one), 7.0) == 1.0);
  const auto core = spring_gen("a", "b", one, one, 0.5).core;
  const coordinate rest{zero, zero, zero, one, zero};
  CHECK(nth<0>(core.doForce(rest, rest)) == -0.5);
  CHECK(core.potential_energy(rest, rest) == 0.375);  // 0.5 N along 1 m, but for the first half
}

TEST_CASE("a spring keeps NaN") {
  CHECK(std::isnan(pull(spring_gen("a", "b", 0.25, 8.0), not_a_number)));
  CHECK(std::isnan(pull(spring_gen("a", "b", 0.25, 8.0, 3.0), not_a_number)));
}

TEST_CASE("a spring wants finite numbers, and none negative") {
  const std::string where = "kte: spring_gen (anchor1 'wall', anchor2 'cart'): ";
  const auto what = [](auto... numbers) { return complaint([&] { (void)spring_gen("wall", "cart", numbers...); }); };
  CHECK(what(not_a_number, 1.0) == where + "rest length must be finite, got nan");
  CHECK(what(infinity, 1.0) == where + "rest length must be finite, got inf");
  CHECK(what(0.1, -2.0) == where + "stiffness must be finite and not negative, got -2");
  CHECK(what(0.1, not_a_number) == where + "stiffness must be finite and not negative, got nan");
  CHECK(what(0.1, infinity) == where + "stiffness must be finite and not negative, got inf");
  CHECK(what(0.1, 1.0, -3.0) == where + "saturation must be finite and not negative, got -3");
  CHECK(what(0.1, 1.0, not_a_number) == where + "saturation must be finite and not negative, got nan");
  CHECK(what(-0.1, 0.0, 0.0) == "");
  CHECK(what(zero, 1) == "");
}

}  // namespace spring_test
