#include <kte/math/matrix.hpp>
#include <kte/math/pack.hpp>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <array>
#include <concepts>
#include <limits>
#include <numbers>
#include <vector>

#include "catch.hpp"
#include "random.hpp"

// Everything lane by lane against the same with plain numbers.

using namespace kte;

namespace {

static_assert(variable<pack<double, 8>> && entry<pack<float, 4>> && !geometric<pack<double, 2>>);
static_assert(std::is_convertible_v<double, pack<float, 8>> && std::is_convertible_v<int, pack<double, 4>>);
static_assert(std::is_trivially_default_constructible_v<pack<double, 8>> && sizeof(pack<float, 16>) == 64);
static_assert(std::same_as<decltype(2.0 * pack<float, 16>()), pack<float, 16>>);
static_assert(std::same_as<decltype(pack<double, 4>() < 1), pack_mask<double, 4>>);
static_assert(std::numeric_limits<pack<float, 8>>::digits == 24 && std::numeric_limits<pack<double, 8>>::is_iec559);
static_assert(!Eigen::NumTraits<pack<double, 8>>::RequireInitialization);

template <class F>
void for_all_packs(const F& f) {
  const auto sizes = [&]<class T>(T) {
    f.template operator()<pack<T, 1>>();
    f.template operator()<pack<T, 2>>();
    f.template operator()<pack<T, 4>>();
    f.template operator()<pack<T, 8>>();
    f.template operator()<pack<T, 16>>();
  };
  sizes(float{});
  sizes(double{});
}

template <class P>
using lanes_of = std::array<typename P::value_type, static_cast<std::size_t>(P::lanes)>;

template <class P>
P random_pack(random_numbers& random, double size) {
  lanes_of<P> x;
  for (auto& lane : x) lane = static_cast<typename P::value_type>(random(size));
  return P::load(x.data());
}

/// The same bits; NaN is the same as NaN.
template <class T>
bool same(T a, T b) {
  return std::isnan(a) ? std::isnan(b) : a == b && std::signbit(a) == std::signbit(b);
}
template <class P, class F>
bool each(const P& result, const F& of_lane) {
  for (std::size_t i = 0; i < std::size_t{P::lanes}; ++i)
    if (!same<typename P::value_type>(result[i], of_lane(i))) return false;
  return true;
}
template <class P, class F>
bool each_truth(const typename P::mask& result, const F& of_lane) {
  const P ones = select(result, P(1), P(0));
  for (std::size_t i = 0; i < std::size_t{P::lanes}; ++i)
    if ((ones[i] == 1) != of_lane(i)) return false;
  return true;
}

/// Random numbers, and all that is special among them.
template <class P>
std::vector<P> operands(unsigned seed) {
  using T = typename P::value_type;
  using limits = std::numeric_limits<T>;
  random_numbers random(seed);
  std::vector<P> r;
  for (int i = 0; i < 20; ++i) r.push_back(random_pack<P>(random, 3));
  const std::array<T, 8> special{
      T(0), T(-0.0), T(1), limits::infinity(), -limits::infinity(), limits::min(), limits::quiet_NaN(), limits::max()};
  for (std::size_t shift = 0; shift < special.size(); ++shift) {
    P p(0);
    for (std::size_t i = 0; i < std::size_t{P::lanes}; ++i) p.set(i, special[(i + shift) % special.size()]);
    r.push_back(p);
  }
  return r;
}

}  // namespace

TEST_CASE("packs: memory, lanes, broadcast", "[math][pack]") {
  for_all_packs([]<class P>() {
    using T = typename P::value_type;
    constexpr auto n = static_cast<std::size_t>(P::lanes);
    std::array<T, n + 2> from{}, to{};
    for (std::size_t i = 0; i < from.size(); ++i) from[i] = static_cast<T>(i) + T(0.5);
    P p = P::load(from.data() + 1);  // not aligned
    p.store(to.data() + 1);
    CHECK(to.front() == 0);
    CHECK(to.back() == 0);
    CHECK(std::equal(from.begin() + 1, from.end() - 1, to.begin() + 1));
    CHECK(each(p, [&](std::size_t i) { return from[i + 1]; }));
    p.set(n - 1, T(-7));
    CHECK(each(p, [&](std::size_t i) { return i == n - 1 ? T(-7) : from[i + 1]; }));
    CHECK(each(P(0.1), [](std::size_t) { return static_cast<T>(0.1); }));
    CHECK(each(P(3), [](std::size_t) { return T(3); }));
    const P copy = p;
    p = P{};
    CHECK(each(p, [](std::size_t) { return T(0); }));
    CHECK(copy[n - 1] == T(-7));
  });
}

