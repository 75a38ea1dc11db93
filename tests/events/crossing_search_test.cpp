#include <kte/events/detail/crossing_search.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "catch.hpp"

// What the search for zeros is made of.

namespace crossing_search_test {

using namespace kte::detail;

TEST_CASE("the misfit of a quartic is what any value in between is off by") {
  std::array<double, 9> y{};
  for (int i = 0; i < 9; ++i) {
    const double t = i - 4.0;
    y[static_cast<std::size_t>(i)] = ((t - 1) * t + 2) * t * t - 3 * t + 5;
  }
  CHECK(quartic_misfit(y) == 0);
  for (const std::size_t i : {1u, 3u, 5u, 7u})
    for (const double off : {0.5, -0.5}) {
      auto z = y;
      z[i] += off;
      CHECK(quartic_misfit(z) == 0.5);
    }
}

TEST_CASE("the inner Bernstein coefficients of t and of t^4") {
  CHECK(inner_bernstein(std::array{0.0, 0.25, 0.5, 0.75, 1.0}) == std::array{0.25, 0.5, 0.75});
  CHECK(inner_bernstein(std::array{0.0, 1.0, 16.0, 81.0, 256.0}) == std::array{0.0, 0.0, 0.0});
  CHECK(inner_bernstein(std::array{256.0, 81.0, 16.0, 1.0, 0.0}) == std::array{0.0, 0.0, 0.0});
}

TEST_CASE("a sign change is found within four steps a bit, however f is shaped") {
  constexpr double eps = std::numeric_limits<double>::epsilon(), root = 0.3;
  const auto check = [](const char* name, double size, const auto& f) {
    CAPTURE(name, size);
    int steps = 0;
    const auto counted = [&](double x) {
      if (++steps > 4 * 53) throw std::runtime_error("too many steps");
      return f(x - root);
    };
    const auto forward = find_sign_change(counted, 0.0, f(-root), 1.0, f(1 - root));
    steps = 0;
    const auto backward = find_sign_change([&](double x) { return -counted(x); }, 1.0, -f(1 - root), 0.0, -f(-root));
    for (const auto& x : {forward, backward}) {
      CHECK((x.f_before > 0 && x.f_after <= 0));
      CHECK((std::abs(x.after - x.before) <= 4 * eps * root || x.f_after == 0));
    }
  };
  for (const double size : {1e-200, 1e-9, 1.0, 1e9}) {
    check("jump", size, [&](double x) { return x < 0 ? 1 : -size; });
    check("kink", size, [&](double x) { return x < 0 ? -x : -size * x; });
    check("flat", size, [&](double x) { return -size * std::pow(x, 31); });
    check("steep", size, [&](double x) { return -size * std::cbrt(x); });
    check("exponential", size, [&](double x) { return size * (1 - std::exp(40 * x)); });
  }
}

TEST_CASE("a sign change is found in few steps where interpolation always stalls") {
  // -1 at each power of 0.24, from where it almost touches zero at twice the next one and stays there: each secant ends
  // just before that, so that interpolation goes on in ever tinier steps. It is positive below 1e-30 only: 103 bits,
  // and a tooth of this saw takes 2.06 of them, two bisections and at most one step more.
  constexpr double touch = 0.48, end = 1e-30;
  const auto saw = [](double x) {
    if (x <= end) return 1.0;
    while (x <= touch / 2) x *= 2 / touch;
    return -2 * std::pow(std::max(x - touch, 0.0), 1.01) - 1e-200;
  };
  int steps = 0;
  const auto found = find_sign_change([&](double x) { return ++steps, saw(x); }, 0.0, saw(0), 1.0, saw(1));
  CHECK(found.f_before == 1);
  CHECK(found.f_after < 0);
  CHECK(found.after == within(end, 1e-31));  // 2 eps^2 of the interval
  CHECK(steps < 3 * 50);                     // 133; where three slow steps do not end in a bisection 500
}

TEST_CASE("a smooth sign change is found in few steps") {
  // The digits double or more with each, where no bisection is forced: 8, 8 and 9 steps, or one more by the rounding of
  // the last. Bisection alone takes 53.
  const auto steps_of = [](const auto& f) {
    int steps = 0;
    find_sign_change([&](double x) { return ++steps, f(x); }, 0.0, f(0.0), 1.0, f(1.0));
    return steps;
  };
  CHECK(steps_of([](double x) { return 0.3 - x; }) <= 2);
  CHECK(steps_of([](double x) { return 0.027 - x * x * x; }) <= 9);
  CHECK(steps_of([](double x) { return std::cos(2 * x); }) <= 9);
  CHECK(steps_of([](double x) { return 1 - std::exp(10 * (x - 0.3)); }) <= 10);
}

TEST_CASE("a short flight is seen: what leaves zero and comes back after a time T") {
  // It is above 4/25 T^2 from T/5 to 4/5 T, and times that are tried follow each other by factors of 4.
  for (double T = 0.3; T > 1e-6; T *= 0.77) {
    const auto height = [T](double t) { return t * (T - t); };
    const auto up = depart(height, 0.0, 1.0, 0.159 * T * T);
    CHECK(up.side == 1);
    CHECK(up.time < T);
    const auto backward = depart([&](double t) { return -height(-t); }, 0.0, -1.0, 0.159 * T * T);
    CHECK(backward.side == -1);
    CHECK(backward.time > -T);
  }
  CHECK(depart([](double) { return 0.0; }, 0.0, 1.0, 0.0).side == 0);
}

}  // namespace crossing_search_test
