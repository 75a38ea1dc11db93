#ifndef KTE_CONFIGURATION_SPACE_HPP
#define KTE_CONFIGURATION_SPACE_HPP

#include <kte/dynamics/detail/blame.hpp>
#include <kte/dynamics/state_vectors.hpp>
#include <kte/frames/rigid_motion.hpp>
#include <kte/math/dual.hpp>
#include <kte/static_chain/static_chain.hpp>

/// Configurations with rotations are no vectors: these functions take the place of q + dt v and q_1 - q_0, of static
/// and runtime chains. Throw `bad_argument` for arguments of another size or not finite, and for quaternions of length
/// zero.
namespace kte {

namespace detail {
template <class S, class X>
constexpr vec3<S> vector_from(const X& x, std::size_t i) {
  return {S(x[i]), S(x[i + 1]), S(x[i + 2])};
}
template <class S, class X>
constexpr unit_quaternion<S> quaternion_from(const X& x, std::size_t i) {
  return normalized(S(x[i]), S(x[i + 1]), S(x[i + 2]), S(x[i + 3]));
}
/// The pose of a coordinate, at place i of q; a rotation alone has no position, a pose in the plane turns about z.
template <class S, class Q>
constexpr pose<unit_quaternion<S>, vec3<S>> pose_from(kind k, const Q& q, std::size_t i) {
  if (k == kind::rotation_3D) return {quaternion_from<S>(q, i), {}};
  if (k == kind::pose_3D) return {quaternion_from<S>(q, i + 3), vector_from<S>(q, i)};
  return {to_quaternion(vec3<S>{S(0), S(0), S(q[i + 2])}), {S(q[i]), S(q[i + 1]), S(0)}};
}
/// The rates of a coordinate, at place i of v, linear and angular.
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
template <class Out>
void neutral_one(const freedom& f, Out& out) {
  for (int k = 0; k < nq_of(f.what); ++k) out[f.q + k] = 0;
  if (f.what == kind::rotation_3D) out[f.q] = 1;
  if (f.what == kind::pose_3D) out[f.q + 3] = 1;
}
}  // namespace detail

/// The configuration that constant v reaches from q in time dt: q + dt v for numbers; for rotations and poses
///
///   R = R(q) exp [dt w]x,   p = p(q) + R(q) (dt v + ...)          (frames/rigid_motion.hpp)
///
/// exactly, with quaternions of length 1. v in the axes of the moving frames, as everywhere.
template <class Gravity, class... E, indexable Q, indexable V, class T>
auto integrate(const static_chain<Gravity, E...>&, const Q& q, const V& v, const T& dt) {
  using wiring = detail::wiring<E...>;
  using S = value_of<Q>;
  detail::check_configuration<wiring>(q), check_size<wiring::dofs>(v, "v");
  joint_vector<S, wiring::nq> out;
  for (std::size_t i = 0; i < wiring::freedoms; ++i) detail::integrate_one<S>(wiring::table.free[i], q, v, S(dt), out);
  detail::check_result(out, std::size_t{wiring::nq}, [&] {
    detail::raise_if_time_is_endless("a coordinate", dt);
    detail::blame<wiring>("a coordinate", detail::each<S, Q>{q}, detail::each<S, V>{v}, detail::same<zero_t>{}, "a");
  });
  return out;
}

/// The rates of the numbers of q where the chain moves by v: v itself for numbers; R v for positions, q (0, w/2) for
/// quaternions q. For methods that know vectors only; the lengths of quaternions then drift.
template <class Gravity, class... E, indexable Q, indexable V>
auto configuration_rate(const static_chain<Gravity, E...>&, const Q& q, const V& v) {
  using wiring = detail::wiring<E...>;
  using S = value_of<Q>;
  detail::check_configuration<wiring>(q), check_size<wiring::dofs>(v, "v");
  std::array<S, std::size_t{wiring::nq} + 1> out;
  for (std::size_t i = 0; i < wiring::freedoms; ++i) detail::rate_of_one<S>(wiring::table.free[i], q, v, out);
  detail::check_result(out, std::size_t{wiring::nq}, [&] {
    detail::blame<wiring>("a rate", detail::each<S, Q>{q}, detail::each<S, V>{v}, detail::same<zero_t>{}, "a");
  });
  return joint_vector<S, wiring::nq>(Eigen::Map<const joint_vector<S, wiring::nq>>(out.data()));
}

/// The v by which `integrate` gets from one configuration to another in unit time; rotations take the shorter way. In
/// the plane the angle is in [-pi, pi].
template <class Gravity, class... E, indexable Q>
auto difference(const static_chain<Gravity, E...>&, const Q& from, const Q& to) {
  using wiring = detail::wiring<E...>;
  using S = value_of<Q>;
  detail::check_configuration<wiring>(from), detail::check_configuration<wiring>(to);
  joint_vector<S, wiring::dofs> out;
  for (std::size_t i = 0; i < wiring::freedoms; ++i) detail::difference_one<S>(wiring::table.free[i], from, to, out);
  detail::check_result(out, std::size_t{wiring::dofs}, [&] {
    detail::blame_configurations<wiring>("a coordinate", detail::each<S, Q>{from}, detail::each<S, Q>{to});
  });
  return out;
}

/// All numbers 0, all rotations none.
template <class S = double, class Gravity, class... E>
auto neutral_configuration(const static_chain<Gravity, E...>&) {
  using wiring = detail::wiring<E...>;
  joint_vector<S, wiring::nq> out;
  for (std::size_t i = 0; i < wiring::freedoms; ++i) detail::neutral_one(wiring::table.free[i], out);
  return out;
}

namespace detail {
/// A configuration that moves by v: its numbers with their rates, for derivatives along the motion.
template <class Chain, class Q, class V>
auto moving_along(const Chain& c, const Q& q, const V& v) {
  using S = value_of<Q>;
  const auto q_dot = configuration_rate(c, q, v);
  std::array<dual<S, 1>, std::size_t{Chain::nq}> moving;
  for (std::size_t i = 0; i < moving.size(); ++i) {
    moving[i] = dual<S, 1>(S(q[i]));
    moving[i].derivative[0] = q_dot[static_cast<Eigen::Index>(i)];
  }
  return moving;
}
}  // namespace detail

}  // namespace kte