TEST_CASE("packs: arithmetic and functions", "[math][pack]") {
  for_all_packs([]<class P>() {
    using T = typename P::value_type;
    CAPTURE(P::lanes, sizeof(T));
    const auto x = operands<P>(61), y = operands<P>(62);
    for (const P& a : x) {
      REQUIRE(each(-a, [&](std::size_t i) { return -a[i]; }));
      REQUIRE(each(+a, [&](std::size_t i) { return a[i]; }));
      REQUIRE(each(sqrt(a), [&](std::size_t i) { return std::sqrt(a[i]); }));
      REQUIRE(each(abs(a), [&](std::size_t i) { return std::fabs(a[i]); }));
      REQUIRE(each(fabs(a), [&](std::size_t i) { return std::fabs(a[i]); }));
      REQUIRE(each(exp(a), [&](std::size_t i) { return std::exp(a[i]); }));
      REQUIRE(each(2.0 * a, [&](std::size_t i) { return T(2) * a[i]; }));
      REQUIRE(each(a - 0.1, [&](std::size_t i) { return a[i] - T(0.1); }));
      REQUIRE(each(1 / a, [&](std::size_t i) { return T(1) / a[i]; }));
      for (const P& b : y) {
        REQUIRE(each(a + b, [&](std::size_t i) { return a[i] + b[i]; }));
        REQUIRE(each(a - b, [&](std::size_t i) { return a[i] - b[i]; }));
        REQUIRE(each(a * b, [&](std::size_t i) { return a[i] * b[i]; }));
        REQUIRE(each(a / b, [&](std::size_t i) { return a[i] / b[i]; }));
        REQUIRE(each(min(a, b), [&](std::size_t i) { return std::min(a[i], b[i]); }));
        REQUIRE(each(max(a, b), [&](std::size_t i) { return std::max(a[i], b[i]); }));
        P c = a;
        REQUIRE(each(c += b, [&](std::size_t i) { return a[i] + b[i]; }));
        REQUIRE(each(c = a, [&](std::size_t i) { return a[i]; }));
        REQUIRE(each(c -= b, [&](std::size_t i) { return a[i] - b[i]; }));
        c = a;
        REQUIRE(each(c *= b, [&](std::size_t i) { return a[i] * b[i]; }));
        c = a;
        REQUIRE(each(c /= b, [&](std::size_t i) { return a[i] / b[i]; }));
      }
    }
  });
}

TEST_CASE("packs: comparisons, masks and choices", "[math][pack]") {
  for_all_packs([]<class P>() {
    CAPTURE(P::lanes, sizeof(typename P::value_type));
    const auto x = operands<P>(63), y = operands<P>(64);
    for (const P& a : x)
      for (const P& b : y) {
        REQUIRE(each_truth<P>(a < b, [&](std::size_t i) { return a[i] < b[i]; }));
        REQUIRE(each_truth<P>(a <= b, [&](std::size_t i) { return a[i] <= b[i]; }));
        REQUIRE(each_truth<P>(a > b, [&](std::size_t i) { return a[i] > b[i]; }));
        REQUIRE(each_truth<P>(a >= b, [&](std::size_t i) { return a[i] >= b[i]; }));
        REQUIRE(each_truth<P>(a == b, [&](std::size_t i) { return a[i] == b[i]; }));
        REQUIRE(each_truth<P>(a != b, [&](std::size_t i) { return a[i] != b[i]; }));
        REQUIRE(each_truth<P>(!(a < b), [&](std::size_t i) { return !(a[i] < b[i]); }));
        REQUIRE(each_truth<P>((a < 0) & (b < 0), [&](std::size_t i) { return a[i] < 0 && b[i] < 0; }));
        REQUIRE(each_truth<P>((a < 0) | (b < 0), [&](std::size_t i) { return a[i] < 0 || b[i] < 0; }));
        auto m = a < 0;
        REQUIRE(each_truth<P>(m &= b < 0, [&](std::size_t i) { return a[i] < 0 && b[i] < 0; }));
        REQUIRE(each_truth<P>(m |= a == a, [&](std::size_t i) { return a[i] == a[i] || (a[i] < 0 && b[i] < 0); }));
        REQUIRE(each(select(a < b, a, b), [&](std::size_t i) { return a[i] < b[i] ? a[i] : b[i]; }));
      }
    CHECK(all(P(1) == 1));
    CHECK(!any(P(1) == 2));
    for (std::size_t i = 0; i < std::size_t{P::lanes}; ++i) {
      P one_of_them(0);
      one_of_them.set(i, 1);
      CHECK(any(one_of_them == 1));
      CHECK(all(one_of_them == 1) == (P::lanes == 1));
      CHECK(!all(one_of_them == 0));
      CHECK(any(one_of_them == 0) == (P::lanes > 1));
    }
    CHECK(each(select(P(1) > 0, P(3), 4), [](std::size_t) -> typename P::value_type { return 3; }));
    CHECK(kte::select(true, 3, 4) == 3);
  });
}

