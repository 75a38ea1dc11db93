#include <kte/frames/articulated.hpp>

#include <limits>

#include "catch.hpp"
#include "digits50.hpp"
#include "math/draw.hpp"

// Articulated inertias against dense matrices of six, [linear; angular].

namespace articulated_test {

using namespace kte;
using test::draw;
using big = kte::test::digits50;

template <class S>
using matrix6 = Eigen::Matrix<S, 6, 6>;
template <class S>
using vector6 = Eigen::Matrix<S, 6, 1>;
template <class S>
using matrix3 = Eigen::Matrix<S, 3, 3>;

template <class S, class X, class Y, class Z>
Eigen::Matrix<S, 3, 1> column(const vec3<X, Y, Z>& v) {
  return {as<S>(v.x), as<S>(v.y), as<S>(v.z)};
}
template <class S, class RX, class RY, class RZ>
matrix3<S> dense(const mat3<RX, RY, RZ>& m) {
  matrix3<S> r;
  r << column<S>(m.x).transpose(), column<S>(m.y).transpose(), column<S>(m.z).transpose();
  return r;
}
/// [v]x
template <class S, class X, class Y, class Z>
matrix3<S> skew(const vec3<X, Y, Z>& v) {
  return dense<S>(mat3{vec3{zero, -v.z, v.y}, vec3{v.z, zero, -v.x}, vec3{-v.y, v.x, zero}});
}
template <class S, class M, class H, class J>
matrix6<S> dense(const articulated<M, H, J>& b) {
  matrix6<S> r;
  const matrix3<S> h = dense<S>(b.coupling);
  r << dense<S>(full(b.linear)), h, h.transpose(), dense<S>(full(b.angular));
  return r;
}
template <class S, class A, class B>
vector6<S> stacked(const A& a, const B& b) {
  vector6<S> r;
  r << column<S>(a), column<S>(b);
  return r;
}
template <class S, class F, class T>
vector6<S> dense(const wrench<F, T>& w) {
  return stacked<S>(w.force, w.torque);
}
/// From the acceleration of a frame to that of one at rest in it, which stands at R and p: R^T (a + al x p), R^T al.
template <class S, class R, class P>
matrix6<S> to_end(const R& rotation, const P& p) {
  const matrix3<S> r = dense<S>(matrix(rotation)).transpose();
  matrix6<S> x;
  x << r, -r * skew<S>(p), matrix3<S>::Zero(), r;
  return x;
}

using numbers = articulated<sym3<>, mat3<>, sym3<>>;
numbers draw_numbers(draw& random) { return {random.symmetric(), random.matrix(), random.symmetric()}; }

template <class S>
articulated<sym3<S>, mat3<vec3<S>>, sym3<S>> to(const numbers& b) {
  return {as<S>(b.linear), as<S>(b.coupling), as<S>(b.angular)};
}

constexpr double eps = std::numeric_limits<double>::epsilon();
/// Entry by entry: whether x is within k eps of the exact value, times the sum of the sizes of its terms. The exact
/// value is in long double, whose own error is 1/2000 of that.
template <class X>
bool close(const X& x, const X& exact, const X& terms, double k) {
  const bool finite = x == x;
  return finite && ((x - exact).cwiseAbs().array() <= k * eps * terms.array()).all();
}
using wide = long double;
/// The matrix of absolute values, where a product R [p]x is the product of absolute values.
template <class R, class P>
matrix6<wide> sizes_of_way(const R& rotation, const P& p) {
  const matrix3<wide> r = dense<wide>(matrix(rotation)).transpose().cwiseAbs();
  matrix6<wide> x;
  x << r, r * skew<wide>(p).cwiseAbs(), matrix3<wide>::Zero(), r;
  return x;
}

TEST_CASE("an articulated inertia without joints is that of a body") {
  draw random(41);
  for (int i = 0; i < 100; ++i) {
    const rigid_body<> body{1 + random.number(), random.vector(), random.symmetric()};
    const auto c = to_composite(body);
    matrix6<double> exact;
    const Eigen::Matrix3d h = skew<double>(c.moment);
    exact << as<double>(c.mass) * Eigen::Matrix3d::Identity(), -h, h, test::eigen(c.inertia);
    CHECK(dense<double>(to_articulated(c)) == exact);  // numbers are only put in their places
    // F = m a + al x h, T = I al + h x a
    const auto a = random.vector(), al = random.vector();
    const auto w = accelerating_wrench(to_articulated(c), a, al);
    const auto f = c.mass * a + cross(al, c.moment), t = c.inertia * al + cross(c.moment, a);
    // Sums of five products of up to two numbers below 10, each rounded some five times.
    CHECK((test::eigen(w.force) - test::eigen(f)).norm() < 100 * eps);
    CHECK((test::eigen(w.torque) - test::eigen(t)).norm() < 100 * eps);
  }
}

TEST_CASE("the wrench that accelerates an articulated inertia") {
  draw random(42);
  for (int i = 0; i < 100; ++i) {
    const auto b = draw_numbers(random);
    const auto a = random.vector(), al = random.vector();
    const vector6<wide> x = stacked<wide>(a, al), exact = dense<wide>(b) * x;
    // Six products and five sums: no term is rounded more than six times, by eps/2.
    CHECK(close<vector6<wide>>(dense<wide>(accelerating_wrench(b, a, al)), exact,
                               dense<wide>(b).cwiseAbs() * x.cwiseAbs(), 3));
    const auto w = accelerating_wrench(to<big>(b), as<big>(a), as<big>(al));
    const vector6<big> gap = dense<big>(w) - dense<big>(b) * stacked<big>(a, al);
    CHECK(gap.cwiseAbs().maxCoeff() < 1e-48);
  }
}

TEST_CASE("a transported articulated inertia") {
  draw random(43);
  for (const double distance : {0.0, 1.0, 1e3}) {
    for (int i = 0; i < 100; ++i) {
      CAPTURE(distance, i);
      const auto b = draw_numbers(random);
      const auto r = matrix(random.rotation());
      const vec3<> p = distance * random.vector();
      // The power of the wrench is the same on both sides: I' = X^T I X, whatever the matrix R is.
      const auto x = to_end<wide>(r, p), way = sizes_of_way(r, p);
      const matrix6<wide> exact = x.transpose() * dense<wide>(b) * x;
      const matrix6<wide> terms = way.transpose() * dense<wide>(b).cwiseAbs() * way;
      // On the longest way, to J', a number of H is rounded 3 + 3 times when it is turned, and each of the products
      // with p once, with three sums; M three times more on its way to H': less than 16 times, by eps/2.
      CHECK(close<matrix6<wide>>(dense<wide>(transported(r, p, b)), exact, terms, 8));
      const auto up = transported(as<big>(r), as<big>(p), to<big>(b));
      const auto y = to_end<big>(r, p);
      const matrix6<big> difference = dense<big>(up) - matrix6<big>(y.transpose() * dense<big>(b) * y);
      CHECK(difference.cwiseAbs().maxCoeff() < 1e-47 * (1 + distance * distance));
    }
  }
}

TEST_CASE("transported articulated inertias of bodies are those of transported bodies") {
  draw random(44);
  for (int i = 0; i < 100; ++i) {
    const rigid_body<> body{1 + random.number(), random.vector(), random.symmetric()};
    const auto c = to_composite(body);
    const auto r = random.rotation();  // a quaternion
    const auto p = random.vector();
    const auto one_way = to_articulated(transported(r, p, c));
    const auto other = transported(r, p, to_articulated(c));
    // Numbers below 20, rounded 16 times on either way.
    CHECK((dense<double>(one_way) - dense<double>(other)).cwiseAbs().maxCoeff() < 20 * 16 * eps);
  }
}

constexpr auto in_plane = to_articulated(to_composite(planar_body(2.0, 0.5, vec3{0.25, 0.5, zero})));
constexpr auto along = to_articulated(to_composite(point_mass(2.0, along_x(0.5))));
constexpr rotation_2D turned{0.6, 0.8};
constexpr vec3 place{1.5, -0.25, zero};
constexpr auto moved = transported(turned, place, in_plane);
/// Whether what leads out of the plane, from motions in it, is typed zero.
template <class B>
constexpr bool stays_in_plane = [] {
  using w = decltype(accelerating_wrench(B{}, vec3<double, double, zero_t>{}, vec3<zero_t, zero_t, double>{}));
  return std::is_same_v<decltype(w::force.z), zero_t> && std::is_same_v<decltype(w::torque.x), zero_t> &&
         std::is_same_v<decltype(w::torque.y), zero_t>;
}();

TEST_CASE("typed zeros of articulated inertias") {
  // what is free
  STATIC_REQUIRE(std::is_same_v<decltype(no_articulated + in_plane), std::remove_const_t<decltype(in_plane)>>);
  STATIC_REQUIRE(std::is_same_v<decltype(in_plane + no_articulated), std::remove_const_t<decltype(in_plane)>>);
  STATIC_REQUIRE(
      std::is_same_v<decltype(transported(no_rotation{}, zero3{}, along)), std::remove_const_t<decltype(along)>>);
  STATIC_REQUIRE(std::is_same_v<decltype(transported(turned, place, no_articulated)),
                                std::remove_const_t<decltype(no_articulated)>>);
  STATIC_REQUIRE(
      std::is_same_v<decltype(accelerating_wrench(no_articulated, vec3<>{}, vec3<>{})), wrench<zero3, zero3>>);
  STATIC_REQUIRE(std::is_same_v<decltype(accelerating_wrench(along, zero3{}, zero3{})), wrench<zero3, zero3>>);
  STATIC_REQUIRE(std::is_same_v<decltype(along.coupling.y.z), double>);
  STATIC_REQUIRE(std::is_same_v<decltype(along.coupling.x), zero3>);
  // the plane
  STATIC_REQUIRE(stays_in_plane<std::remove_const_t<decltype(in_plane)>>);
  STATIC_REQUIRE(stays_in_plane<std::remove_const_t<decltype(moved)>>);
  STATIC_REQUIRE(stays_in_plane<decltype(moved + in_plane)>);

  // and the values are those of numbers in their place
  draw random(45);
  const auto same = [&]<class R, class P, class B>(const R& r, const P& p, const B& b) {
    const numbers filled{as<double>(b.linear), as<double>(b.coupling), as<double>(b.angular)};
    const auto m = as<double>(matrix(r));
    const auto v = as<double>(p);
    const auto typed = dense<double>(transported(r, p, b)), untyped = dense<double>(transported(m, v, filled));
    CHECK(typed == untyped);  // dyadic numbers: sums of products are exact
  };
  for (int i = 0; i < 50; ++i) {
    using some = articulated<sym3<double, zero_t, zero_t, double, double, one_t>,
                             mat3<vec3<zero_t, double, double>, zero3, vec3<double, zero_t, one_t>>,
                             sym3<zero_t, double, zero_t, zero_t, double, double>>;
    const some b{random.exact<decltype(some::linear)>(), random.exact<decltype(some::coupling)>(),
                 random.exact<decltype(some::angular)>()};
    const auto d = random.dyadic(), e = random.dyadic();
    same(quarter_turn_x, vec3{d, zero, e}, b);
    same(half_turn_y * quarter_turn_z, vec3{zero, zero, e}, b);
    same(no_rotation{}, vec3{d, e, one}, b);
    same(quarter_turn_y, zero3{}, in_plane);
    same(quarter_turn, vec3{d, e, zero}, in_plane);
  }
}

TEST_CASE("an articulated inertia less a dyad") {
  draw random(46);
  for (int i = 0; i < 50; ++i) {
    const auto b = draw_numbers(random);
    const wrench u{random.vector(), random.vector()};
    const double d = 2 + random.number();
    const wrench gain{d * u.force, d * u.torque};
    const vector6<wide> x = dense<wide>(u), y = dense<wide>(gain);
    const matrix6<wide> exact = dense<wide>(b) - x * y.transpose();
    // A product and a difference. Only the upper triangles of M and J are computed, and H.
    const matrix6<wide> difference = dense<wide>(kte::detail::less_dyad(b, u, gain)) - exact;
    const matrix6<wide> terms = dense<wide>(b).cwiseAbs() + x.cwiseAbs() * y.cwiseAbs().transpose();
    // y is a multiple of x to one rounding, which the lower triangle sees.
    CHECK((difference.cwiseAbs().array() <= 2 * eps * terms.array()).all());
  }
}

}  // namespace articulated_test
