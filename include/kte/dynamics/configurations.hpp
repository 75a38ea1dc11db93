#pragma once

#include <kte/dynamics/configuration_space.hpp>
#include <kte/runtime_chain.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>

/// Interpolation, distance and random sampling of configurations, for static and runtime chains. Rotations are handled
/// on the group, by `integrate` and `difference` of dynamics/configuration_space.hpp.
namespace kte {

/// The configuration at t between q0 (t = 0) and q1 (t = 1), at constant rates:
///
///   q(t) = integrate(q0, difference(q0, q1), t)          (1)
///
/// Numbers move on a line, rotations about one axis by the shorter way, poses on a screw. t may be outside of [0, 1].
template <class Gravity, class... E, indexable Q, class T>
[[nodiscard]] auto interpolate(const static_chain<Gravity, E...>& c, const Q& q0, const Q& q1, const T& t) {
  return integrate(c, q0, difference(c, q0, q1), t);
}
template <indexable Q>
[[nodiscard]] Eigen::VectorXd interpolate(const runtime_chain& c, const Q& q0, const Q& q1, double t) {
  return integrate(c, q0, difference(c, q0, q1), t);
}

namespace detail {
template <class D, class W>
auto weighted_length(const D& d, const W& weight) {
  using S = typename D::Scalar;
  using std::sqrt;
  S sum(0);
  for (Eigen::Index i = 0; i < d.size(); ++i) {
    const S w = S(weight(static_cast<std::size_t>(i)));
    if (!all(w >= S(0))) raise<bad_argument>("kte: the weights of a distance must not be negative");
    sum += w * d[i] * d[i];
  }
  const S length = sqrt(sum);
  check_result(&length, 1, too_large{"a distance"});
  return length;
}
struct weight_of_one {
  constexpr double operator()(std::size_t) const { return 1; }
};
}  // namespace detail

/// The distance of q1 from q0: the root of the sum of w_i d_i^2, with d of `difference` and weights w, a number for
/// each degree of freedom; without weights metres and radians count equally.
template <class Gravity, class... E, indexable Q>
[[nodiscard]] auto distance(const static_chain<Gravity, E...>& c, const Q& q0, const Q& q1) {
  return detail::weighted_length(difference(c, q0, q1), detail::weight_of_one{});
}
template <class Gravity, class... E, indexable Q, indexable W>
[[nodiscard]] auto distance(const static_chain<Gravity, E...>& c, const Q& q0, const Q& q1, const W& weights) {
  check_size<static_chain<Gravity, E...>::dofs>(weights, "weights");
  return detail::weighted_length(difference(c, q0, q1), [&weights](std::size_t i) { return weights[i]; });
}
template <indexable Q>
[[nodiscard]] double distance(const runtime_chain& c, const Q& q0, const Q& q1) {
  return detail::weighted_length(difference(c, q0, q1), detail::weight_of_one{});
}
template <indexable Q, indexable W>
[[nodiscard]] double distance(const runtime_chain& c, const Q& q0, const Q& q1, const W& weights) {
  check_size(static_cast<std::size_t>(c.dofs()), weights, "weights");
  return detail::weighted_length(difference(c, q0, q1), [&weights](std::size_t i) { return weights[i]; });
}

namespace detail {
/// A random rotation, uniform over all rotations (Shoemake, Uniform random rotations, Graphics Gems III, 1992).
template <class Engine, class Out>
void random_rotation(Engine& engine, Out& out, int i) {
  const auto uniform = [&engine] {
    return std::generate_canonical<double, std::numeric_limits<double>::digits>(engine);
  };
  const double u = uniform(), a = 2 * std::numbers::pi * uniform(), b = 2 * std::numbers::pi * uniform();
  const double r = std::sqrt(1 - u), s = std::sqrt(u);
  put_quaternion(out, i, unit_quaternion<double>{s * std::cos(b), r * std::sin(a), r * std::cos(a), s * std::sin(b)});
}
template <class Engine, class Lower, class Upper, class Out>
void random_one(const freedom& f, Engine& engine, const Lower& lower, const Upper& upper, Out& out) {
  const bool turns = f.what == kind::rotation_3D || f.what == kind::pose_3D;
  const int numbers = nq_of(f.what) - (turns ? 4 : 0);
  for (int i = f.q; i < f.q + numbers; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double from = static_cast<double>(lower[k]), to = static_cast<double>(upper[k]);
    if (!(from <= to) || !std::isfinite(from) || !std::isfinite(to))
      raise<bad_argument>("kte: number " + std::to_string(i) + " of q cannot be between " + number(from) + " and " +
                          number(to));
    const double t = std::generate_canonical<double, std::numeric_limits<double>::digits>(engine);
    out[i] = std::lerp(from, to, t);
  }
  if (turns) random_rotation(engine, out, f.q + numbers);
}
}  // namespace detail

/// A configuration of independent random numbers, uniform between `lower` and `upper`, which are laid out as q;
/// rotations in space are uniform over all rotations, and their numbers in both limits are ignored. `engine`: of
/// <random>. Equal engines give equal configurations of static and runtime chains. Throws `bad_argument` for a limit
/// that is not finite, and for lower above upper.
template <class Gravity, class... E, class Engine, indexable Lower, indexable Upper>
auto random_configuration(const static_chain<Gravity, E...>&, Engine& engine, const Lower& lower, const Upper& upper) {
  using wiring = detail::wiring<E...>;
  detail::check_configuration<wiring>(lower), detail::check_configuration<wiring>(upper);
  joint_vector<double, wiring::nq> q;
  for (std::size_t i = 0; i < wiring::freedoms; ++i) detail::random_one(wiring::table.free[i], engine, lower, upper, q);
  return q;
}
template <class Engine, indexable Lower, indexable Upper>
Eigen::VectorXd random_configuration(const runtime_chain& c, Engine& engine, const Lower& lower, const Upper& upper) {
  detail::check_configuration(c.nq(), c.dofs(), lower), detail::check_configuration(c.nq(), c.dofs(), upper);
  Eigen::VectorXd q(c.nq());
  for (const auto& f : c.wiring().free) detail::random_one(f, engine, lower, upper, q);
  return q;
}

}  // namespace kte