TEST_CASE("packs: typed constants and vectors with them", "[math][pack]") {
  for_all_packs([]<class P>() {
    using T = typename P::value_type;
    random_numbers random(65);
    const P p = random_pack<P>(random, 3), q = random_pack<P>(random, 3);
    static_assert(std::same_as<decltype(zero * p), zero_t> && std::same_as<decltype(p * one), P>);
    CHECK(each(constant<2>{} * p, [&](std::size_t i) { return 2 * p[i]; }));
    CHECK(each(p - minus_one, [&](std::size_t i) { return p[i] + 1; }));
    CHECK(each(minus_one * p, [&](std::size_t i) { return -p[i]; }));
    CHECK(each(zero - p, [&](std::size_t i) { return -p[i]; }));
    CHECK(each(as<P>(constant<-3>{}), [](std::size_t) { return T(-3); }));
    const vec3 parameter{0.5, zero, one};
    const vec3<P> v{p, q, q};
    CHECK(each((parameter + v).x, [&](std::size_t i) { return T(0.5) + p[i]; }));
    CHECK(each((parameter + v).z, [&](std::size_t i) { return T(1) + q[i]; }));
    CHECK(each(cross(parameter, v).z, [&](std::size_t i) { return T(0.5) * q[i]; }));
    CHECK(each((v * 2.0).y, [&](std::size_t i) { return 2 * q[i]; }));
    CHECK(each((minus_one * v).x, [&](std::size_t i) { return -p[i]; }));
    CHECK(each(as<P>(parameter).y, [](std::size_t) { return T(0); }));
    static_assert(std::same_as<decltype(dot(vec3{zero, zero, one}, v)), P>);
    CHECK(each(dot(vec3{zero, zero, one}, v), [&](std::size_t i) { return q[i]; }));
  });
}

TEST_CASE("packs in Eigen", "[math][pack]") {
  for_all_packs([]<class P>() {
    using T = typename P::value_type;
    using M = Eigen::Matrix<P, 3, 3>;
    random_numbers random(66);
    M m = M::Zero();
    CHECK(each(m(1, 2), [](std::size_t) { return T(0); }));
    for (auto& x : m.reshaped()) x = random_pack<P>(random, 1);
    const M square = m * m, twice = m + m;
    for (Eigen::Index r = 0; r < 3; ++r)
      for (Eigen::Index c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < std::size_t{P::lanes}; ++i) {
          const T sum = m(r, 0)[i] * m(0, c)[i] + m(r, 1)[i] * m(1, c)[i] + m(r, 2)[i] * m(2, c)[i];
          // Five roundings of sums below 3, at most half an eps each.
          CHECK(std::fabs(square(r, c)[i] - sum) <= 5 * 3 * std::numeric_limits<T>::epsilon());
          CHECK(twice(r, c)[i] == 2 * m(r, c)[i]);
        }
  });
}

namespace {

using digits50 = boost::multiprecision::cpp_bin_float_50;

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

}  // namespace

TEST_CASE("packs: sines and cosines", "[math][pack][sincos]") {
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

TEST_CASE("packs: small sines keep their digits", "[math][pack][sincos]") {
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

TEST_CASE("packs: a sine does not depend on the other lanes", "[math][pack][sincos]") {
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

TEST_CASE("packs: sines of a chain", "[math][pack][sincos]") {
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

TEST_CASE("packs: limits", "[math][pack]") {
  for_all_packs([]<class P>() {
    using limits = std::numeric_limits<P>;
    using lane = std::numeric_limits<typename P::value_type>;
    CHECK(all(limits::epsilon() == lane::epsilon()));
    CHECK(all(limits::max() == lane::max()));
    CHECK(all(limits::lowest() == lane::lowest()));
    CHECK(all(limits::min() == lane::min()));
    CHECK(all(limits::infinity() == lane::infinity()));
    CHECK(!any(limits::quiet_NaN() == limits::quiet_NaN()));
  });
}
