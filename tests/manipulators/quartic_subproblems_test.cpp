#include <kte/manipulators/quartic_subproblems.hpp>

#include "catch.hpp"
#include "digits50.hpp"
#include "random.hpp"

namespace quartic_subproblems_test {

using namespace kte;

template <class S>
S gap(const solved_angle<S>& a, const solved_angle<S>& b) {
  using std::abs;
  return abs(S(a.cos - b.cos)) + abs(S(a.sin - b.sin));
}

TEST_CASE("an equation of two harmonics has all its zeros, also close together") {
  random_numbers random(1);
  for (int k = 0; k < 2000; ++k) {
    // (1 - cos(t - a) + d)(cos(t - b) - c) and others: zeros known.
    const double a = random(3.1), b = random(3.1), d = k % 10 == 0 ? 0 : std::abs(random(k % 2 ? 1 : 1e-3)),
                 c = random(1);
    // (cos(t - a) - (1 - d))(cos(t - b) - c)
    const double u = 1 - d;
    const detail::two_harmonics f{std::cos(a + b) / 2, std::sin(a + b) / 2, -c * std::cos(a) - u * std::cos(b),
                                  -c * std::sin(a) - u * std::sin(b), std::cos(a - b) / 2 + u * c};
    const auto found = f.zeros(1e-14);
    for (const double t : {a + std::acos(u), a - std::acos(u), b + std::acos(c), b - std::acos(c)}) {
      double nearest = 10;
      for (const double x : found) nearest = std::min(nearest, std::abs(std::remainder(x - t, 2 * M_PI)));
      INFO(k << ": zeros " << t << ", a " << a << ", b " << b << ", d " << d << ", c " << c);
      CHECK(nearest < 1e-6);  // double zeros: to the square root of rounding
    }
  }
}

TEST_CASE("subproblem 6: the angles a question was made of are among the answers, which all are some") {
  random_numbers random(2);
  const auto ask = [&](auto scalar, double margin) {
    using S = decltype(scalar);
    for (int k = 0; k < 500; ++k) {
      const auto number = [&random] { return S(random()); };
      std::array<std::array<S, 2>, 2> A, B;
      for (auto* m : {&A, &B})
        for (auto& row : *m) row = {number(), number()};
      const auto t1 = angle_of(S(random(3.1))), t2 = angle_of(S(random(3.1)));
      std::array<S, 2> e;
      for (std::size_t i = 0; i < 2; ++i)
        e[i] = A[i][0] * t1.cos + A[i][1] * t1.sin + B[i][0] * t2.cos + B[i][1] * t2.sin;
      S nearest(10);
      for (const auto& x : subproblem6<S>(A, B, e)) {
        nearest = std::min(nearest, S(gap(x.first, t1) + gap(x.second, t2)));
        for (std::size_t i = 0; i < 2; ++i)
          CHECK(static_cast<double>(A[i][0] * x.first.cos + A[i][1] * x.first.sin + B[i][0] * x.second.cos +
                                    B[i][1] * x.second.sin - e[i]) == within(0, 1e-9));
      }
      CHECK(nearest < margin);
    }
  };
  ask(double{}, 1e-9);
  ask(kte::test::digits50{}, 1e-9);
}

TEST_CASE("subproblem 5: also where axes meet") {
  random_numbers random(3);
  const auto draw = [&random] { return vec3<>{random(), random(), random()}; };
  const auto unit = [&draw] {
    const auto v = draw();
    return vec3<>{(1 / std::sqrt(dot(v, v))) * v};
  };
  for (int k = 0; k < 2000; ++k) {
    const auto k1 = unit(), k2 = unit(), k3 = unit(), p1 = draw(), p3 = draw();
    const vec3<> none{0, 0, 0}, p2 = k % 3 == 1 ? none : draw();
    const auto t1 = angle_of(random(3.1)), t2 = angle_of(random(3.1)), t3 = angle_of(random(3.1));
    vec3<> p0 = turned(k2, t2, vec3<>(p2 + turned(k3, t3, p3))) - turned(k1, t1, p1);
    vec3<> from = p1;
    if (k % 3 == 2) from = turned(k1, -t1, vec3<>(p0 + turned(k1, t1, p1))), p0 = none;  // axes 1 and 2 meet
    double nearest = 10;
    for (const auto& x : subproblem5(p0, from, p2, p3, k1, k2, k3)) {
      nearest = std::min(nearest, gap(x.first, t1) + gap(x.second, t2) + gap(x.third, t3));
    }
    CHECK(nearest < 1e-7);
  }
}

TEST_CASE("subproblem 5 next to axis 2: both answers, to rounding") {
  random_numbers random(4);
  const auto draw = [&random] { return vec3<>{random(), random(), random()}; };
  const auto length = [](const vec3<>& v) { return std::sqrt(dot(v, v)); };
  const auto unit = [&] {
    const auto v = draw();
    return vec3<>{(1 / length(v)) * v};
  };
  for (const double away : {1e-4, 1e-6, 1e-7, 1e-8, 1e-10, 0.0})
    for (int k = 0; k < 200; ++k) {
      const auto k1 = unit(), k2 = unit(), k3 = unit(), p1 = draw(), p3 = draw();
      const auto t1 = angle_of(random(3.1)), t2 = angle_of(random(3.1)), t3 = angle_of(random(3.1));
      const vec3<> a = random(1) * k2 + away * unit(), p2 = a - turned(k3, t3, p3);
      const vec3<> p0 = turned(k2, t2, a) - turned(k1, t1, p1);
      double nearest = 10, open = 0;
      for (const auto& x : subproblem5(p0, p1, p2, p3, k1, k2, k3)) {
        nearest = std::min(nearest, gap(x.first, t1) + gap(x.third, t3) + away * gap(x.second, t2));
        open = test::worse(
            open, length(turned(k2, x.second, vec3<>(p2 + turned(k3, x.third, p3))) - p0 - turned(k1, x.first, p1)));
      }
      INFO(away << " " << k);
      CHECK(nearest < 1e-9);
      CHECK(open < 1e-14);
    }
}

}  // namespace quartic_subproblems_test
