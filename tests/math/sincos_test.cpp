#include <kte/math/atan2.hpp>

#include <array>
#include <limits>
#include <numbers>
#include <vector>

#include "catch.hpp"
#include "digits50.hpp"
#include "math/draw.hpp"

namespace sincos_test {

using namespace kte;

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double largest = 1e5;  // beyond it libm takes over for the whole call

/// Half a unit in the last place of 1 is 5.6e-17; libm is allowed a little more. The documented error of four at once.
/// Long double, which judges them, has its own rounding where it is no longer than double.
constexpr double libm = 5.8e-17 + static_cast<double>(std::numeric_limits<long double>::epsilon());
constexpr double four_at_once = 2.3e-16 + static_cast<double>(std::numeric_limits<long double>::epsilon());

template <std::size_t N>
auto of(const std::array<double, N>& x) {
  return sincos_all<double, N>([&](std::size_t i) { return x[i]; });
}

double off(double value, long double truth) {
  return static_cast<double>(std::fabs(static_cast<long double>(value) - truth));
}

/// The largest error over all angles, N of them at a time.
template <std::size_t N>
double largest_error(const std::vector<double>& angles) {
  double worst = 0;
  for (std::size_t i = 0; i < angles.size(); i += N) {
    std::array<double, N> x{};
    for (std::size_t j = 0; j < N; ++j) x[j] = angles[(i + j) % angles.size()];
    const auto r = of(x);
    for (std::size_t j = 0; j < N; ++j) {
      const long double t = x[j];
      worst = test::worse(worst, test::worse(off(r.sin[j], std::sin(t)), off(r.cos[j], std::cos(t))));
    }
  }
  return worst;
}

std::vector<double> uniform(double range, int n, std::uint64_t seed) {
  test::draw draw(seed);
  std::vector<double> r;
  for (int i = 0; i < n; ++i) r.push_back(range * draw.number());
  return r;
}

template <class F>
void for_each_size(F f) {
  [&]<std::size_t... i>(std::index_sequence<i...>) { (f.template operator()<i + 1>(), ...); }
  (std::make_index_sequence<9>{});
}

TEST_CASE("sines and cosines are those of long double", "[long]") {
  for (const double range : {0.78, std::numbers::pi, 100.0, largest, 2 * largest, 1e7, 1e300}) {
    const auto angles = uniform(range, 100000, 41);
    for_each_size([&]<std::size_t N>() {
      CAPTURE(range, N);
      // Among angles up to 1e300 hardly one is small enough for four at once.
      const bool by_libm = !sines<double, N>::simd || range > 1e9;
      CHECK(largest_error<N>(angles) <= (by_libm ? libm : four_at_once));
    });
  }
}

TEST_CASE("sines and cosines of multiples of an eighth of a turn") {
  // The hardest angles: the reduced one is next to 0 or to where quadrants change.
  std::vector<double> angles;
  for (int k = -120000; k <= 120000; ++k) {
    const double x = k * (std::numbers::pi / 4);
    for (const double y : {std::nextafter(x, -inf), x, std::nextafter(x, inf)})
      if (std::fabs(y) <= largest) angles.push_back(y);
  }
  CHECK(largest_error<4>(angles) <= four_at_once);
  CHECK(largest_error<7>(angles) <= four_at_once);
}

TEST_CASE("sines next to zero keep their digits") {
  // By (1) the reduced angle has hardly any error there, and the sine (cosine, for odd k) is that angle.
  for (int k = 1; k <= 60000; ++k) {
    const double x = k * (std::numbers::pi / 2);
    const auto r = of<3>({x, -x, x});
    const auto value = k % 2 == 0 ? r.sin[0] : r.cos[0];
    const auto truth = k % 2 == 0 ? std::sin(static_cast<long double>(x)) : std::cos(static_cast<long double>(x));
    REQUIRE(off(value, truth) <= four_at_once * std::fabs(value));
  }
}

TEST_CASE("small sines keep their digits") {
  for (const double x : {1e-300, 1e-20, -1e-8, 1e-4, -1e-3}) {
    const auto r = of<3>({x, -x, x});
    CHECK(off(r.sin[0], std::sin(static_cast<long double>(x))) <= 2.3e-16 * std::fabs(x));
    CHECK(r.sin[1] == -r.sin[0]);
    CHECK(r.cos[1] == r.cos[0]);
  }
}

TEST_CASE("sines and cosines of special angles") {
  for_each_size([]<std::size_t N>() {
    CAPTURE(N);
    std::array<double, N> x;
    for (const double z : {0.0, -0.0}) {
      x.fill(z);
      const auto r = of(x);
      for (std::size_t i = 0; i < N; ++i) CHECK((r.sin[i] == 0.0 && r.cos[i] == 1.0));
    }
    for (const double bad : {not_a_number, inf, -inf}) {
      for (std::size_t at = 0; at < N; ++at) {
        x.fill(0.5);
        x[at] = bad;
        const auto r = of(x);
        for (std::size_t i = 0; i < N; ++i) {
          CHECK(std::isnan(r.sin[i]) == (i == at));
          CHECK(std::isnan(r.cos[i]) == (i == at));
          if (i != at) CHECK((off(r.sin[i], std::sin(0.5L)) <= libm && off(r.cos[i], std::cos(0.5L)) <= libm));
        }
      }
    }
  });
}

TEST_CASE("a sine does not depend on its neighbours") {
  test::draw draw(42);
  std::size_t compared = 0;
  for (int i = 0; i < 20000; ++i) {
    const double x = largest * draw.number();
    const auto alone = of<4>({x, x, x, x});
    for_each_size([&]<std::size_t N>() {
      if constexpr (sines<double, N>::simd) {
        for (std::size_t at = 0; at < N; ++at) {
          std::array<double, N> y;
          for (auto& v : y) v = largest * draw.number();
          y[at] = x;
          const auto r = of(y);
          REQUIRE((r.sin[at] == alone.sin[0] && r.cos[at] == alone.cos[0]));
          ++compared;
        }
      }
    });
  }
  CHECK((compared > 0 || !sines<double, 4>::simd));
}

TEST_CASE("each of n sines is exact, whichever of them is large") {
  for (std::size_t n = 0; n <= 9; ++n) {
    for (std::size_t large = 0; large <= n; ++large) {  // n: none is
      CAPTURE(n, large);
      std::array<double, 10> x, s, c;
      s.fill(7), c.fill(7);
      for (std::size_t i = 0; i < n; ++i) x[i] = i == large ? -1e12 : 0.7 * static_cast<double>(i) - 2;
      sincos_each(x.data(), s.data(), c.data(), n);
      for (std::size_t i = 0; i < n; ++i) {
        const long double t = x[i];
        CHECK((off(s[i], std::sin(t)) <= four_at_once && off(c[i], std::cos(t)) <= four_at_once));
      }
      CHECK((s[n] == 7 && c[n] == 7));
      std::size_t next = 0;
      sincos_each<double>(
          n, [&x](std::size_t i) { return x[i]; },
          [&](std::size_t i, double sine, double cosine) {
            const long double t = x[i];
            CHECK((i == next++ && off(sine, std::sin(t)) <= four_at_once && off(cosine, std::cos(t)) <= four_at_once));
          });
      CHECK(next == n);
    }
  }
}

TEST_CASE("other scalars use their own functions") {
  using kte::test::digits50;
  const auto r = sincos_all<digits50, 4>([](std::size_t i) { return digits50(i) / 3; });
  const auto f = sincos_all<float, 4>([](std::size_t i) { return static_cast<float>(i) / 3; });
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(r.sin[i] == sin(digits50(i) / 3));
    CHECK(r.cos[i] == cos(digits50(i) / 3));
    CHECK(f.sin[i] == std::sin(static_cast<float>(i) / 3));
    CHECK(f.cos[i] == std::cos(static_cast<float>(i) / 3));
  }
}

