#pragma once

#include <kte/models/detail/displacement.hpp>

/// Momenta over a step h of a variational integrator, with velocities (v, w) at the midpoint, in axes there, and
/// momenta p = (g, l), linear and angular. From the variation of h L(q_m, v, w) with q_m = q0 (+) d/2, q1 = q0 (+) d:
///
///   d = h (E^-1 v, w),   E = exp [-phi]x,  phi = h w/2                                    (1)
///   K = p' - (g x w, l x w)     at the middle                                             (2)
///   g = E g0 + h/2 K_g,   l = J(2 phi) (l0 + h E^-1 K_l) - h/2 J(phi)^T K_l               (3)
///   p1 = E (E p0 + h K)         so that K = 0 only rotates them with the axes             (4)
///   J(x) = 1 - b [x]x + c [x]x^2,  b = (1 - cos t)/t^2,  c = (t - sin t)/t^3,  t = |x|    (5)
///
/// Coordinates that are numbers are lengths without rotation. Kobilarov and Marsden, Discrete geometric optimal control
/// on Lie groups, IEEE Trans. Robotics 27 (2011), III; here for rotations with positions as in displacement.hpp.
namespace kte::detail {

template <class S>
struct linear_and_angular {
  vec3<S> linear{}, angular{};
};
template <class S, class X>
linear_and_angular<S> read_rates(const freedom& f, const X& x) {
  const auto j = static_cast<std::size_t>(f.v);
  if (f.what == kind::gen) return {{S(x[j]), S(0), S(0)}, {}};
  const auto [linear, angular] = rates_from<S>(f.what, x, j);
  return {linear, angular};
}
template <class S, class X>
void write_rates(const freedom& f, const linear_and_angular<S>& r, X& x) {
  if (f.what == kind::gen) {
    x[f.v] = r.linear.x;
  } else if (f.what == kind::pose_2D) {
    x[f.v] = r.linear.x, x[f.v + 1] = r.linear.y, x[f.v + 2] = r.angular.z;
  } else {
    if (f.what == kind::pose_3D) put_vector(x, f.v, r.linear);
    put_vector(x, f.what == kind::pose_3D ? f.v + 3 : f.v, r.angular);
  }
}

/// (5) times y; its transpose is J(-x).
template <class S>
vec3<S> derivative_of_exponential(const vec3<S>& x, const vec3<S>& y) {
  const auto [b, c] = turned_shift(dot(x, x));
  const auto turned = cross(x, y);
  return as<S>(y - b * turned + c * cross(x, turned));
}
/// exp([x]x) y - y, accurate for small x.
template <class S>
vec3<S> change_by_turning(const vec3<S>& x, const vec3<S>& y) {
  const S tt = dot(x, x);
  const auto [b, c] = turned_shift(tt);
  const auto turned = cross(x, y);
  return as<S>((S(1) - tt * c) * turned + b * cross(x, turned));  // sin(t)/t = 1 - t^2 c
}

/// One step of one coordinate.
template <class S>
class momentum_step {
 public:
  template <class V>
  momentum_step(const freedom& f, const S& h, const V& v) : f_(f), h_(h), v_(read_rates<S>(f, v)) {
    phi_ = as<S>((h / S(2)) * v_.angular);
  }
  /// d of (1).
  template <class D>
  void displacement(D& d) const {
    if (is_number()) return void(d[f_.v] = h_ * v_.linear.x);
    write_rates<S>(f_, {as<S>(h_ * (v_.linear + change_by_turning(phi_, v_.linear))), as<S>(h_ * v_.angular)}, d);
  }
  /// (2): replaces p' by K.
  template <class P, class R>
  void subtract_turning(const P& p, R& rate) const {
    if (is_number()) return;
    const auto x = read_rates<S>(f_, p), r = read_rates<S>(f_, rate);
    write_rates<S>(f_, {as<S>(r.linear - cross(x.linear, v_.angular)), as<S>(r.angular - cross(x.angular, v_.angular))},
                   rate);
  }
  /// (3): replaces p0 by the momentum at the midpoint.
  template <class P, class R>
  void to_middle(const R& K, P& p) const {
    const S half = h_ / S(2);
    if (is_number()) return void(p[f_.v] += half * K[f_.v]);
    const auto k = read_rates<S>(f_, K), x = read_rates<S>(f_, p);
    const auto back = as<S>(-phi_), twice = as<S>(S(2) * phi_);
    const auto g = as<S>(x.linear + change_by_turning(back, x.linear) + half * k.linear);
    const auto l0 = as<S>(x.angular + h_ * (k.angular + change_by_turning(phi_, k.angular)));
    const auto l = as<S>(derivative_of_exponential(twice, l0) - half * derivative_of_exponential(back, k.angular));
    write_rates<S>(f_, {g, l}, p);
  }
  /// (4) minus p0.
  template <class P, class R, class Change>
  void change(const R& K, const P& p0, Change& change) const {
    if (is_number()) return void(change[f_.v] = h_ * K[f_.v]);
    const auto k = read_rates<S>(f_, K), x = read_rates<S>(f_, p0);
    const auto back = as<S>(-phi_), twice_back = as<S>(-(S(2) * phi_));
    const auto one = [&](const vec3<S>& p, const vec3<S>& by) {
      return as<S>(change_by_turning(twice_back, p) + h_ * (by + change_by_turning(back, by)));
    };
    write_rates<S>(f_, {one(x.linear, k.linear), one(x.angular, k.angular)}, change);
  }

 private:
  bool is_number() const { return f_.what == kind::gen; }

  const freedom& f_;
  S h_;
  linear_and_angular<S> v_;
  vec3<S> phi_{};
};

/// Converts the rates r of d to those of the configuration, the inverse of `pull_back_one`: w = J(phi) phi', v =
/// exp(-[phi]x) u'.
template <class S, class D, class R>
void push_forward_one(const freedom& f, const D& d, R& r) {
  const auto phi = read_rates<S>(f, d).angular;
  const auto x = read_rates<S>(f, r);
  const auto back = as<S>(-phi);
  write_rates<S>(f, {as<S>(x.linear + change_by_turning(back, x.linear)), derivative_of_exponential(phi, x.angular)},
                 r);
}

}  // namespace kte::detail
