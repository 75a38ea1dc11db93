#include <kte/math/atan2.hpp>

#include <limits>
#include <numbers>
#include <vector>

#include "catch.hpp"
#include "digits50.hpp"
#include "math/packs.hpp"
#include "random.hpp"

// Sines and cosines of packs against those of more digits.

namespace pack_sincos_test {

using namespace kte;
using namespace kte::test;

template <class T>
double off(T value, const digits50& truth) {
  return static_cast<double>(abs(digits50(value) - truth));
}

/// Documented. The roundings: of r, r eps/2 with r < pi/4; of the last sum, half a unit in the last place of 1; of what
/// is added to r there, below r^3/6 = 0.08; for large angles, of the terms of the reduction.
template <class T>
constexpr double documented = std::is_same_v<T, double> ? 2.3e-16 : 1e-7;

template <class P>
double largest_error(const std::vector<typename P::value_type>& angles) {
  double worst = 0;
  constexpr auto n = static_cast<std::size_t>(P::lanes);
  for (std::size_t k = 0; k + n <= angles.size(); k += n) {
    P s, c;
    kte::sincos(P::load(angles.data() + k), s, c);
    for (std::size_t i = 0; i < n; ++i) {
      // Long double has 11 bits more than double; where it has not, 50 digits judge.
      if constexpr (std::numeric_limits<long double>::digits > 53) {
        const auto x = static_cast<long double>(angles[k + i]);
        for (const long double d : {s[i] - std::sin(x), c[i] - std::cos(x)})
          worst = test::worse(worst, static_cast<double>(std::fabs(d)));
      } else {
        const digits50 x = angles[k + i];
        worst = test::worse(worst, test::worse(off(s[i], sin(x)), off(c[i], cos(x))));
      }
    }
  }
  return worst;
}

TEST_CASE("packs: sines and cosines") {
  for_all_packs([]<class P>() {
    using T = typename P::value_type;
    CAPTURE(P::lanes, sizeof(T));
    random_numbers random(67);
    for (const double range : {0.78, std::numbers::pi, 100.0, 8190.0, 1e5, 1e9}) {
      CAPTURE(range);
      std::vector<T> angles;
      for (int i = 0; i < 20000; ++i) angles.push_back(static_cast<T>(random(range)));
      CHECK(largest_error<P>(angles) <= documented<T>);
    }
    // Next to multiples of an eighth of a turn: the reduced angle is next to 0, or to where quadrants change.
    std::vector<T> hard;
    for (int k = -5200; k < 5200; ++k) {
      const auto x = static_cast<T>(k * (std::numbers::pi / 4));
      for (const T y : {std::nextafter(x, T(-1e30)), x, std::nextafter(x, T(1e30))}) hard.push_back(y);
    }
    hard.resize(hard.size() / 16 * 16);
    CHECK(largest_error<P>(hard) <= documented<T>);
  });
}

TEST_CASE("packs: small sines keep their digits") {
  for_all_packs([]<class P>() {
    using T = typename P::value_type;
    for (const double angle : {1e-30, 1e-20, -1e-8, 1e-4, -1e-3}) {
      const auto x = static_cast<T>(angle);
      const double truth = std::sin(static_cast<double>(x));
      CHECK(std::fabs(static_cast<double>(sin(P(x))[0]) - truth) <= documented<T> * std::fabs(truth));
      CHECK(sin(P(-x))[0] == -sin(P(x))[0]);
      CHECK(cos(P(-x))[0] == cos(P(x))[0]);
    }
    CHECK(sin(P(0))[0] == 0);
    CHECK(cos(P(0))[0] == 1);
  });
}

TEST_CASE("packs: a sine does not depend on the other lanes") {
  for_all_packs([]<class P>() {
    using T = typename P::value_type;
    constexpr T inf = std::numeric_limits<T>::infinity(), nan = std::numeric_limits<T>::quiet_NaN();
    random_numbers random(68);
    for (int round = 0; round < 200; ++round) {
      const auto x = static_cast<T>(random(round % 2 ? 8000 : 2e5));
      P s, c, s1, c1;
      kte::sincos(P(x), s, c);
      for (std::size_t at = 0; at < std::size_t{P::lanes}; ++at) {
        P mixed = random_pack<P>(random, 9000);
        for (std::size_t i = 0; i < std::size_t{P::lanes}; i += 3)
          mixed.set(i, std::array<T, 4>{inf, nan, T(-1e6), -inf}[(i + at) % 4]);
        mixed.set(at, x);
        kte::sincos(mixed, s1, c1);
        REQUIRE(same(s1[at], s[at]));
        REQUIRE(same(c1[at], c[at]));
        for (std::size_t i = 0; i < std::size_t{P::lanes}; ++i) {
          REQUIRE(std::isnan(s1[i]) == !std::isfinite(mixed[i]));
          REQUIRE(std::isnan(c1[i]) == !std::isfinite(mixed[i]));
        }
      }
    }
  });
}

TEST_CASE("packs: sines of a chain") {
  for_all_packs([]<class P>() {
    random_numbers random(69);
    const std::array<P, 3> x{random_pack<P>(random, 3), random_pack<P>(random, 3), random_pack<P>(random, 3)};
    const auto r = sincos_all<P, 3>([&](std::size_t i) { return x[i]; });
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(all(r.sin[i] == sin(x[i])));
      CHECK(all(r.cos[i] == cos(x[i])));
    }
  });
}

TEST_CASE("angles of directions and arc sines of packs are those of their lanes") {
  using four = pack<double, 4>;
  random_numbers random(21);
  for (int k = 0; k < 1000; ++k) {
    four x, y, t;
    for (std::size_t i = 0; i < 4; ++i) x.set(i, random()), y.set(i, random());
    if (k % 4 == 0) y.set(1, 0.0);
    atan2_each(&y, &x, &t, 1);
    const four angle = atan2(y, x), arc = asin(x);
    for (std::size_t i = 0; i < 4; ++i) {
      CHECK(std::fabs(t[i] - std::atan2(y[i], x[i])) <= 6e-16);  // 4e-16, and half an ulp of pi
      CHECK(angle[i] == std::atan2(y[i], x[i]));
      CHECK(arc[i] == std::asin(x[i]));
    }
  }
}

}  // namespace pack_sincos_test
