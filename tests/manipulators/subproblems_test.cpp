#include <kte/manipulators/two_links.hpp>

#include "catch.hpp"
#include "digits50.hpp"
#include "random.hpp"

namespace subproblems_test {

using namespace kte;

template <class S>
vec3<S> draw(random_numbers& random) {
  return {S(random()), S(random()), S(random())};
}
template <class S>
vec3<S> unit(random_numbers& random) {
  using std::sqrt;
  const auto v = draw<S>(random);
  return (S(1) / sqrt(dot(v, v))) * v;
}
template <class S>
S length(const vec3<S>& v) {
  using std::sqrt;
  return sqrt(dot(v, v));
}
template <class S>
bool same(const solved_angle<S>& a, const solved_angle<S>& b, double margin) {
  using std::abs;
  return abs(S(a.cos - b.cos)) + abs(S(a.sin - b.sin)) <= margin;
}

/// Questions made from their answers.
template <class S>
void ask_all(double margin) {
  using std::abs;
  random_numbers random(1);
  for (int i = 0; i < 1000; ++i) {
    const auto k = unit<S>(random), k2 = unit<S>(random), p = draw<S>(random), n = draw<S>(random);
    const auto t = angle_of(S(random(3.1))), t2 = angle_of(S(random(3.1)));
    const auto near = [&](const auto& x, const auto& y) { CHECK(length(vec3<S>(x - y)) <= margin); };

    const auto across = cross(k, p);  // digits of an angle are lost as p comes near the axis
    CHECK(same(subproblem1(k, p, turned(k, t, p)), t, margin / static_cast<double>(dot(across, across))));

    const S d = dot(n, turned(k, t, p));
    const auto four = subproblem4(k, p, n, d);
    CHECK(!four.free);
    CHECK(four.slack <= margin);
    for (const auto& x : {four.plus, four.minus}) CHECK(abs(S(dot(n, turned(k, x, p)) - d)) <= margin);

    const auto q = turned(k2, -t2, turned(k, t, p));
    const auto two = subproblem2(k, p, k2, q);
    near(turned(k, two.first.plus, p), turned(k2, two.second.plus, q));
    near(turned(k, two.first.minus, p), turned(k2, two.second.minus, q));

    const S far = length(vec3<S>(turned(k, t, p) - n));
    const auto three = subproblem3(k, p, n, far);
    for (const auto& x : {three.plus, three.minus}) {
      const S square = dot(turned(k, x, p) - n, turned(k, x, p) - n) - far * far;
      CHECK(abs(square) <= margin);
    }
    const auto flat = [&](const vec3<S>& v) { return vec3<S>(v - dot(k, v) * k); };
    const auto l1 = flat(p), l2 = flat(n), a = turned(k, t, vec3<S>(l1 + turned(k, t2, l2)));
    const auto both = triangle(k, l1, l2, a);
    near(turned(k, both.t2.plus, vec3<S>(l1 + turned(k, both.t3.plus, l2))), a);
    near(turned(k, both.t2.minus, vec3<S>(l1 + turned(k, both.t3.minus, l2))), a);
  }
}

TEST_CASE("subproblems 1 to 4 and the triangle solve the inverse question") {
  ask_all<double>(1e-14);
  ask_all<float>(5e-6);
  ask_all<long double>(1e-17);
  ask_all<kte::test::digits50>(1e-47);
}

TEST_CASE("a cos t + b sin t = c at its border") {
  for (const double c : {2.0, -2.0}) {
    const auto t = linear_in_angle(1.2, 1.6, c);  // h = 2
    CHECK(t.slack == within(0, 5e-16));
    CHECK(1.2 * t.plus.cos + 1.6 * t.plus.sin == within(c, 1e-15));
    const auto over = linear_in_angle(1.2, 1.6, 1.5 * c);
    CHECK(over.slack == within(1, 1e-15));
    CHECK(over.plus.value() == over.minus.value());
    CHECK(1.2 * over.plus.cos + 1.6 * over.plus.sin == within(c, 1e-15));  // of least squares
  }
  const auto free = linear_in_angle(0.0, 0.0, 0.0, 1e-15, angle_of(0.3));
  CHECK(free.free);
  CHECK(free.plus.value() == within(0.3, 1e-16));
  CHECK(free.minus.value() == within(0.3 - M_PI, 4e-16));
}

TEST_CASE("next to its border an angle has all the digits that 50 digits give it") {
  for (int k = 1; k <= 15; ++k) {
    const double c = 1 - std::pow(10.0, -k);
    const auto t = linear_in_angle(1.0, 0.0, c);
    const double exact = static_cast<double>(
        linear_in_angle(kte::test::digits50(1), kte::test::digits50(0), kte::test::digits50(c)).plus.value());
    CHECK(t.plus.value() == within_relative(exact, 4e-16));
  }
}

TEST_CASE("two turns of a vector next to the second axis: the first to rounding") {
  random_numbers random(5);
  const vec3<> k1{0.6, 0, 0.8}, k2{0, 0, 1};
  const auto t2 = angle_of(1.0);  // room for both answers
  for (int e = 0; e <= 16; ++e)
    for (int n = 0; n < 20; ++n) {
      const vec3<> p2{std::pow(10.0, -e), 0, 1};
      const auto t1 = angle_of(random(3));
      const auto t = subproblem2(k1, turned(k1, -t1, turned(k2, t2, p2)), k2, p2);
      const auto away = [&](const solved_angle<double>& x) { return std::hypot(x.cos - t1.cos, x.sin - t1.sin); };
      INFO("1e-" << e << ", sample " << n);
      CHECK(std::min(away(t.first.plus), away(t.first.minus)) <= 4e-15);
    }
}

TEST_CASE("a triangle next to stretched and to folded reaches its point") {
  const vec3<> k{0, 0, 1}, l1{0.7, 0, 0}, l2{0.4, 0, 0};
  for (int e = 0; e <= 16; ++e)
    for (const double border : {1.1, 0.3})
      for (const double side : {1.0, -1.0}) {
        const double D = border + side * (e == 0 ? 0 : std::pow(10.0, -e));
        const vec3<> a{0.6 * D, 0.8 * D, 0};
        const auto t = triangle(k, l1, l2, a);
        const double reached = D > 1.1 ? 1.1 : D < 0.3 ? 0.3 : D;
        const vec3<> p = turned(k, t.t2.plus, vec3<>(l1 + turned(k, t.t3.plus, l2)));
        CHECK(length(vec3<>(p - a)) == within(std::abs(D - reached), 5e-16));
        CHECK(t.t3.slack == within(std::abs(D - reached), 5e-16));
      }
}

TEST_CASE("equal links folded to a point leave the first angle free") {
  const vec3<> k{0, 0, 1}, l{0.5, 0, 0};
  const auto t = triangle(k, l, l, vec3<>{0, 0, 0}, angle_of(1.0));
  CHECK(t.t2.free);
  CHECK(t.t2.plus.value() == within(1, 2e-16));
  CHECK(std::abs(t.t3.plus.value()) == within(M_PI, 1e-15));
}

}  // namespace subproblems_test
