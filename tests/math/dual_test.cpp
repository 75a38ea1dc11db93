#include <kte/math/dual.hpp>
#include <kte/math/matrix.hpp>

#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <vector>

#include "catch.hpp"
#include "chain/models.hpp"
#include "digits50.hpp"
#include "math/draw.hpp"

namespace dual_test {

using kte::dual, kte::seeded, kte::constant, kte::zero, kte::one;
using big = kte::test::digits50;

using D = dual<double, 3>;
constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double inf = std::numeric_limits<double>::infinity();

static_assert(kte::variable<D> && kte::variable<dual<D, 2>> && kte::entry<D>);
static_assert(!std::convertible_to<D, double> && !std::constructible_from<double, D>);
static_assert(std::convertible_to<double, D> && std::convertible_to<int, D> && std::convertible_to<double, dual<D, 2>>);
static_assert(std::is_trivially_copyable_v<D> && std::is_trivially_default_constructible_v<D>);
static_assert(std::same_as<decltype(seeded<2>(1, 0)), dual<double, 2>>);

// at compile time too
constexpr D x0 = seeded<3>(2.0, 0), x1 = seeded<3>(5.0, 1);
static_assert((x0 * x1 + 1).value == 11 && (x0 * x1).derivative[0] == 5 && (x0 * x1).derivative[1] == 2);
static_assert((x0 / x1).derivative[0] == 0.2 && (x0 / 2).derivative[0] == 0.5 && (x0 - x1).derivative[1] == -1);
static_assert(D(7).derivative[0] == 0 && D(7).derivative[2] == 0 && D{}.value == 0);

// typed constants fold as with numbers
static_assert(std::same_as<decltype(zero * x0), kte::zero_t> && std::same_as<decltype(one * x0), D>);
static_assert((constant<2>{} * x0).derivative[0] == 2 && (constant<3>{} - x0).derivative[0] == -1);
static_assert(kte::as<D>(constant<4>{}).value == 4 && kte::lifted<D>(0.5).value == 0.5);

// vectors of any mixture of entries
constexpr auto crossed = cross(kte::vec3{x0, x1, 2.0}, kte::vec3{0.5, zero, one});
static_assert(crossed.x.derivative[1] == 1 && crossed.y.value == -1 && crossed.z.derivative[1] == -0.5);

/// Relative to the truth, in eps.
double off(double x, const big& truth) {
  using std::abs;
  return static_cast<double>(abs(big(x) - truth) / abs(truth)) / eps;
}

/// Truth by central differences: h^2 f'''/6 and 1e-50/h = 1e-35 are left, and f''' is at most 2e7 below.
template <class F>
big slope(const F& f, const big& x) {
  const big h("1e-15");
  return (f(big(x + h)) - f(big(x - h))) / (2 * h);
}

/// Value, derivative and second derivative of f at x, each by dual numbers of double, against 50 digits. `ulps`: eps
/// allowed for the first derivative, which is a few operations on values of std functions; the second derivative is a
/// sum of products of these, and at the points below no term is more than 10 times the sum.
template <class F>
void check_function(const char* name, const F& f, std::initializer_list<double> points, double ulps = 4) {
  for (const double x : points) {
    CAPTURE(name, x);
    const auto y = f(kte::seeded<3>(x, 1));
    // The compiler may contract a b + c in one and not in the other.
    CHECK(off(y.value, f(x)) <= 2);
    CHECK(off(y.derivative[1], slope(f, x)) <= ulps);
    CHECK((y.derivative[0] == 0 && y.derivative[2] == 0));

    dual<dual<double, 1>, 1> xx(seeded<1>(x, 0));
    xx.derivative[0] = 1;
    const auto yy = f(xx);
    CHECK(off(yy.value.value, f(x)) <= 2);
    CHECK(off(yy.derivative[0].value, yy.value.derivative[0]) <= 2 * ulps);
    const auto first = [&](const big& t) { return f(seeded<1>(t, 0)).derivative[0]; };
    const big second = slope(first, x);
    CHECK(static_cast<double>(abs(yy.derivative[0].derivative[0] - second)) <=
          10 * ulps * eps * static_cast<double>(abs(second)));
    CHECK(static_cast<double>(abs(first(x) - slope(f, x))) <= 1e-22 * static_cast<double>(1 + abs(first(x))));
  }
}

#define KTE_CHECK_FUNCTION(f, ...)                     \
  check_function(                                      \
      #f,                                              \
      [](const auto& x) {                              \
        using namespace std;                           \
        return std::remove_cvref_t<decltype(x)>(f(x)); \
      },                                               \
      __VA_ARGS__)

TEST_CASE("functions of one dual number against 50 digits") {
  KTE_CHECK_FUNCTION(sqrt, {0.3, 2.0, 1e10});
  KTE_CHECK_FUNCTION(sin, {0.3, -1.0, 2.5});
  KTE_CHECK_FUNCTION(cos, {0.3, -1.0, 2.5});
  KTE_CHECK_FUNCTION(tan, {0.3, -1.0, 1.2});
  KTE_CHECK_FUNCTION(asin, {0.3, -0.7, 0.999});
  KTE_CHECK_FUNCTION(acos, {0.3, -0.7, 0.999});
  KTE_CHECK_FUNCTION(atan, {0.3, -0.7, 20.0});
  KTE_CHECK_FUNCTION(exp, {0.3, -4.0, 10.0});
  KTE_CHECK_FUNCTION(tanh, {0.3, -0.5, 1.0}, 8);  // of 1 - t at t = 0.76
  KTE_CHECK_FUNCTION(log, {0.3, 0.9, 1e5});
}

TEST_CASE("expressions in one dual number against 50 digits") {
  using std::atan2, std::hypot, std::pow;
  const auto check = [](const char* name, const auto& f, std::initializer_list<double> points, double ulps = 4) {
    check_function(
        name, [&](const auto& x) { return std::remove_cvref_t<decltype(x)>(f(x)); }, points, ulps);
  };
  check("x^2.5", [](const auto& x) { return pow(x, 2.5); }, {0.4, 3.0});
  check("x^3", [](const auto& x) { return pow(x, 3); }, {0.4, -3.0});
  check("2^x", [](const auto& x) { return pow(2.0, x); }, {0.4, -3.0});
  // x^x log x has the condition |x| of exp.
  check(
      "x^x", [](const auto& x) { return pow(x, x); }, {0.7, 2.0, 3.0}, 8);
  check("1/x", [](const auto& x) { return 1 / x; }, {0.4, -3.0});
  check(
      "(1 + x)/(2 - x x)", [](const auto& x) { return (1 + x) / (2 - x * x); }, {0.4, 0.7}, 10);
  check(
      "chain rule",
      [](const auto& x) {
        using std::exp, std::sin;
        return exp(sin(x * x));
      },
      {0.4, 0.9}, 10);
}

TEST_CASE("functions of two dual numbers by their gradients") {
  using std::atan2, std::hypot, std::pow;
  const double a = 0.8, b = -0.6, p = 1.7;
  const auto x = seeded<2>(a, 0), y = seeded<2>(b, 1);
  const auto gradient = [](const auto& r, double dx, double dy) {
    CHECK(r.derivative[0] == within_relative(dx, 4 * eps));
    CHECK(r.derivative[1] == within_relative(dy, 4 * eps));
  };
  const double rr = a * a + b * b, h = std::hypot(a, b);
  gradient(atan2(y, x), -b / rr, a / rr);
  gradient(atan2(b, x), -b / rr, 0);
  gradient(atan2(y, a), 0, a / rr);
  gradient(hypot(x, y), a / h, b / h);
  gradient(hypot(a, y), 0, b / h);
  gradient(hypot(x, b), a / h, 0);
  gradient(pow(x, seeded<2>(p, 1)), p * std::pow(a, p - 1), std::pow(a, p) * std::log(a));
  gradient(pow(2.0, x), std::pow(2.0, a) * std::log(2.0), 0);
  gradient(pow(0.0, x), 0, 0);
  CHECK(atan2(y, x).value == std::atan2(b, a));
  CHECK(hypot(x, y).value == std::hypot(a, b));
  CHECK(pow(x, 0).derivative[0] == 0);
  const auto origin = seeded<2>(0.0, 0);
  CHECK(
      (pow(origin, 0.0).derivative[0] == 0 && pow(origin, 1).derivative[0] == 1 && pow(origin, 2).derivative[0] == 0));
  CHECK((pow(origin, seeded<2>(2.0, 1)).derivative[0] == 0 && pow(origin, seeded<2>(2.0, 1)).derivative[1] == 0));
  CHECK((pow(origin, seeded<2>(0.0, 1)).derivative[0] == 0 && pow(origin, seeded<2>(0.0, 1)).derivative[1] == 0));
}

TEST_CASE("arithmetic for every number of derivatives") {
  // Dyadic numbers, so that sums and products are exact and == is the right comparison.
  const auto check = []<class T, int N>(dual<T, N>) {
    kte::test::draw draw(7);
    dual<T, N> a(T(draw.dyadic())), b(T(0.5)), c;
    for (std::size_t i = 0; i < std::size_t{N}; ++i) a.derivative[i] = T(draw.dyadic());
    for (std::size_t i = 0; i < std::size_t{N}; ++i) b.derivative[i] = T(draw.dyadic());
    const auto is = [&](const dual<T, N>& r, T value, auto derivative) {
      CHECK(r.value == value);
      for (std::size_t i = 0; i < std::size_t{N}; ++i)
        CHECK(r.derivative[i] == derivative(a.derivative[i], b.derivative[i]));
    };
    CAPTURE(N, sizeof(T));
    const T u = a.value, v = b.value;
    is(a + b, u + v, [](T x, T y) { return x + y; });
    is(a - b, u - v, [](T x, T y) { return x - y; });
    is(a * b, u * v, [&](T x, T y) { return u * y + v * x; });
    is(a / b, u / v, [&](T x, T y) { return (x - u / v * y) / v; });
    is(-a, -u, [](T x, T) { return -x; });
    is(+a, u, [](T x, T) { return x; });
    is(a + 2, u + 2, [](T x, T) { return x; });
    is(2.0 + a, u + 2, [](T x, T) { return x; });
    is(a - T(2), u - 2, [](T x, T) { return x; });
    is(2 - a, 2 - u, [](T x, T) { return -x; });
    is(2.0 * a, 2 * u, [](T x, T) { return 2 * x; });
    is(a * 2.0f, 2 * u, [](T x, T) { return 2 * x; });
    is(a / 2, u / 2, [](T x, T) { return x / 2; });
    is(3 / b, 3 / v, [&](T, T y) { return -3 / (v * v) * y; });
    is(c = a, u, [](T x, T) { return x; });
    is(c += b, u + v, [](T x, T y) { return x + y; });
    is(c -= b, u, [](T x, T) { return x; });
    is(c *= 4, 4 * u, [](T x, T) { return 4 * x; });
    is(c /= 4.0, u, [](T x, T) { return x; });
    is(c *= c, u * u, [&](T x, T) { return 2 * u * x; });
    is(kte::select(u > 5, a, b), v, [](T, T y) { return y; });
    is(constant<3>{} * a, 3 * u, [](T x, T) { return 3 * x; });
  };
  [&]<int... N>(std::integer_sequence<int, N...>) {
    (check(dual<double, N + 1>{}), ...);
    (check(dual<float, N + 1>{}), ...);
    (check(dual<long double, N + 1>{}), ...);
  }
  (std::make_integer_sequence<int, 17>{});
}

TEST_CASE("comparisons, min, max, abs and what is finite look at the value") {
  const D a = seeded<3>(1.0, 0), b = seeded<3>(2.0, 1), also_a = seeded<3>(1.0, 2);
  CHECK((a < b && b > a && a <= also_a && a >= also_a && a == also_a && a != b && !(a < also_a)));
  CHECK((a < 2 && 2.0 > a && a == 1 && 1.0 == a && a != 3.0f && a <= 1 && 0 < a));
  using std::abs, std::fabs, std::isfinite, std::isinf, std::isnan, std::max, std::min;
  CHECK((min(a, b).derivative[0] == 1 && max(a, b).derivative[1] == 1));
  CHECK((min(a, also_a).derivative[0] == 1 && max(a, also_a).derivative[0] == 1));
  CHECK((min(b, 1.5).value == 1.5 && min(b, 1.5).derivative[1] == 0 && max(1.5, b).derivative[1] == 1));
  CHECK((abs(-a).value == 1 && abs(-a).derivative[0] == 1 && fabs(a).derivative[0] == 1 &&
         abs(-a * b).derivative[0] == 2));
  CHECK((isfinite(a) && !isfinite(a * inf) && isinf(a * inf) && isnan(a * std::nan("")) && !isnan(a)));
}

TEST_CASE("constants have no derivatives") {
  using std::exp, std::sin, std::sqrt;
  for (const D& x : {D(2.0), D(3), D(1.5f), sin(D(1)), sqrt(D(2)), exp(D(1)) * D(4) / 3 - D(1)})
    for (const double dx : x.derivative) CHECK(dx == 0);
  CHECK_THROWS_AS(seeded<3>(1.0, 3), kte::bad_argument);
  CHECK_THROWS_AS(seeded<3>(1.0, -1), kte::bad_argument);
}

TEST_CASE("sine and cosine of a dual number at once") {
  const auto check = [](const auto& x) {
    auto s = x, c = x;
    sincos(x, s, c);
    CHECK((s == sin(x) && c == cos(x)));
    CHECK((s.derivative[0] == c.value && c.derivative[0] == -s.value));
    sincos(s, s, c);  // may be the same object
    CHECK(s == sin(sin(x)));
  };
  check(seeded<3>(0.7, 0));
  check(seeded<3>(0.7f, 0));
  check(seeded<3>(big(7) / 10, 0));
  check(dual<D, 2>(seeded<3>(0.7, 0)) + seeded<2>(D(0), 0));
}

TEST_CASE("numeric_limits of dual numbers are those of their scalar") {
  using limits = std::numeric_limits<D>;
  using nested = std::numeric_limits<dual<dual<big, 1>, 2>>;
  static_assert(limits::is_specialized && limits::digits == 53 && !limits::is_integer && nested::is_specialized);
  static_assert(std::same_as<decltype(limits::epsilon()), D>);
  CHECK((limits::epsilon() == eps && limits::max() == std::numeric_limits<double>::max()));
  CHECK((limits::lowest() == -limits::max() && limits::infinity() == inf && isnan(limits::quiet_NaN())));
  CHECK((limits::min() > 0 && limits::epsilon().derivative[1] == 0));
  CHECK(nested::epsilon() == std::numeric_limits<big>::epsilon());
}

TEST_CASE("matrices of doubles times matrices of dual numbers") {
  kte::test::draw draw(11);
  const auto check = [&](auto A, auto B, Eigen::Index n) {
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j) {
        A(i, j) = draw.number();
        B(i, j) = seeded<3>(draw.number(), static_cast<int>((i + j) % 3)) * draw.number();
      }
    const auto part = [&](const auto& m, int k) {
      return Eigen::MatrixXd(Eigen::MatrixXd::NullaryExpr(n, n, [&](Eigen::Index i, Eigen::Index j) {
        return k < 0 ? m(i, j).value : m(i, j).derivative[static_cast<std::size_t>(k)];
      }));
    };
    const decltype(B) AB = A * B, BA = B * A, BB = B * B, sum = 2.0 * B + B * 0.5 - B / 4;
    const Eigen::MatrixXd a = A, b = part(B, -1);
    // Dot products of n numbers below 1 in magnitude, or of 2n.
    const double tolerance = 4 * static_cast<double>(n * n) * eps;
    for (int k = -1; k < 3; ++k) {
      const Eigen::MatrixXd d = part(B, k);
      CHECK((part(AB, k) - a * d).cwiseAbs().maxCoeff() <= tolerance);
      CHECK((part(BA, k) - d * a).cwiseAbs().maxCoeff() <= tolerance);
      CHECK((part(BB, k) - (k < 0 ? Eigen::MatrixXd(b * b) : Eigen::MatrixXd(d * b + b * d))).cwiseAbs().maxCoeff() <=
            tolerance);
      CHECK((part(sum, k) - 2.25 * d).cwiseAbs().maxCoeff() <= tolerance);
    }
  };
  check(Eigen::Matrix3d(), Eigen::Matrix<D, 3, 3>(), 3);
  const Eigen::MatrixXd m = Eigen::MatrixXd::Identity(9, 9);
  const Eigen::Matrix<D, -1, 1> v = Eigen::Matrix<D, -1, 1>::Constant(9, seeded<3>(2.0, 1));
  CHECK(Eigen::Matrix<D, -1, 1>(m * v) == v);
  CHECK(kte::jacobian_of(2 * (m * v)) == 2 * kte::jacobian_of(v));
  check(Eigen::MatrixXd(30, 30), Eigen::Matrix<D, -1, -1>(30, 30), 30);
}

