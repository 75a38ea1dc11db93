#pragma once

#include <kte/frames/inverse.hpp>
#include <kte/math/axis_angle.hpp>
#include <kte/testing/detail/numeric.hpp>

#include "digits50.hpp"
#include "random.hpp"

/// Random motions, motions along given curves, and how far motions are apart.
namespace kte::test {

template <class S>
vec3<S> random_vector(random_numbers& draw) {
  return {S(draw()), S(draw()), S(draw())};
}
/// A rotation of type R, by at most sqrt(3) 2 rad.
template <class R>
struct random_rotation;
template <class S>
struct random_rotation<unit_quaternion<S>> {
  static auto make(random_numbers& draw) { return to_quaternion(S(2) * random_vector<S>(draw)); }
};
template <class S>
struct random_rotation<mat3<vec3<S>>> {
  static auto make(random_numbers& draw) { return matrix(S(2) * random_vector<S>(draw)); }
};
template <class S>
struct random_rotation<rotation_2D<S>> {
  static auto make(random_numbers& draw) { return rotation_by(S(3 * draw())); }
};

/// All of a motion at random, with a rotation of type R.
template <class S, class R = mat3<vec3<S>>>
auto random_motion(random_numbers& draw) {
  const auto v = [&draw] { return random_vector<S>(draw); };
  const auto p = v();
  return motion{p, random_rotation<R>::make(draw), v(), v(), v(), v()};
}

/// A motion as numbers: position and rotation matrix; then v, w, a, al.
template <class S, class M>
std::array<S, 24> numbers_of(const M& m) {
  std::array<S, 24> n;
  std::size_t i = 0;
  const auto put = [&](const auto& v) {
    const auto d = as<S>(v);
    for (const S& x : {d.x, d.y, d.z}) n[i++] = x;
  };
  const auto r = matrix(m.rotation);
  put(m.position), put(r.x), put(r.y), put(r.z);
  put(m.velocity), put(m.ang_velocity), put(m.acceleration), put(m.ang_acceleration);
  return n;
}
/// Their largest difference, relative to the largest number or 1.
template <class S, class A, class B>
S apart(const A& a, const B& b) {
  return testing::detail::difference(numbers_of<S>(a), numbers_of<S>(b));
}

/// A curve of poses: p(t) and the rotation vector r(t) are polynomials of degree 3.
///
///   R(t) = R0 Rot(r(t)),  r(0) = 0
template <class S, class R>
struct curve {
  explicit curve(random_numbers& draw) : start(random_rotation<R>::make(draw)) {
    for (auto& c : p) c = random_vector<S>(draw);
    for (auto& c : r) c = random_vector<S>(draw);
    if constexpr (requires(R x) { x.cos; }) {
      for (auto& c : p) c.z = S(0);
      for (auto& c : r) c = {S(0), S(0), c.z};
    }
  }
  auto operator()(const S& t) const {
    const vec3<S> turn = t * (r[0] + t * (r[1] + t * r[2]));
    return pose{rotated(turn), vec3<S>(p[0] + t * (p[1] + t * (p[2] + t * p[3])))};
  }
  R rotated(const vec3<S>& turn) const {
    if constexpr (requires(R x) { x.cos; }) {
      return start * rotation_by(turn.z);
    } else if constexpr (requires(R x) { x.w; }) {
      return start * to_quaternion(turn);
    } else {
      return start * matrix(turn);
    }
  }
  R start;
  vec3<S> p[4], r[3];
};

/// The motion along a curve of poses at t = 0 by numerical differentiation.
///
///   v = R^T p',  a = R^T p'',  [w]x = R^T R',  [al]x the antimetric part of R^T R''
template <class S, class Curve>
auto motion_along(const Curve& c) {
  const auto [first, second] = testing::detail::derivatives<S>([&c](const S& t) {
    const auto x = c(t);
    const auto m = matrix(x.rotation);
    const auto r = as<S>(m);
    return std::array<S, 12>{x.position.x, x.position.y, x.position.z, r.x.x, r.x.y, r.x.z,
                             r.y.x,        r.y.y,        r.y.z,        r.z.x, r.z.y, r.z.z};
  });
  const auto x = c(S(0));
  const auto t = transpose(as<S>(matrix(x.rotation)));
  const auto linear = [&t](const std::array<S, 12>& d) { return vec3<S>(t * vec3<S>{d[0], d[1], d[2]}); };
  const auto angular = [&t](const std::array<S, 12>& d) {
    const auto m = t * mat3<vec3<S>>{{d[3], d[4], d[5]}, {d[6], d[7], d[8]}, {d[9], d[10], d[11]}};
    return vec3<S>{(m.z.y - m.y.z) / 2, (m.x.z - m.z.x) / 2, (m.y.x - m.x.y) / 2};
  };
  return motion{x.position, x.rotation, linear(first), angular(first), linear(second), angular(second)};
}

}  // namespace kte::test
