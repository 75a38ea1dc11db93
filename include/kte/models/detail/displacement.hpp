#pragma once

#include <kte/dynamics/configuration_space.hpp>
#include <kte/static_chain/wiring.hpp>

/// Configurations as displacements from another configuration, for integrators (integrators/motion_space.hpp). For a
/// coordinate with a rotation R and a position p, and d = (u, phi):
///
///   R(d) = R exp [phi]x,   p(d) = p + R u                                                  (1)
///   phi' = w + phi x w / 2 + D phi x (phi x w),   D = (1 - t/2 cot(t/2))/t^2, t = |phi|    (2)
///   u' = exp([phi]x) v                                                                     (3)
///
/// v and w are in axes of the moving frame. By (3), u' is constant for a body in free flight. (2) is the inverse of the
/// derivative of the exponential, which is singular where a step rotates by 2 pi. For numbers q(d) = q + d, d' = v.
namespace kte::detail {

template <class S, class Q, class D, class Out>
void displace_one(const freedom& f, const Q& q, const D& d, Out& out) {
  const auto i = static_cast<std::size_t>(f.q), j = static_cast<std::size_t>(f.v);
  if (f.what == kind::gen) {
    out[f.q] = S(q[i]) + S(d[j]);
    return;
  }
  const auto from = pose_from<S>(f.what, q, i);
  const auto [u, phi] = rates_from<S>(f.what, d, j);
  if (f.what == kind::pose_2D) {
    const auto p = as<S>(from.position + from.rotation * u);
    out[f.q] = p.x, out[f.q + 1] = p.y, out[f.q + 2] = S(q[i + 2]) + phi.z;
    return;
  }
  const bool with_position = f.what == kind::pose_3D;
  if (with_position) put_vector(out, f.q, as<S>(from.position + from.rotation * u));
  put_quaternion(out, with_position ? f.q + 3 : f.q, from.rotation * to_quaternion(phi));
}

/// The quaternion of a rotation vector minus 1, with full relative accuracy.
template <class S>
unit_quaternion<S> quaternion_less_one(const vec3<S>& phi) {
  const S tt = dot(phi, phi), half = S(1) / S(2);
  const bool tiny = tt * tt * tt < S(std::numeric_limits<S>::epsilon());
  const auto c = tiny ? unit_quaternion<S>{} : to_quaternion(phi);
  const S w = tiny ? S(S(1) - tt / S(8)) : c.w;
  const auto v = tiny ? vec3<S>((half - tt / S(48) * (S(1) - tt / S(80))) * phi) : vec3<S>{c.x, c.y, c.z};
  return {-dot(v, v) / (S(1) + w), v.x, v.y, v.z};
}
/// The part of d that was lost when q(d) was rounded to `to`, for the displacement from there. With the quaternions a,
/// b of both configurations and c of phi, up to the component along b, which is the length error:
///
///   2 Im(b* ((a - b) + a (c - 1))),   R_b^T ((p - p_b) + R u)          (4)
template <class S, class Q, class D, class To, class Rest>
void rounding_of_one(const freedom& f, const Q& q, const D& d, const To& to, Rest& rest) {
  const auto i = static_cast<std::size_t>(f.q), j = static_cast<std::size_t>(f.v);
  if (f.what == kind::gen) {
    rest[f.v] = S(d[j]) - (S(to[i]) - S(q[i]));
    return;
  }
  const auto [u, phi] = rates_from<S>(f.what, d, j);
  const bool turns_only = f.what == kind::rotation_3D;
  if (!turns_only) {
    const auto from = pose_from<S>(f.what, q, i), end = pose_from<S>(f.what, to, i);
    const auto lost = as<S>(conjugate(end.rotation) * ((from.position - end.position) + from.rotation * u));
    rest[f.v] = lost.x, rest[f.v + 1] = lost.y;
    if (f.what == kind::pose_2D) {
      rest[f.v + 2] = phi.z - (S(to[i + 2]) - S(q[i + 2]));
      return;
    }
    rest[f.v + 2] = lost.z;
  }
  const std::size_t k = turns_only ? i : i + 3;
  // Used as rounded: normalizing it would round it again. Quaternions of users may have any length.
  const unit_quaternion<S> given{S(q[k]), S(q[k + 1]), S(q[k + 2]), S(q[k + 3])};
  const S square = given.w * given.w + given.x * given.x + given.y * given.y + given.z * given.z;
  const bool is_unit = square < S(1.001) && square > S(0.999);
  const auto a = is_unit ? given : quaternion_from<S>(q, k);
  const unit_quaternion<S> b{S(to[k]), S(to[k + 1]), S(to[k + 2]), S(to[k + 3])};
  const auto e = a * quaternion_less_one(phi);
  const auto r =
      conjugate(b) * unit_quaternion<S>{(a.w - b.w) + e.w, (a.x - b.x) + e.x, (a.y - b.y) + e.y, (a.z - b.z) + e.z};
  put_vector(rest, turns_only ? f.v : f.v + 3, as<S>(S(2) * vec3<S>{r.x, r.y, r.z}));
}

/// (2) and (3): converts the rates r to those of d.
template <class S, class D, class R>
void pull_back_one(const freedom& f, const D& d, R& r) {
  if (f.what == kind::gen) return;
  const auto j = static_cast<std::size_t>(f.v);
  const auto phi = rates_from<S>(f.what, d, j).second;
  const auto [v, w] = rates_from<S>(f.what, r, j);
  if (f.what == kind::pose_2D) {
    const auto u = as<S>(to_quaternion(phi) * v);
    r[f.v] = u.x, r[f.v + 1] = u.y;
    return;
  }
  const bool with_position = f.what == kind::pose_3D;
  if (with_position) put_vector(r, f.v, as<S>(to_quaternion(phi) * v));  // (3)
  const auto turned = cross(phi, w);
  const S half = S(1) / S(2);
  put_vector(r, with_position ? f.v + 3 : f.v,
             as<S>(w + half * turned + unturned_shift(dot(phi, phi)) * cross(phi, turned)));  // (2)
}

/// Adds to J the derivative of (2) and (3) by d at d = 0, at rates r: -[v]x and -[w]x / 2.
template <class S, class R, class J>
void add_variation_of_pull_back(const freedom& f, const R& r, J& jacobian) {
  if (f.what == kind::gen) return;
  const auto [v, w] = rates_from<S>(f.what, r, static_cast<std::size_t>(f.v));
  if (f.what == kind::pose_2D) {
    jacobian(f.v, f.v + 2) -= v.y, jacobian(f.v + 1, f.v + 2) += v.x;
    return;
  }
  const auto subtract_cross = [&jacobian](int i, int j, const vec3<S>& x) {
    jacobian(i, j + 1) += x.z, jacobian(i, j + 2) -= x.y;
    jacobian(i + 1, j) -= x.z, jacobian(i + 1, j + 2) += x.x;
    jacobian(i + 2, j) += x.y, jacobian(i + 2, j + 1) -= x.x;
  };
  const int turning = f.what == kind::pose_3D ? f.v + 3 : f.v;
  if (f.what == kind::pose_3D) subtract_cross(f.v, turning, v);
  const S half = S(1) / S(2);
  subtract_cross(turning, turning, as<S>(half * w));
}

/// d from one configuration to another; rotations take the shorter way.
template <class S, class Q, class D>
void displacement_between(const freedom& f, const Q& from, const Q& to, D& d) {
  const auto i = static_cast<std::size_t>(f.q);
  if (f.what == kind::gen) {
    d[f.v] = S(to[i]) - S(from[i]);
    return;
  }
  const auto a = pose_from<S>(f.what, from, i), b = pose_from<S>(f.what, to, i);
  const auto back = conjugate(a.rotation);
  const auto u = as<S>(back * (b.position - a.position));
  if (f.what == kind::pose_2D) {
    d[f.v] = u.x, d[f.v + 1] = u.y, d[f.v + 2] = S(to[i + 2]) - S(from[i + 2]);
    return;
  }
  if (f.what == kind::pose_3D) put_vector(d, f.v, u);
  put_vector(d, f.what == kind::pose_3D ? f.v + 3 : f.v, to_rotation_vector(back * b.rotation));
}

}  // namespace kte::detail
