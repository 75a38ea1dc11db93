#pragma once

#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/jacobian.hpp>
#include <kte/dynamics/state_vectors.hpp>
#include <kte/runtime_chain.hpp>

#include <string>
#include <string_view>
#include <vector>

/// Dynamics under external wrenches on frames, by their Jacobians J:
///
///   Q = sum J^T (F, T)          (1)
///
/// The force F, N, and the torque T, Nm, act on the mechanism at the origin of a frame, in its axes. For many loads,
/// the elements `driving_actuator_3D` and `external_force_3D` cost less.
namespace kte {

namespace detail {
/// An argument of type vec3: any kte vector, such as `kte::along_x(1.0)`, or three numbers in braces.
struct any_vector {
  vec3<> numbers{};
  constexpr any_vector() = default;
  constexpr any_vector(double x, double y, double z) : numbers{x, y, z} {}
  template <class X, class Y, class Z>
  constexpr any_vector(const vec3<X, Y, Z>& v)  // NOLINT(google-explicit-constructor)
      : numbers(as<double>(v)) {}
};
}  // namespace detail

/// An external wrench on a frame of a runtime chain: `{"tool", {0, 0, -5}}`, `{"tool", kte::along_z(-5.0)}`. The text
/// or handle must outlive it.
struct external_wrench {
  name_or_handle frame;
  vec3<> force{};   ///< N
  vec3<> torque{};  ///< Nm

