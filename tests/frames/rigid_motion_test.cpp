#include <kte/frames/rigid_motion.hpp>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "catch.hpp"
#include "math/gap.hpp"
#include "random.hpp"

namespace rigid_motion_test {

using namespace kte;
using namespace kte::test;
using many_digits = boost::multiprecision::cpp_bin_float_50;
using digits100 = boost::multiprecision::cpp_bin_float_100;

using exact = vec3<digits100>;

template <class S>
exact up(const vec3<S>& v) {
  return {digits100(v.x), digits100(v.y), digits100(v.z)};
}
template <class S>
S length(const vec3<S>& v) {
  using std::sqrt;
  const S most = worse(worse(size(v.x), size(v.y)), size(v.z));
  if (most == 0) return S(0);
  const vec3<S> u{v.x / most, v.y / most, v.z / most};
  return most * sqrt(dot(u, u));
}

/// Sum over k of (w x)^k x / (k + shift)!: the motion of a point by constant rates, from its differential equation. At
/// 100 digits, minus the digits of exp(|w|).
exact series(const exact& w, const exact& x, int shift) {
  exact sum{}, term = x;
  digits100 factorial = 1;
  for (int k = 1; k <= shift; ++k) factorial *= k;
  for (int k = 0; k < 250; ++k) {
    sum = sum + (1 / factorial) * term;
    term = cross(w, term);
    factorial *= k + 1 + shift;
  }
  return sum;
}
/// The position (1) of exponential.
exact position_of(const exact& v, const exact& w) { return series(w, v, 1); }
/// The v with this position, by Cramer's rule.
exact linear_of(const exact& p, const exact& w) {
  const exact x = series(w, {1, 0, 0}, 1), y = series(w, {0, 1, 0}, 1), z = series(w, {0, 0, 1}, 1);
  const digits100 det = dot(x, cross(y, z));
  return {dot(p, cross(y, z)) / det, dot(x, cross(p, z)) / det, dot(x, cross(y, p)) / det};
}

// u = eps/2, |w| = t. The length of a product of vectors has an error of at most 3 u, so that of t has one of 3 u.
//
// exponential: B = 2 (sin(t/2)/t)^2 is in error by 8 u, with its vector and product 12 u; |B w x v| <= 0.73 |v|.
// In C, t - sin t loses u t to the sine: an error of u |v| in C t^2 |v|. The rest is relative: 10 u of C, 6 u of its
// vectors, and C t^2 <= 1.1. Sums: 2 u of at most 1.8 |v|. Altogether 9 + 1 + 18 + 4 = 32 u, that is 16 eps, if all
// roundings conspire; independent ones, which these are, add up to a quarter of that. Beyond t = 2 pi the phase is
// wrong by t times 2 u.
//
// logarithm: w in error by 6 u t, in w x p/2 this is 10 u |p| for t = pi, with the vector's own 3 u 1.6 |p|; D t^2 <= 1
// with 1 - t/2 cot(t/2) in error by 4 u and at most 1.0, and the errors of vectors, another 14 u |p|. A quarter of it
// again.
template <class S>
const S few = 4 * std::numeric_limits<S>::epsilon();
// There and back: both, and the v of p is up to pi/2 longer.
template <class S>
const S both = 12 * std::numeric_limits<S>::epsilon();

/// Lengths of rotation vectors: none, below the square root of the smallest number, small, at the switch to the
/// leading term, up to half a turn and near it.
template <class S>
std::vector<S> angles() {
  const S pi = atan2(S(0), S(-1)), eps = std::numeric_limits<S>::epsilon(), branch = sqrt(eps);
  std::vector<S> a{S(0), S(1e-300), S(1e-200), S(1e-161), S(1e-154), S(1e-150), S(1e-100), S(1e-30)};
  for (const double x :
       {1e-17, 1e-12, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.1, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0})
    a.push_back(S(x));
  for (const S& x : {S(0.999), S(1.0), S(1.001), S(2.0)}) a.push_back(branch * x);
  for (const S& x : {S(1e-2), S(1e-4), S(1e-8), S(1e-12), S(1e-15), S(4 * eps)}) a.push_back(pi - x);
  return a;
}
template <class S>
vec3<S> direction(random_numbers& draw) {
  for (;;) {
    const vec3<S> d{S(draw()), S(draw()), S(draw())};
    const S n = length(d);
    if (n > S(0.1)) return {d.x / n, d.y / n, d.z / n};
  }
}
template <class S>
vec3<S> vector(random_numbers& draw) {
  return {S(draw()), S(draw()), S(draw())};
}
/// |a - b| by components, relative to `whole`.
template <class S>
digits100 apart(const vec3<S>& a, const exact& b, const digits100& whole) {
  const digits100 d = gap(up(a), b);
  return d == 0 ? digits100(0) : digits100(d / whole);
}

template <class S>
void check_exponential(random_numbers& draw, const vec3<S>& w, const S& scale) {
  const vec3<S> v = scale * vector<S>(draw);
  const auto x = exponential(v, w);
  const digits100 t = length(up(w));
  CHECK(apart(x.position, position_of(up(v), up(w)), length(up(v))) <= few<S>);
  // The quaternion of length 1; its axis to a few eps relative to its length, however small.
  const digits100 half = t / 2, k = t == 0 ? digits100(0.5) : digits100(sin(half) / t);
  const digits100 sign = cos(half) < 0 ? -1 : 1, phase = worse(digits100(1), half);
  CHECK(size(digits100(digits100(x.rotation.w) - sign * cos(half))) <= few<S> * phase);
  CHECK(apart(vec3<S>{x.rotation.x, x.rotation.y, x.rotation.z}, (sign * k) * up(w),
              t > 1 ? phase : digits100(k * t)) <= few<S>);
}
template <class S>
void check_logarithm(random_numbers& draw, const vec3<S>& w, const S& scale) {
  const vec3<S> p = scale * vector<S>(draw);
  const auto q = to_quaternion(w);
  const auto [v, angular] = logarithm(pose<unit_quaternion<S>, vec3<S>>{q, p});
  // w of the quaternion itself, which is of length 1 but for rounding
  const exact u{digits100(q.x), digits100(q.y), digits100(q.z)};
  const digits100 n = length(u), t = 2 * atan2(n, digits100(q.w));
  const exact exact_w = n == 0 ? exact{} : exact((t / n) * u);
  CHECK(apart(angular, exact_w, t) <= few<S>);
  CHECK(apart(v, linear_of(up(p), exact_w), length(up(p))) <= few<S>);
}

TEMPLATE_TEST_CASE("exponentials of rigid motions keep all digits", "", double, many_digits) {
  random_numbers draw(1);
  for (const auto& t : angles<TestType>())
    for (int i = 0; i < 5; ++i) check_exponential<TestType>(draw, t * direction<TestType>(draw), TestType(1));
  for (const double scale : {1e-280, 1e-100, 1e100, 1e280})  // of lengths
    for (const double t : {0.0, 1e-9, 1e-3, 2.0})
      check_exponential<TestType>(draw, TestType(t) * direction<TestType>(draw), TestType(scale));
  for (const double t : {3.5, 5.0, 6.28, 6.2831853, 10.0, 30.0, 60.0})  // more than half a turn, or a whole one
    for (int i = 0; i < 5; ++i) check_exponential<TestType>(draw, TestType(t) * direction<TestType>(draw), TestType(1));
}

TEMPLATE_TEST_CASE("logarithms of rigid motions keep all digits", "", double, many_digits) {
  random_numbers draw(2);
  for (const auto& t : angles<TestType>())
    for (int i = 0; i < 5; ++i) check_logarithm<TestType>(draw, t * direction<TestType>(draw), TestType(1));
  for (const double scale : {1e-280, 1e-100, 1e100, 1e280})
    for (const double t : {0.0, 1e-9, 1e-3, 2.0})
      check_logarithm<TestType>(draw, TestType(t) * direction<TestType>(draw), TestType(scale));
}

TEMPLATE_TEST_CASE("exponential and logarithm undo each other", "", double, many_digits) {
  using S = TestType;
  random_numbers draw(3);
  for (const auto& t : angles<S>())
    for (int i = 0; i < 5; ++i) {
      const vec3<S> w = t * direction<S>(draw), v = vector<S>(draw);
      const auto [linear, angular] = logarithm(exponential(v, w));
      CHECK(apart(linear, up(v), length(up(v))) <= both<S>);
      CHECK(apart(angular, up(w), length(up(w))) <= both<S>);
      const auto there = exponential(linear, angular), x = exponential(v, w);
      CHECK(gap(there.rotation, x.rotation) <= both<S>);
      CHECK(apart(there.position, up(x.position), length(up(v))) <= both<S>);
    }
}

TEST_CASE("of rotations by more than half a turn the logarithm takes the shorter way") {
  random_numbers draw(4);
  const double pi = std::atan2(0.0, -1.0);
  for (const double t : {3.2, 4.0, 5.0, 6.0, 6.28}) {
    const auto d = direction<double>(draw), v = vector<double>(draw);
    const auto x = exponential(v, vec3<>(t * d));
    const auto [linear, angular] = logarithm(x);
    CHECK(gap(angular, vec3<>((t - 2 * pi) * d)) <= 8 * both<double>);  // phases up to 2 pi
    const auto again = exponential(linear, angular);
    CHECK(gap(again.rotation, x.rotation) <= both<double>);
    CHECK(gap(again.position, x.position) <= both<double> * length(v));
  }
  // q and -q are one pose.
  const auto x = exponential(vec3{1.0, 2.0, 3.0}, vec3{0.3, -0.4, 0.5});
  auto y = x;
  y.rotation = {-x.rotation.w, -x.rotation.x, -x.rotation.y, -x.rotation.z};
  CHECK(logarithm(x) == logarithm(y));
}

TEST_CASE("exponentials of shifts and of rotations alone are exact") {
  const auto shift = exponential(vec3{1.0, -2.0, 3e-300}, vec3{0.0, 0.0, 0.0});
  CHECK(shift.position == vec3{1.0, -2.0, 3e-300});
  CHECK(shift.rotation == unit_quaternion<>{});
  const auto turn = exponential(vec3<>{}, vec3{0.3, -0.4, 0.5});
  CHECK(turn.position == vec3{0.0, 0.0, 0.0});
  CHECK(turn.rotation == to_quaternion(vec3{0.3, -0.4, 0.5}));
  const auto [v, w] = logarithm(shift);
  CHECK(v == shift.position);
  CHECK(w == vec3{0.0, 0.0, 0.0});
}

TEST_CASE("a screw: along the axis all of v, across it a circle") {
  const double pi = std::atan2(0.0, -1.0);
  // At radius 2, pitch 0.5 a turn, by a quarter of a turn about z: from (0, -2) to (2, 0).
  const auto x = exponential(vec3{pi, 0.0, 0.125}, vec3{0.0, 0.0, pi / 2});
  CHECK(gap(x.position, vec3{2.0, 2.0, 0.125}) <= 4 * few<double>);
  CHECK(gap(x.rotation, unit_quaternion<>{std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)}) <= few<double>);
}

TEST_CASE("exponential and logarithm keep NaN") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(exponential(vec3{1.0, 0.0, 0.0}, vec3{0.0, nan, 0.0}).position.x));
  CHECK(std::isnan(exponential(vec3{1.0, 0.0, 0.0}, vec3{0.0, nan, 0.0}).rotation.w));
  CHECK(std::isnan(exponential(vec3{nan, 0.0, 0.0}, vec3{0.0, 1.0, 0.0}).position.x));
  CHECK(std::isnan(logarithm(pose<unit_quaternion<>, vec3<>>{{1.0, nan, 0.0, 0.0}, {1.0, 0.0, 0.0}}).first.x));
}

}  // namespace rigid_motion_test