TEST_CASE("angles of directions: each of n to rounding, signs as in atan2") {
  test::draw draw(43);
  for (int k = 0; k < 20000; ++k) {
    const std::size_t n = static_cast<std::size_t>(k) % 10;
    std::array<double, 10> x, y, t;
    t.fill(7);
    for (std::size_t i = 0; i < n; ++i) {
      x[i] = draw.number() * std::pow(10.0, k % 3 == 0 ? 20 * draw.number() : 0), y[i] = draw.number();
      if (k % 7 == 0) (k % 2 == 0 ? x : y)[i] *= 0;  // along an axis, and at the origin, zeros of both signs
      if (k % 49 == 0) x[i] *= 0, y[i] *= 0;
    }
    atan2_each(y.data(), x.data(), t.data(), n);
    for (std::size_t i = 0; i < n; ++i) {
      CHECK(off(t[i], std::atan2(static_cast<long double>(y[i]), static_cast<long double>(x[i]))) <=
            1.7e-16 + four_at_once);
      CHECK(std::signbit(t[i]) == std::signbit(y[i]));
      CHECK(std::abs(angle_of(y[i], x[i]) - t[i]) <= 4.5e-16);
    }
    CHECK((n == 10 || t[n] == 7));
  }
}

}  // namespace sincos_test
