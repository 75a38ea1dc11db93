#pragma once

#include <kte/control/linear_system.hpp>
#include <kte/dynamics/closed_loops/actuated_derivatives.hpp>
#include <kte/dynamics/runtime/at_run_time.hpp>

namespace kte {

namespace detail {
linear_system<> linearized_loops(const runtime_chain& c, runtime_state& s, const Eigen::VectorXd& tau,
                                 const std::vector<std::string>& names);
}  // namespace detail

/// Linearization of a mechanism with loops in its actuated coordinates y, as many as its mobility, about q and v on the
/// loops and the forces tau on all coordinates:
///
///   d = (dy, dy'),   du: changes of the forces on the actuated coordinates,   output d          (1)
///
/// by `actuated_dynamics_derivatives`. For `lqr` and `discretize`, as the system of any model:
///
///   const auto linear = kte::linearize(four_bar, s, q, v, tau, kte::actuated("crank"));
///
/// Throws as this; `bad_argument` for a chain with internal states, and for actuated rotations and poses that move.
template <indexable Q, indexable V, indexable T>
[[nodiscard]] linear_system<> linearize(const runtime_chain& c, runtime_state& s, const Q& q, const V& v, const T& tau,
                                        const actuated_coordinates& by) {
  detail::check_regular_tree(c, s), detail::refuse_contacts(c);
  return detail::take(c, s, q, v, detail::found_later{}, tau).call([&] {
    return detail::linearized_loops(c, s, detail::as_vector(tau, s.dofs()), by.names);
  });
}
template <class Gravity, class... E, indexable Q, indexable V, indexable T>
[[nodiscard]] linear_system<> linearize(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const T& tau,
                                        const actuated_coordinates& by) {
  return detail::at_run_time(c, q, v, tau, [&](auto&... at) { return linearize(at..., by); });
}

}  // namespace kte

#ifdef KTE_FUNCTION
namespace kte::detail {

KTE_FUNCTION linear_system<> linearized_loops(const runtime_chain& c, runtime_state& s, const Eigen::VectorXd& tau,
                                              const std::vector<std::string>& names) {
  if (c.wiring().count(kind::internal) > 0)
    throw bad_argument(
        "kte: linearize: elements of this chain have internal states, which actuated coordinates do not "
        "include");
  const std::vector<int> rows = rows_of_coordinates(c, s, names);
  const Eigen::VectorXd v = read_numbers<vector_of::v>(s);
  const auto n = static_cast<Eigen::Index>(rows.size());
  Eigen::VectorXd rates(n);
  for (Eigen::Index k = 0; k < n; ++k) rates[k] = v[rows[static_cast<std::size_t>(k)]];
  for (const auto& name : names)
    if (c.wiring().kind_of(name, false) != kind::gen && rates.cwiseAbs().maxCoeff() > 0)
      throw bad_argument("kte: linearize: the actuated coordinate '" + name +
                         "' is a rotation or a pose: linearization accepts states at rest");
  const auto by = actuated_dynamics_derived(c, s, tau, names);
  linear_system<> r;
  r.A.setZero(2 * n, 2 * n), r.B.setZero(2 * n, n);
  r.A.topRightCorner(n, n).setIdentity();
  r.A.bottomLeftCorner(n, n) = by.by_q, r.A.bottomRightCorner(n, n) = by.by_v;
  r.B.bottomRows(n) = by.by_tau;
  r.C.setIdentity(2 * n, 2 * n), r.D.setZero(2 * n, n);
  r.x_dot.resize(2 * n), r.x_dot << rates, by.a;
  r.y0.setZero(2 * n);
  return r;
}

}  // namespace kte::detail
#endif
