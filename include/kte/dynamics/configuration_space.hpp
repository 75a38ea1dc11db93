#ifndef KTE_CONFIGURATION_SPACE_HPP
#define KTE_CONFIGURATION_SPACE_HPP

#include <kte/dynamics/arguments/coordinate_motion.hpp>
#include <kte/dynamics/arguments/diagnose.hpp>
#include <kte/dynamics/state_vectors.hpp>
#include <kte/math/dual.hpp>
#include <kte/static_chain/static_chain.hpp>

/// Configurations with rotations are not vectors. These functions replace q + dt v and q_1 - q_0 for static and runtime
/// chains. They throw `bad_argument` for arguments of wrong size, numbers that are not finite, and quaternions of
/// length zero.
namespace kte {

/// The configuration after time dt, s, from q at constant v: q + dt v for numbers; for rotations and poses
///
///   R = R(q) exp [dt w]x,   p = p(q) + R(q) (dt v + ...)          (frames/rigid_motion.hpp)
///
/// exactly, with quaternions of length 1. v is in axes of the moving frames.
template <class Gravity, class... E, indexable Q, indexable V, class T>
auto integrate(const static_chain<Gravity, E...>&, const Q& q, const V& v, const T& dt) {
  using wiring = detail::wiring<E...>;
  using S = value_of<Q>;
  detail::check_configuration<wiring>(q), check_size<wiring::dofs>(v, "v");
  joint_vector<S, wiring::nq> out;
  for (std::size_t i = 0; i < wiring::freedoms; ++i) detail::integrate_one<S>(wiring::table.free[i], q, v, S(dt), out);
  detail::check_result(out, std::size_t{wiring::nq}, [&] {
    detail::raise_if_time_is_non_finite("a coordinate", dt);
    detail::diagnose<wiring>("a coordinate", detail::each<S, Q>{q}, detail::each<S, V>{v}, detail::same<zero_t>{}, "a");
  });
  return out;
}

/// The time derivatives of the numbers of q at the velocities v: v itself for numbers; R v for positions, q (0, w/2)
/// for quaternions q. Use it with integrators that only accept vectors; the lengths of quaternions then drift.
template <class Gravity, class... E, indexable Q, indexable V>
[[nodiscard]] auto configuration_rate(const static_chain<Gravity, E...>&, const Q& q, const V& v) {
  using wiring = detail::wiring<E...>;
  using S = value_of<Q>;
  detail::check_configuration<wiring>(q), check_size<wiring::dofs>(v, "v");
  std::array<S, std::size_t{wiring::nq} + 1> out;
  for (std::size_t i = 0; i < wiring::freedoms; ++i) detail::rate_of_one<S>(wiring::table.free[i], q, v, out);
  detail::check_result(out, std::size_t{wiring::nq}, [&] {
    detail::diagnose<wiring>("a rate", detail::each<S, Q>{q}, detail::each<S, V>{v}, detail::same<zero_t>{}, "a");
  });
  return joint_vector<S, wiring::nq>(Eigen::Map<const joint_vector<S, wiring::nq>>(out.data()));
}

/// The velocity v with which `integrate` goes from one configuration to another in unit time; rotations take the
/// shorter way. In the plane the angle is in [-pi, pi].
template <class Gravity, class... E, indexable Q>
[[nodiscard]] auto difference(const static_chain<Gravity, E...>&, const Q& from, const Q& to) {
  using wiring = detail::wiring<E...>;
  using S = value_of<Q>;
  detail::check_configuration<wiring>(from), detail::check_configuration<wiring>(to);
  joint_vector<S, wiring::dofs> out;
  for (std::size_t i = 0; i < wiring::freedoms; ++i) detail::difference_one<S>(wiring::table.free[i], from, to, out);
  detail::check_result(out, std::size_t{wiring::dofs}, [&] {
    detail::diagnose_configurations<wiring>("a coordinate", detail::each<S, Q>{from}, detail::each<S, Q>{to});
  });
  return out;
}

/// The configuration with all numbers 0 and all rotations the identity.
template <class S = double, class Gravity, class... E>
[[nodiscard]] auto neutral_configuration(const static_chain<Gravity, E...>&) {
  using wiring = detail::wiring<E...>;
  joint_vector<S, wiring::nq> out;
  for (std::size_t i = 0; i < wiring::freedoms; ++i) detail::neutral_one(wiring::table.free[i], out);
  return out;
}

namespace detail {
/// A configuration as numbers with their rates at v, for derivatives along the motion.
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

// ---- of runtime chains (kte/runtime_chain.hpp)

#if defined(KTE_RUNTIME_CHAINS) && !defined(KTE_CONFIGURATION_SPACE_OF_RUNTIME_CHAINS)
#define KTE_CONFIGURATION_SPACE_OF_RUNTIME_CHAINS

#include <kte/runtime_chain/layout.hpp>

namespace kte {

template <indexable Q, indexable V>
Eigen::VectorXd integrate(const runtime_chain& c, const Q& q, const V& v, double dt) {
  detail::check_configuration(c.nq(), c.dofs(), q), check_size(static_cast<std::size_t>(c.dofs()), v, "v");
  Eigen::VectorXd out(c.nq());
  for (const auto& f : c.wiring().free) detail::integrate_one<double>(f, q, v, dt, out);
  const auto nq = static_cast<std::size_t>(c.nq()), nv = static_cast<std::size_t>(c.dofs());
  detail::check_result(out, nq, [&] {
    const auto from = detail::plain_numbers(q, nq), rates = detail::plain_numbers(v, nv);
    detail::raise_if_time_is_non_finite("a coordinate", dt);
    detail::raise_if_no_rotation(layout(c), from);
    detail::raise_not_finite("a coordinate", layout(c), {{"q", from, true}, {"v", rates}});
  });
  return out;
}
template <indexable Q>
[[nodiscard]] Eigen::VectorXd difference(const runtime_chain& c, const Q& from, const Q& to) {
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
[[nodiscard]] inline Eigen::VectorXd neutral_configuration(const runtime_chain& c) {
  Eigen::VectorXd out(c.nq());
  for (const auto& f : c.wiring().free) detail::neutral_one(f, out);
  return out;
}

}  // namespace kte

#endif
