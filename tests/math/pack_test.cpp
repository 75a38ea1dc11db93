#include <kte/math/vec.hpp>

#include <algorithm>
#include <concepts>
#include <limits>
#include <vector>

#include "catch.hpp"
#include "math/packs.hpp"

// Everything lane by lane against the same with plain numbers.

namespace pack_test {

using namespace kte;
using namespace kte::test;

static_assert(variable<pack<double, 8>> && entry<pack<float, 4>> && !geometric<pack<double, 2>>);
static_assert(std::is_convertible_v<double, pack<float, 8>> && std::is_convertible_v<int, pack<double, 4>>);
static_assert(std::is_trivially_default_constructible_v<pack<double, 8>> && sizeof(pack<float, 16>) == 64);
static_assert(std::same_as<decltype(2.0 * pack<float, 16>()), pack<float, 16>>);
static_assert(std::same_as<decltype(pack<double, 4>() < 1), pack_mask<double, 4>>);
static_assert(std::numeric_limits<pack<float, 8>>::digits == 24 && std::numeric_limits<pack<double, 8>>::is_iec559);
static_assert(!Eigen::NumTraits<pack<double, 8>>::RequireInitialization);

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

TEST_CASE("packs: memory, lanes, broadcast") {
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

TEST_CASE("packs: arithmetic and functions") {
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

TEST_CASE("packs: comparisons, masks and choices") {
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

TEST_CASE("packs: limits") {
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

}  // namespace pack_test
