#pragma once

#include <kte/frames/rigid_motion.hpp>
#include <kte/recursions/force_variations.hpp>

#include <Eigen/Core>

#include "catch.hpp"
#include "digits50.hpp"
#include "random.hpp"

/// The first variations of inverse dynamics, one kernel at a time, against central differences at 50 digits of the
/// functions that they differentiate: `compose`, `transmit`, and Newton's and Euler's equations.
///
/// Steps of 1e-16 err by 1e-32 times a third derivative and lose 1e-50/1e-16 = 1e-34 times the function; numbers go up
/// to 1e2. Measured 1.5e-32 where positions change. By rates all is of second degree, which leaves the loss alone:
/// measured 2.7e-33. Results without differences are exact to 1e-46; measured 3e-49.
namespace kte::test::variations {

using big = digits50;
using vector = vec3<big>;
using square = mat3<vector>;
using namespace kte::detail;

inline constexpr double by_position_bound = 1e-30, by_rate_bound = 1e-32;
inline const big step("1e-16");

inline vector random_vector(random_numbers& random) { return {big(random(2)), big(random(2)), big(random(2))}; }
inline square random_matrix(random_numbers& random) {
  return {random_vector(random), random_vector(random), random_vector(random)};
}
inline auto random_rotation(random_numbers& random) { return to_quaternion(random_vector(random)); }
inline auto random_inertia(random_numbers& random) {
  const auto n = [&] { return big(random(2)); };
  return to_composite(rigid_body{n(), random_vector(random), sym3{n(), n(), n(), n(), n(), n()}});
}
inline auto random_motion(random_numbers& random) {
  return motion{random_vector(random), matrix(random_rotation(random)), random_vector(random),
                random_vector(random), random_vector(random),           random_vector(random)};
}
inline vector random_axis(random_numbers& random) {
  const auto v = random_vector(random);
  return as<big>(big(1 / sqrt(dot(v, v))) * v);
}
inline vector unit(int k) { return {big(k == 0), big(k == 1), big(k == 2)}; }

/// A change of motion, a wrench or a number as numbers.
template <class V>
Eigen::Matrix<big, 3, 1> column(const V& v) {
  return {as<big>(v.x), as<big>(v.y), as<big>(v.z)};
}
template <class W, class A, class AL>
Eigen::Matrix<big, 9, 1> numbers(const variation<W, A, AL>& d) {
  Eigen::Matrix<big, 9, 1> r;
  r << column(d.ang_velocity), column(d.acceleration), column(d.ang_acceleration);
  return r;
}
template <class F, class T>
Eigen::Matrix<big, 6, 1> numbers(const wrench<F, T>& w) {
  Eigen::Matrix<big, 6, 1> r;
  r << column(w.force), column(w.torque);
  return r;
}
template <class F, class T>
Eigen::Matrix<big, 6, 3> numbers(const gyration<F, T>& g) {
  Eigen::Matrix<big, 6, 3> r;
  const auto f = [&](int k) { return as<big>(g.force * unit(k)); };
  const auto t = [&](int k) { return as<big>(g.torque * unit(k)); };
  for (int k = 0; k < 3; ++k) r.col(k) << column(f(k)), column(t(k));
  return r;
}
/// The rates of a motion, whose change is a `variation`.
template <class M>
auto rates_of(const M& m) {
  return numbers(variation{m.ang_velocity, m.acceleration, m.ang_acceleration});
}
inline auto variation_from(const Eigen::Matrix<big, 9, 1>& x) {
  const auto part = [&](int i) { return vector{x[i], x[i + 1], x[i + 2]}; };
  return variation{part(0), part(3), part(6)};
}
template <class M, class V>
auto moved(M m, const V& d, const big& h) {
  m.ang_velocity = as<big>(m.ang_velocity + h * d.ang_velocity);
  m.acceleration = as<big>(m.acceleration + h * d.acceleration);
  m.ang_acceleration = as<big>(m.ang_acceleration + h * d.ang_acceleration);
  return m;
}
/// (f(h) - f(-h)) / 2h
template <class F>
auto difference_of(const F& f) {
  return ((f(step) - f(-step)) / (2 * step)).eval();
}
template <class X, class Y>
double gap(const X& x, const Y& y) {
  big most = 0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    most = test::worse(most, big(abs(x.data()[i] - y.data()[i])));
  }
  return static_cast<double>(most);
}
struct worst_gap {
  double value = 0;
  template <class X, class Y>
  void operator()(const X& x, const Y& y) {
    value = test::worse(value, gap(x, y));
  }
  void below(double bound) const {
#ifdef KTE_PRINT
    std::printf("%.1e\n", value);
#endif
    CHECK(value < bound);
  }
};

/// Newton and Euler: what moves a body by these rates.
template <class C, class M>
auto wrench_of(const C& b, const M& m) {
  const auto& w = m.ang_velocity;
  return wrench{b.mass * m.acceleration + cross(m.ang_acceleration, b.moment) + cross(w, cross(w, b.moment)),
                b.inertia * m.ang_acceleration + cross(b.moment, m.acceleration) + cross(w, b.inertia * w)};
}

}  // namespace kte::test::variations
