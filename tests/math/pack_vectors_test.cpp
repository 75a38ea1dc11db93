#include <kte/math/matrix.hpp>

#include <concepts>
#include <limits>

#include "catch.hpp"
#include "math/packs.hpp"

// Packs as numbers of vectors and matrices, kte's and Eigen's.

namespace pack_vectors_test {

using namespace kte;
using namespace kte::test;

TEST_CASE("packs: typed constants and vectors with them") {
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

TEST_CASE("packs in Eigen") {
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

}  // namespace pack_vectors_test
