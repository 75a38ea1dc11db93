#ifndef KTE_CENTROIDAL_HPP
#define KTE_CENTROIDAL_HPP

#include <kte/dynamics/unrolled/momentum_columns.hpp>

namespace kte {

/// The momentum of all bodies, kg m/s, and their angular momentum about their centre of mass c, kg m^2/s, in axes of
/// the base, with bases at rest. Momenta are transmitted from the tips to the base as forces are:
///
///   p = sum p_i,  k_G = k_0 - c x p          (1)
///
/// Runtime chains: `centroidal_momentum(c, s, q, v)` or `(c, s)`. Arguments and errors as for `centre_of_mass`.
template <class Gravity, class... E, indexable Q, indexable V>
[[nodiscard]] auto centroidal_momentum(const static_chain<Gravity, E...>& c, const Q& q, const V& v) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  static_assert(sizeof(detail::check_bodies_of<chain_type>) > 0);
  const auto x = checked_arguments<chain_type>(q, v);
  const auto w = weight_of<S>(c, x.at);
  const auto h = momentum_at_base<S>(c, x.at, x.v);
  const auto why = x.diagnosis("a momentum");
  return checked<S>(h.force, h.torque - cross(divided_by_mass<S>(w.mass, w.moment, why), h.force), why);
}

/// The centroidal momentum matrix A_G, 6 x dofs, linear rows first: centroidal_momentum = A_G(q) v (Orin, Goswami, Lee,
/// Autonomous Robots 35, 2013, section 3). The column of a joint with the axis s is
///
///   X I^c s          (2)
///
/// with the composite inertia I^c of the subtree of the joint, and the transform X of a momentum, as of a wrench, from
/// the end of the joint to the centre of mass, in axes of the base. Runtime chains: `centroidal_momentum_matrix(c, s,
/// q)` or `(c, s)`, a value, for which memory is allocated.
template <class Gravity, class... E, indexable Q>
[[nodiscard]] auto centroidal_momentum_matrix(const static_chain<Gravity, E...>& c, const Q& q) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  static_assert(sizeof(detail::check_bodies_of<chain_type>) > 0);
  const auto x = checked_arguments<chain_type>(q);
  const given g{x.at, same<skip>{}, same<skip>{}, base_with_pose};
  using pass = momentum_columns<S, chain_type, std::remove_const_t<decltype(g)>>;
  const auto w = weight_of<S>(c, x.at);
  typename pass::matrix_type a;
  (void)pass(c, g, divided_by_mass<S>(w.mass, w.moment, x.diagnosis("a centre of mass")), a).fill();
  check_result(a.data(), static_cast<std::size_t>(a.size()), too_large{"a momentum"});
  return a;
}

}  // namespace kte

#endif

// ---- of runtime chains (kte/runtime_chain.hpp)

#if defined(KTE_RUNTIME_CHAINS) && !defined(KTE_CENTROIDAL_OF_RUNTIME_CHAINS)
#define KTE_CENTROIDAL_OF_RUNTIME_CHAINS

#include <kte/dynamics/runtime/bodies.hpp>
#include <kte/dynamics/runtime/jacobian.hpp>

namespace kte {

template <class S>
linear_angular<S> centroidal_momentum(const runtime_chain& c, basic_runtime_state<S>& s) {
  detail::check_regular_tree(c, s), detail::check_state_velocities(s);
  detail::carry(c, s);
  const auto w = tree::weight_in_world(s.tree().body_tree, s.work);
  const detail::diagnose_state why{"a momentum", s};
  const auto h = detail::momentum_of_coordinates(s, detail::divided_by_mass<S>(w.mass, w.moment, why));
  return detail::checked<S>(h.force, h.torque, why);
}
namespace detail {
/// As `centroidal_momentum_matrix`, for positions that have been checked.
template <class S>
basic_runtime_jacobian<S> centroidal_momentum_matrix_of(const runtime_chain& c, basic_runtime_state<S>& s) {
  carry(c, s);
  const auto w = tree::weight_in_world(s.tree().body_tree, s.work);
  basic_runtime_jacobian<S> a = basic_runtime_jacobian<S>::Zero(6, s.tree().plan.coordinates);
  const diagnose_state why{"a momentum", s};
  for_each_momentum(s, divided_by_mass<S>(w.mass, w.moment, why),
                    [to = a.data()](int row, const tree::dense_wrench<S>& h) KTE_INLINE_LAMBDA {
                      S* const column = to + 6 * row;
                      column[0] += h.force.x, column[1] += h.force.y, column[2] += h.force.z;
                      column[3] += h.torque.x, column[4] += h.torque.y, column[5] += h.torque.z;
                    });
  check_result(a.data(), static_cast<std::size_t>(a.size()), why);
  if (a.cols() == s.dofs()) return a;
  return folded(c, s, std::move(a));
}
}  // namespace detail
template <class S>
basic_runtime_jacobian<S> centroidal_momentum_matrix(const runtime_chain& c, basic_runtime_state<S>& s) {
  detail::check_regular_tree(c, s), detail::check_positions(s);
  return detail::centroidal_momentum_matrix_of(c, s);
}
template <class S, indexable Q, indexable V>
linear_angular<S> centroidal_momentum(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v) {
  return detail::take(c, s, q, v).call([&] { return centroidal_momentum(c, s); });
}
template <class S, indexable Q>
basic_runtime_jacobian<S> centroidal_momentum_matrix(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q) {
  detail::check_regular_tree(c, s);
  return detail::take(c, s, q).call([&] { return detail::centroidal_momentum_matrix_of(c, s); });
}

#ifdef KTE_EXTERN
KTE_EXTERN template linear_angular<double> centroidal_momentum(const runtime_chain&, runtime_state&);
KTE_EXTERN template runtime_jacobian centroidal_momentum_matrix(const runtime_chain&, runtime_state&);
namespace detail {
KTE_EXTERN template runtime_jacobian centroidal_momentum_matrix_of(const runtime_chain&, runtime_state&);
}
#endif

}  // namespace kte

#endif