  external_wrench(const name_or_handle& on,  // NOLINT(google-explicit-constructor)
                  const detail::any_vector& f = {}, const detail::any_vector& t = {})
      : frame(on), force(f.numbers), torque(t.numbers) {}
};
/// An external wrench on a frame of a static chain, made by `wrench_on(tool, force, torque)`.
template <key_type Frame>
struct wrench_on_frame {
  vec3<> force{};
  vec3<> torque{};
};

/// An external wrench on a frame of a static chain: force, N, and torque, Nm, at its origin, in its axes.
template <key_type Frame>
[[nodiscard]] constexpr wrench_on_frame<Frame> wrench_on(const Frame&, const detail::any_vector& force,
                                                         const detail::any_vector& torque = {}) {
  return {force.numbers, torque.numbers};
}

namespace detail {
/// The six numbers of a wrench, in the order of the rows of J. Throws `bad_argument` if one is not finite.
template <class S, class W>
Eigen::Matrix<S, 6, 1> six_numbers(const W& w, std::string_view frame) {
  const double all[]{w.force.x, w.force.y, w.force.z, w.torque.x, w.torque.y, w.torque.z};
  if (!all_finite(all, 6)) [[unlikely]]
    raise<bad_argument>("kte: an external force or torque on '" + std::string(frame) + "' is not finite");
  Eigen::Matrix<S, 6, 1> x;
  for (int i = 0; i < 6; ++i) x[i] = S(all[i]);
  return x;
}

/// A load on a frame of a runtime chain.
template <class S>
struct load_on_frame {
  runtime_frame frame;
  Eigen::Matrix<S, 6, 1> load;
};
/// Checks all loads before anything is computed.
template <class S>
std::vector<load_on_frame<S>> checked_loads(const runtime_chain& c, const basic_runtime_state<S>& s,
                                            const std::vector<external_wrench>& loads) {
  check_regular(c, s);
  if (!s.tree().readers.empty())
    throw bad_argument("kte: external wrenches on a chain with load-dependent friction must be elements of the chain");
  std::vector<load_on_frame<S>> all;
  for (const auto& w : loads) {
    const auto x = find_frame(c, w.frame);
    const auto& names = c.wiring().names[static_cast<std::size_t>(x.what)];
    all.push_back({x, six_numbers<S>(w, names[static_cast<std::size_t>(x.index)])});
  }
  return all;
}
/// As `external_forces`, for positions that have been checked.
template <class S>
runtime_vector<S> forces_of_loads(const runtime_chain& c, basic_runtime_state<S>& s,
                                  const std::vector<load_on_frame<S>>& loads) {
  runtime_vector<S> sum = runtime_vector<S>::Zero(s.dofs());
  basic_runtime_jacobian<S> j;
  for (const auto& w : loads) {
    put_jacobian(c, s, w.frame, false, j);
    sum += j.transpose() * w.load;
  }
  check_result(sum, static_cast<std::size_t>(sum.size()), diagnose_state{"a force", s});
  return sum;
}
}  // namespace detail

/// The generalized forces of external wrenches, N and Nm: Q of (1). Throws `bad_argument` for chains with
/// load-dependent friction, which is not a function of Q.
template <class S, indexable Q>
runtime_vector<S> external_forces(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q,
                                  const std::vector<external_wrench>& loads) {
  const auto all = detail::checked_loads(c, s, loads);
  return detail::take(c, s, q).call([&] { return detail::forces_of_loads(c, s, all); });
}
/// The generalized forces of external wrenches on a static chain, N and Nm: Q of (1).
template <class Gravity, class... E, indexable Q, key_type... Frames>
[[nodiscard]] auto external_forces(const static_chain<Gravity, E...>& c, const Q& q,
                                   const wrench_on_frame<Frames>&... loads) {
  static_assert(!detail::has_load_dependent_friction<static_chain<Gravity, E...>>,
                "kte: external wrenches on a chain with load-dependent friction must be elements of the chain");
  static_assert(sizeof(detail::check_loads_of<static_chain<Gravity, E...>>) > 0 &&
                sizeof(detail::check_closures_of<static_chain<Gravity, E...>>) > 0);
  using S = value_of<Q>;
  joint_vector<S, static_chain<Gravity, E...>::dofs> sum;
  sum.setZero();
  ((sum += jacobian(c, q, Frames{}).transpose() * detail::six_numbers<S>(loads, Frames::name)), ...);
  detail::check_result(sum, static_cast<std::size_t>(sum.size()), detail::too_large{"a force"});
  return sum;
}

/// `inverse_dynamics` under external wrenches: tau = M a + C v + g - Q of elements - Q of (1).
///
///   inverse_dynamics(arm, s, q, v, a, {{"tool", {0, 0, -5}}})
///   inverse_dynamics(arm, q, v, a, wrench_on(tool, {0, 0, -5}))
template <class S, indexable Q, indexable V, indexable A>
runtime_vector<S> inverse_dynamics(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v,
                                   const A& a, const std::vector<external_wrench>& loads) {
  const auto all = detail::checked_loads(c, s, loads);
  return detail::take(c, s, q, v, a).call([&] {
    const runtime_vector<S> from_outside = detail::forces_of_loads(c, s, all);
    return runtime_vector<S>(inverse_dynamics(c, s) - from_outside);
  });
}
template <class Gravity, class... E, indexable Q, indexable V, indexable A, key_type First, key_type... Frames>
[[nodiscard]] auto inverse_dynamics(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const A& a,
                                    const wrench_on_frame<First>& load, const wrench_on_frame<Frames>&... loads) {
  auto tau = inverse_dynamics(c, q, v, a);
  tau -= external_forces(c, q, load, loads...);
  return tau;
}

/// `forward_dynamics` under external wrenches in addition to tau.
template <class S, indexable Q, indexable V, indexable T>
runtime_vector<S> forward_dynamics(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v,
                                   const T& tau, const std::vector<external_wrench>& loads) {
  const auto checked = detail::checked_loads(c, s, loads);
  detail::check_regular(c, s);
  return detail::take(c, s, q, v, detail::not_given{}, tau).call([&] {
    runtime_vector<S> all = detail::forces_of_loads(c, s, checked);
    for (Eigen::Index i = 0; i < all.size(); ++i) all[i] += static_cast<S>(tau[static_cast<std::size_t>(i)]);
    detail::keep_forces(s, [&all](int i) { return all[i]; });
    return runtime_vector<S>(detail::accelerations_at_state(c, s));
  });
}
template <class Gravity, class... E, indexable Q, indexable V, indexable T, key_type First, key_type... Frames>
[[nodiscard]] auto forward_dynamics(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const T& tau,
                                    const wrench_on_frame<First>& load, const wrench_on_frame<Frames>&... loads) {
  constexpr int n = static_chain<Gravity, E...>::dofs;
  check_size<n>(tau, "tau");
  auto all = external_forces(c, q, load, loads...);
  for (int i = 0; i < n; ++i) all[i] += value_of<Q>(tau[static_cast<std::size_t>(i)]);
  return forward_dynamics(c, q, v, all);
}

}  // namespace kte
