#include <kte/math/vec.hpp>

#include <concepts>
#include <limits>

#include "catch.hpp"

namespace constant_test {

using namespace kte;

template <class T, class U>
constexpr bool same(T, U) {
  return std::same_as<T, U>;
}

// constants with constants
static_assert(same(one + one, constant<2>{}));
static_assert(same(one - one, zero));
static_assert(same(-one, minus_one));
static_assert(same(constant<3>{} * constant<-2>{}, constant<-6>{}));
static_assert(one == one && !(one == zero));

// 0*x -> 0, 1*x -> x, -1*x -> -x, 0+x -> x
static_assert(same(zero * 2.5, zero) && same(2.5 * zero, zero));
static_assert(same(one * 2.5, 2.5) && one * 2.5 == 2.5);
static_assert(same(minus_one * 2.5, 2.5) && 2.5 * minus_one == -2.5);
static_assert(same(constant<3>{} * 2.5f, 2.5f) && constant<3>{} * 2.5f == 7.5f);
static_assert(zero + 2.5 == 2.5 && 2.5 + zero == 2.5 && 2.5 - zero == 2.5 && zero - 2.5 == -2.5);
static_assert(one + 2.5 == 3.5 && 2.5 + one == 3.5 && 2.5 - one == 1.5 && one - 2.5 == -1.5);
static_assert(constant<-7>{} + 2.5 == -4.5 && 2.5 - constant<-7>{} == 9.5);
static_assert(same(one + 2.5f, 2.5f) && same(one - 2.5L, 2.5L));

// skip swallows everything
static_assert(same(skip{} + 1.0, skip{}) && same(1.0 + skip{}, skip{}) && same(skip{} + skip{}, skip{}));
static_assert(same(skip{} - one, skip{}) && same(one - skip{}, skip{}) && same(skip{} - skip{}, skip{}));
static_assert(same(skip{} * zero, skip{}) && same(zero * skip{}, skip{}) && same(skip{} * skip{}, skip{}));
static_assert(same(-skip{}, skip{}));
static_assert(same(skip{} + vec3<>{}, skip{}) && same(vec3<>{} - skip{}, skip{}) && same(2.0 * skip{}, skip{}));
static_assert(same(cross(skip{}, vec3<>{}), skip{}) && same(cross(vec3<>{}, skip{}), skip{}));
static_assert(same(cross(skip{}, skip{}), skip{}));

// literals
static_assert(same(0_c, zero) && same(1_c, one) && same(-1_c, minus_one) && same(120_c, constant<120>{}));

// scalars
static_assert(as<double>(constant<-4>{}) == -4.0 && same(as<float>(one), 1.0f) && same(as<float>(0.5), 0.5f));
static_assert(same(real(3), 3.0) && same(real(3.0f), 3.0f) && same(real(one), one) && same(along_z(1).z, 1.0));

// what counts as what
static_assert(typed_constant<zero_t> && typed_constant<const one_t&> && !typed_constant<double>);
static_assert(variable<double> && variable<int> && !variable<zero_t> && !variable<skip> && !variable<vec3<>>);
static_assert(geometric<vec3<>> && geometric<const zero3&> && !geometric<double> && !geometric<zero_t>);
static_assert(entry<zero_t> && entry<float> && !entry<skip> && !entry<vec3<>>);
static_assert(sizeof(vec3<zero_t>) < sizeof(double));

TEST_CASE("a typed zero absorbs even infinity and NaN") {
  const double inf = std::numeric_limits<double>::infinity();
  CHECK(as<double>(zero * inf) == 0.0);
  CHECK(as<double>(std::numeric_limits<double>::quiet_NaN() * zero) == 0.0);
}

TEST_CASE("typed constants do what numbers do") {
  for (const double x : {0.0, -1.5, 3.25, 1e300, -1e-300}) {
    CHECK(constant<2>{} * x == 2.0 * x);
    CHECK(x * constant<-5>{} == x * -5.0);
    CHECK(constant<2>{} + x == 2.0 + x);
    CHECK(x - constant<2>{} == x - 2.0);
    CHECK(constant<2>{} - x == 2.0 - x);
    CHECK(zero - x == -x);
  }
}

}  // namespace constant_test
