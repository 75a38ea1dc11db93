#pragma once

#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/detail/refused_calls.hpp>
#include <kte/dynamics/detail/runtime_algorithms.hpp>
#include <kte/runtime_chain/layout.hpp>
#include <kte/tree/jacobian.hpp>

/// The algorithms on runtime chains, under the names they have on static chains. They work in the memory of a state and
/// return references into it, valid until the next call with that state; they allocate nothing, but for what is as
/// large as M, for which the first call that gives it makes room. A call that refuses leaves the positions, velocities
/// and accelerations of the state as they were, unless what it refuses are signals or bases that the state has.
namespace kte {

/// Inverse dynamics (RNEA) at the state's positions, rates and accelerations. As `inverse_dynamics` on a static chain.
template <class S>
const runtime_vector<S>& inverse_dynamics(const kte_map_chain& c, basic_runtime_state<S>& s) {
  detail::coordinate_forces(c, s);
  detail::take_needed_forces(s);
  detail::check_result(s.work.forces, static_cast<std::size_t>(s.dofs()), [&s] { detail::blame("a force", s); });
  return s.work.forces;
}
/// The same at q, v, a, which are put into the state.
template <class S, indexable Q, indexable V, indexable A>
const runtime_vector<S>& inverse_dynamics(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v,
                                          const A& a) {
  return detail::take<detail::keeping::if_needed>(c, s, q, v, a).call([&]() -> const auto& {
    return inverse_dynamics(c, s);
  });
}

/// The mass matrix at the state's positions (CRBA). As `mass_matrix` on a static chain.
template <class S>
const runtime_matrix<S>& mass_matrix(const kte_map_chain& c, basic_runtime_state<S>& s) {
  detail::check_regular(c, s);
  detail::check_positions(s);
  detail::mass_of_coordinates(detail::runtime_elements{c}, s);
  detail::check_masses(s, s.work.mass);
  return s.work.mass;
}
/// The same at q, which is put into the state.
template <class S, indexable Q>
const runtime_matrix<S>& mass_matrix(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q) {
  detail::check_regular(c, s);
  return detail::take<detail::keeping::if_needed>(c, s, q).call([&]() -> const auto& {
    detail::mass_of_coordinates(detail::runtime_elements{c}, s);
    detail::check_masses(s, s.work.mass);
    return s.work.mass;
  });
}

/// Forward dynamics at the state's positions and rates under its inputs, as on a static chain. The accelerations are
/// also put into the coordinates of the state.
template <class S>
const runtime_vector<S>& forward_dynamics(const kte_map_chain& c, basic_runtime_state<S>& s) {
  detail::check_regular(c, s);
  detail::check_positions(s);
  return detail::accelerations_under(c, s, [](int) { return S(0); });
}
/// The same at q, v, which are put into the state, under forces tau besides those of the chain's elements.
template <class S, indexable Q, indexable V, indexable T>
const runtime_vector<S>& forward_dynamics(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v,
                                          const T& tau) {
  detail::check_regular(c, s);
  return detail::take(c, s, q, v, detail::not_given{}, tau).call([&]() -> const auto& {
    return detail::accelerations_under(c, s, [&](int i) { return static_cast<S>(tau[static_cast<std::size_t>(i)]); });
  });
}

namespace detail {
/// At positions that are good.
template <class S>
pose<mat3<vec3<S>>, vec3<S>> pose_of(const kte_map_chain& c, basic_runtime_state<S>& s, const runtime_frame& x) {
  const auto& f = s.tree().forest;
  const auto& place = f.frame(x.what, x.index);
  if constexpr (std::is_same_v<S, double>)
    if (s.tree().moves_unknown || place.slot < 0) [[unlikely]] {
      move(c.wiring(), s, x);
      return with_motion(s, x, [](const auto& m) { return plain_pose<S>(m); });
    }
  if constexpr (!std::is_same_v<S, double>) refuse_following(c, s, x);
  place_ancestors(runtime_elements{c}, s, place.slot);
  tree::dense_pose<S> seen;
  const int base = tree::pose_in_base(f, s.work, place, seen);
  tree::dense_pose<S> in_world = seen;
  for_each_base(s, [&](const auto& m, std::size_t slot) {
    if (static_cast<int>(slot) == base) in_world = compose(plain_pose<S>(m), seen);
  });
  return in_world;
}
/// Throws `bad_argument` where a frame stands nowhere: signals and bases in the state may be no numbers.
template <class S, class Pose>
const Pose& checked_pose(const basic_runtime_state<S>& s, const Pose& m, kind k, int frame) {
  const auto r = matrix(m.rotation);
  const S numbers[]{as<S>(m.position.x),  as<S>(m.position.y),  as<S>(m.position.z),
                    as<S>(dot(r.x, r.x)), as<S>(dot(r.y, r.y)), as<S>(dot(r.z, r.z))};
  check_result(numbers, 6, [&] {
    const std::string& name = s.made_for()->names[static_cast<std::size_t>(k)][static_cast<std::size_t>(frame)];
    blame(("where frame '" + name + "' stands").c_str(), s);
  });
  return m;
}
}  // namespace detail

/// Where a frame stands at the state's positions, in the axes in which the bases are given. Only the elements between
/// the bases and the frame are evaluated. A 2D frame is given as one in space. Throws `unknown_name`.
template <class S>
pose<mat3<vec3<S>>, vec3<S>> forward_kinematics(const kte_map_chain& c, basic_runtime_state<S>& s,
                                                const name_or_handle& frame) {
  c.check(s);
  const auto x = detail::find_frame(c, frame);
  detail::check_positions(s);
  return detail::checked_pose(s, detail::pose_of(c, s, x), x.what, x.index);
}
/// The same at q, which is put into the state.
template <class S, indexable Q>
pose<mat3<vec3<S>>, vec3<S>> forward_kinematics(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q,
                                                const name_or_handle& frame) {
  const auto x = detail::find_frame(c, frame);
  return detail::take<detail::keeping::if_needed>(c, s, q).call(
      [&] { return detail::checked_pose(s, detail::pose_of(c, s, x), x.what, x.index); });
}

/// As on static chains (dynamics/configuration_space.hpp).
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

#ifdef KTE_EXTERN
KTE_EXTERN template const runtime_vector<double>& inverse_dynamics(const kte_map_chain&, runtime_state&);
KTE_EXTERN template const runtime_matrix<double>& mass_matrix(const kte_map_chain&, runtime_state&);
KTE_EXTERN template const runtime_vector<double>& forward_dynamics(const kte_map_chain&, runtime_state&);
namespace detail {
KTE_EXTERN template pose<mat3<vec3<>>, vec3<>> pose_of(const kte_map_chain&, runtime_state&, const runtime_frame&);
}
#endif

}  // namespace kte