TEST_CASE("Jacobian of a vector") {
  const D a = seeded<3>(2.0, 0), b = seeded<3>(3.0, 1), c = seeded<3>(5.0, 2);
  const Eigen::Vector2d ones(1, 1);
  const Eigen::Matrix<D, 2, 1> x(a * b, c * c * a);
  const auto j = kte::jacobian_of(x);
  static_assert(decltype(j)::RowsAtCompileTime == 2 && decltype(j)::ColsAtCompileTime == 3);
  CHECK(j == (Eigen::Matrix<double, 2, 3>() << 3, 2, 0, 25, 0, 20).finished());
  CHECK(kte::jacobian_of(x + x.cwiseProduct(ones)) == 2 * j);
  const Eigen::Matrix<D, -1, 1> dynamic = x;
  CHECK(kte::jacobian_of(dynamic) == j);
  CHECK(x.norm().value == std::sqrt(36.0 + 2500.0));
}

TEST_CASE("derivatives of the pendulum's inverse dynamics") {
  // m = 1 kg at l = 0.5 m under gravity g along -y: tau = m l^2 a + m g l cos q.
  using A = std::array<D, 1>;
  const auto pendulum = models::pendulum.gravity(kte::along_y(-9.81));
  kte::test::draw draw(13);
  for (int round = 0; round < 20; ++round) {
    const double q = 3 * draw.number(), v = 2 * draw.number(), a = 5 * draw.number();
    const auto tau = kte::inverse_dynamics(pendulum, A{seeded<3>(q, 0)}, A{seeded<3>(v, 1)}, A{seeded<3>(a, 2)});
    const auto j = kte::jacobian_of(tau);
    // Terms of 5 (gravity), 1.25 (inertia) and, cancelling each other, 1 (centrifugal), a few roundings each.
    const double tolerance = 10 * eps * 5;
    CHECK(std::fabs(tau[0].value - (0.25 * a + 9.81 * 0.5 * std::cos(q))) <= tolerance);
    CHECK(std::fabs(j(0, 0) + 9.81 * 0.5 * std::sin(q)) <= tolerance);
    CHECK(std::fabs(j(0, 1)) <= tolerance);
    CHECK(std::fabs(j(0, 2) - 0.25) <= tolerance);
    // Exact differences at 50 digits agree with dual numbers at 50 digits: h^2 and 1e-50/h are left.
    using B = std::array<dual<big, 3>, 1>;
    const auto fine =
        kte::inverse_dynamics(pendulum, B{seeded<3>(big(q), 0)}, B{seeded<3>(big(v), 1)}, B{seeded<3>(big(a), 2)});
    const big by_q = slope(
        [&](const big& x) {
          return kte::inverse_dynamics(pendulum, std::array{x}, std::array{big(v)}, std::array{big(a)})[0];
        },
        q);
    CHECK(abs(fine[0].derivative[0] - by_q) < 1e-28);
  }
}

}  // namespace dual_test