#endif

// ---- of runtime chains (kte/dynamics/runtime_parts.hpp)

#if defined(KTE_RUNTIME_CHAINS) && !defined(KTE_CONFIGURATION_SPACE_OF_RUNTIME_CHAINS)
#define KTE_CONFIGURATION_SPACE_OF_RUNTIME_CHAINS

#include <kte/runtime_chain/layout.hpp>

namespace kte {

template <indexable Q, indexable V>
Eigen::VectorXd integrate(const kte_map_chain& c, const Q& q, const V& v, double dt) {
  detail::check_configuration(c.nq(), c.dofs(), q), check_size(static_cast<std::size_t>(c.dofs()), v, "v");
  Eigen::VectorXd out(c.nq());
  for (const auto& f : c.wiring().free) detail::integrate_one<double>(f, q, v, dt, out);
  const auto nq = static_cast<std::size_t>(c.nq()), nv = static_cast<std::size_t>(c.dofs());
  detail::check_result(out, nq, [&] {
    const auto from = detail::plain_numbers(q, nq), rates = detail::plain_numbers(v, nv);
    detail::raise_if_time_is_endless("a coordinate", dt);
    detail::raise_if_no_rotation(layout(c), from);
    detail::raise_not_finite("a coordinate", layout(c), {{"q", from, true}, {"v", rates}});
  });
  return out;
}
template <indexable Q>
Eigen::VectorXd difference(const kte_map_chain& c, const Q& from, const Q& to) {
  detail::check_configuration(c.nq(), c.dofs(), from), detail::check_configuration(c.nq(), c.dofs(), to);
  Eigen::VectorXd out(c.dofs());
  for (const auto& f : c.wiring().free) detail::difference_one<double>(f, from, to, out);
  detail::check_result(out, static_cast<std::size_t>(c.dofs()), [&] {
    const auto n = static_cast<std::size_t>(c.nq());
    const auto a = detail::plain_numbers(from, n), b = detail::plain_numbers(to, n);
    detail::raise_if_no_rotation(layout(c), a), detail::raise_if_no_rotation(layout(c), b);
    detail::raise_not_finite("a coordinate", layout(c), {{"from", a, true}, {"to", b, true}});
  });
  return out;
}
inline Eigen::VectorXd neutral_configuration(const kte_map_chain& c) {
  Eigen::VectorXd out(c.nq());
  for (const auto& f : c.wiring().free) detail::neutral_one(f, out);
  return out;
}

}  // namespace kte

#endif
