#pragma once

#include <kte/contact/contact_geometry.hpp>
#include <kte/contract/closure.hpp>
#include <kte/testing/element_laws.hpp>

/// Laws of the geometry of contacts, for surfaces of kte and of users, like those of testing/element_laws.hpp.
namespace kte::testing {

namespace detail {
/// A frame that moves with constant acceleration relative to another and turns about a fixed axis, at time t.
template <class S>
struct moving_frame {
  vec3<S> p, v, a, axis;
  mat3<vec3<S>> start;
  S w, al;

  template <class Draw>
  moving_frame(Draw& draw, const vec3<S>& about) {
    const auto number = [&draw] { return S(draw()); };
    const auto vector = [&] { return vec3<S>{number(), number(), number()}; };
    p = as<S>(about + S(0.3) * vector()), v = vector(), a = vector();
    start = matrix(vector());
    axis = as<S>(kte::detail::to_polar(vector()).direction), w = number(), al = number();
  }
  kte::detail::closing_motion<S> at(const S& t) const {
    const mat3<vec3<S>> r = as<S>(start * matrix(as<S>(S(t * (w + t / S(2) * al)) * axis)));
    const auto back = transpose(r);
    return {as<S>(p + t * (v + S(t / S(2)) * a)),
            r,
            as<S>(back * (v + t * a)),
            as<S>(S(w + t * al) * axis),
            as<S>(back * a),
            as<S>(al * axis)};
  }
};
template <class V>
auto three(const V& v) {
  return std::array{v.x, v.y, v.z};
}
}  // namespace detail

/// `gap_dot` and `gap_ddot` are the derivatives of `gap` and `gap_dot`, `slip_rate` that of `slip`, along random
/// motions of the second frame near the point `about` of the first. Returns the largest violation. Surfaces that are
/// not a distance fulfil the first only where the gap is 0: `is_distance` is false for them.
template <class S, class Geometry, class Draw>
S contact_rates_are_derivatives(const Geometry& g, Draw&& draw, const vec3<S>& about, bool is_distance = true) {
  S worst(0);
  for (int i = 0; i < 20; ++i) {
    const detail::moving_frame<S> x(draw, about);
    const auto m = x.at(S(0));
    const auto rate = [&](const auto& f) {
      return detail::derivatives<S>([&](const S& t) { return f(x.at(t)); }).first;
    };
    const auto gap = rate([&](const auto& at) { return std::array<S, 1>{S(g.gap(at))}; });
    const auto speed = rate([&](const auto& at) { return std::array<S, 1>{S(g.gap_dot(at))}; });
    const auto slip = rate([&](const auto& at) { return detail::three(as<S>(g.slip(at))); });
    if (is_distance) worst = detail::worse(worst, detail::difference<S, 1>(gap, {S(g.gap_dot(m))}));
    worst = detail::worse(worst, detail::difference<S, 1>(speed, {S(g.gap_ddot(m))}));
    worst = detail::worse(worst, detail::difference<S, 3>(slip, detail::three(as<S>(g.slip_rate(m)))));
  }
  return worst;
}
/// The rate of the gap is the normal part of the slip. Returns the violation.
template <class S, class Geometry, class Draw>
S gap_rate_is_normal_velocity(const Geometry& g, Draw&& draw, const vec3<S>& about) {
  S worst(0);
  for (int i = 0; i < 20; ++i) {
    const auto m = detail::moving_frame<S>(draw, about).at(S(0));
    worst = detail::worse(worst, detail::difference<S, 1>({S(g.gap_dot(m))}, {S(dot(g.normal(m), g.slip(m)))}));
  }
  return worst;
}

}  // namespace kte::testing
