#pragma once

#include <kte/dynamics/arguments/diagnose.hpp>
#include <kte/frames/rigid_motion.hpp>

/// The pose and rates of one coordinate: a number, a rotation, or a pose.
namespace kte::detail {

template <class S, class X>
constexpr vec3<S> vector_from(const X& x, std::size_t i) {
  return {S(x[i]), S(x[i + 1]), S(x[i + 2])};
}
template <class S, class X>
constexpr unit_quaternion<S> quaternion_from(const X& x, std::size_t i) {
  return normalized(S(x[i]), S(x[i + 1]), S(x[i + 2]), S(x[i + 3]));
}
/// The pose of a coordinate, from index i of q. A rotation has position zero; a planar pose rotates about z.
template <class S, class Q>
constexpr pose<unit_quaternion<S>, vec3<S>> pose_from(kind k, const Q& q, std::size_t i) {
  if (k == kind::rotation_3D) return {quaternion_from<S>(q, i), {}};
  if (k == kind::pose_3D) return {quaternion_from<S>(q, i + 3), vector_from<S>(q, i)};
  return {to_quaternion(vec3<S>{S(0), S(0), S(q[i + 2])}), {S(q[i]), S(q[i + 1]), S(0)}};
}
/// The rates of a coordinate, from index i of v, linear and angular.
template <class S, class V>
constexpr std::pair<vec3<S>, vec3<S>> rates_from(kind k, const V& v, std::size_t i) {
  if (k == kind::rotation_3D) return {{}, vector_from<S>(v, i)};
  if (k == kind::pose_3D) return {vector_from<S>(v, i), vector_from<S>(v, i + 3)};
  return {{S(v[i]), S(v[i + 1]), S(0)}, {S(0), S(0), S(v[i + 2])}};
}
template <class X, class S>
constexpr void put_vector(X& x, int i, const vec3<S>& v) {
  x[i] = v.x, x[i + 1] = v.y, x[i + 2] = v.z;
}
template <class X, class S>
constexpr void put_quaternion(X& x, int i, const unit_quaternion<S>& r) {
  const auto n = normalized(r.w, r.x, r.y, r.z);
  x[i] = n.w, x[i + 1] = n.x, x[i + 2] = n.y, x[i + 3] = n.z;
}

template <class S, class Q, class V, class Out>
void integrate_one(const freedom& f, const Q& q, const V& v, const S& dt, Out& out) {
  const auto i = static_cast<std::size_t>(f.q), j = static_cast<std::size_t>(f.v);
  if (f.what == kind::gen) {
    out[f.q] = S(q[i]) + dt * S(v[j]);
    return;
  }
  const auto from = pose_from<S>(f.what, q, i);
  const auto [linear, angular] = rates_from<S>(f.what, v, j);
  const auto step = exponential(as<S>(dt * linear), as<S>(dt * angular));
  const auto r = from.rotation * step.rotation;
  const auto p = as<S>(from.position + from.rotation * step.position);
  if (f.what == kind::rotation_3D) {
    put_quaternion(out, f.q, r);
  } else if (f.what == kind::pose_3D) {
    put_vector(out, f.q, p), put_quaternion(out, f.q + 3, r);
  } else {
    out[f.q] = p.x, out[f.q + 1] = p.y, out[f.q + 2] = S(q[i + 2]) + dt * S(v[j + 2]);
  }
}
template <class S, class Q, class Out>
void difference_one(const freedom& f, const Q& from, const Q& to, Out& out) {
  const auto i = static_cast<std::size_t>(f.q);
  if (f.what == kind::gen) {
    out[f.v] = S(to[i]) - S(from[i]);
    return;
  }
  const auto a = pose_from<S>(f.what, from, i), b = pose_from<S>(f.what, to, i);
  const auto back = conjugate(a.rotation);
  auto rotation = back * b.rotation;
  const auto position = as<S>(back * (b.position - a.position));
  const auto [linear, angular] = logarithm(pose<unit_quaternion<S>, vec3<S>>{rotation, position});
  if (f.what == kind::rotation_3D) {
    put_vector(out, f.v, angular);
  } else if (f.what == kind::pose_3D) {
    put_vector(out, f.v, linear), put_vector(out, f.v + 3, angular);
  } else {
    out[f.v] = linear.x, out[f.v + 1] = linear.y, out[f.v + 2] = angular.z;
  }
}
template <class S, class Q, class V, class Out>
void rate_of_one(const freedom& f, const Q& q, const V& v, Out& out) {
  const auto i = static_cast<std::size_t>(f.q), j = static_cast<std::size_t>(f.v);
  if (f.what == kind::gen) {
    out[i] = S(v[j]);
    return;
  }
  const auto [linear, angular] = rates_from<S>(f.what, v, j);
  std::size_t r = i;  // of the rotation
  if (f.what != kind::rotation_3D) {
    const auto p = as<S>(pose_from<S>(f.what, q, i).rotation * linear);
    out[i] = p.x, out[i + 1] = p.y;
    if (f.what == kind::pose_2D) {
      out[i + 2] = angular.z;
      return;
    }
    out[i + 2] = p.z;
    r += 3;
  }
  const S half = S(1) / S(2);
  const auto d = unit_quaternion<S>{S(q[r]), S(q[r + 1]), S(q[r + 2]), S(q[r + 3])} *
                 unit_quaternion<S>{S(0), half * angular.x, half * angular.y, half * angular.z};
  out[r] = d.w, out[r + 1] = d.x, out[r + 2] = d.y, out[r + 3] = d.z;
}
/// v of a rate of the numbers of q, without the change of the length of quaternions: the inverse of `rate_of_one`.
template <class S, class Q, class R, class Out>
void velocity_of_one(const freedom& f, const Q& q, const R& rate, Out& out) {
  const auto i = static_cast<std::size_t>(f.q);
  if (f.what == kind::gen) {
    out[f.v] = S(rate[i]);
    return;
  }
  std::size_t r = i;  // of the rotation
  int angular = f.v;
  if (f.what != kind::rotation_3D) {
    const bool in_plane = f.what == kind::pose_2D;
    const vec3<S> moved{S(rate[i]), S(rate[i + 1]), in_plane ? S(0) : S(rate[i + 2])};
    const auto p = as<S>(conjugate(pose_from<S>(f.what, q, i).rotation) * moved);
    out[f.v] = p.x, out[f.v + 1] = p.y;
    if (in_plane) {
      out[f.v + 2] = S(rate[i + 2]);
      return;
    }
    out[f.v + 2] = p.z;
    r += 3, angular += 3;
  }
  const unit_quaternion<S> a{S(q[r]), S(q[r + 1]), S(q[r + 2]), S(q[r + 3])};
  const auto d = conjugate(a) * unit_quaternion<S>{S(rate[r]), S(rate[r + 1]), S(rate[r + 2]), S(rate[r + 3])};
  const S twice = S(2) / (a.w * a.w + a.x * a.x + a.y * a.y + a.z * a.z);
  put_vector(out, angular, vec3<S>{twice * d.x, twice * d.y, twice * d.z});
}
/// The sizes of the numbers of a configuration, per number of a displacement: lengths those of the position, angles 1
/// rad.
template <class S, class Q, class M>
void magnitudes_of(const freedom& f, const Q& q, M& m) {
  const auto i = static_cast<std::size_t>(f.q);
  if (f.what == kind::gen) {
    m[f.v] = S(q[i]);
    return;
  }
  for (int k = 0; k < nv_of(f.what); ++k) m[f.v + k] = S(1);
  if (f.what == kind::rotation_3D) return;
  using std::sqrt;
  const auto p = pose_from<S>(f.what, q, i).position;
  const S length = sqrt(dot(p, p));
  for (int k = 0; k < (f.what == kind::pose_2D ? 2 : 3); ++k) m[f.v + k] = length;
}

template <class Out>
void neutral_one(const freedom& f, Out& out) {
  for (int k = 0; k < nq_of(f.what); ++k) out[f.q + k] = 0;
  if (f.what == kind::rotation_3D) out[f.q] = 1;
  if (f.what == kind::pose_3D) out[f.q + 3] = 1;
}

}  // namespace kte::detail
