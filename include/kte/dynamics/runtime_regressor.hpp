#pragma once

#include <kte/dynamics/detail/runtime_bodies.hpp>
#include <kte/tree/regressor.hpp>

/// Inertial parameters and the regressor of runtime chains, as dynamics/regressor.hpp has them of static chains.
namespace kte {

namespace detail {
/// visit(element, its numbers, its first column, how many columns) for what has inertial parameters. Returns how many
/// there are.
template <class Visit>
int for_each_parametric(const kte_map_chain& c, const Visit& visit) {
  int column = 0;
  for (const topology::connection& e : c.wiring().elements) {
    if (e.stiff) continue;
    const element_numbers<double> n = e.element->numbers();
    const int count = n.has_mass ? 1 : n.is == part::body ? (e.ports[0].what == kind::frame_2D ? 4 : 10) : 0;
    if (count > 0) visit(e, n, column, count);
    column += count;
  }
  return column;
}
/// At the positions, rates and accelerations of the state.
template <class S>
runtime_matrix<S> regressor_of(const kte_map_chain& c, basic_runtime_state<S>& s) {
  const auto& t = s.tree();
  refuse_spread_masses(c, s);
  place_bodies(runtime_elements{c}, s);
  take_rates(s), take_bases(s);
  tree::move_bodies<false>(t.forest, s.work);
  const int columns = for_each_parametric(c, [](auto&&...) {});
  runtime_matrix<S> y = runtime_matrix<S>::Zero(t.plan.coordinates, columns);
  for_each_parametric(c, [&](const topology::connection& e, const element_numbers<double>& n, int first, int count) {
    const int index = e.index[0];
    if (n.has_mass) {
      y(t.plan.row_of_gen[static_cast<std::size_t>(index)], first) = s.template get<kind::gen>(index).q_ddot;
      return;
    }
    const auto& place = t.forest.frame(e.ports[0].what, index);
    tree::forces_by_parameters(t.forest, s.work, place, [&](int k, const tree::per_parameter<S>& x) {
      const int row = t.forest.row[static_cast<std::size_t>(k)];
      for (int i = 0; i < count; ++i) y(row, first + i) += tree::parameter_at(x, i, count);
    });
  });
  hand_on(runtime_elements{c}, s, [&y](int to, int from, const S& ratio) { y.row(to) += ratio * y.row(from); });
  y.conservativeResize(s.dofs(), columns);
  check_result(y.data(), static_cast<std::size_t>(y.size()), [&s] { blame("a regressor", s); });
  return y;
}
}  // namespace detail

/// As on static chains.
Eigen::VectorXd inertial_parameters(const kte_map_chain& c);
#ifdef KTE_FUNCTION
KTE_FUNCTION Eigen::VectorXd inertial_parameters(const kte_map_chain& c) {
  using namespace detail;
  Eigen::VectorXd pi(for_each_parametric(c, [](auto&&...) {}));
  for_each_parametric(c, [&pi](const topology::connection&, const element_numbers<double>& n, int first, int count) {
    const auto& [m, h, j] = n.weight;
    const tree::per_parameter<double> all{m, h.x, h.y, h.z, j.xx, j.xy, j.yy, j.xz, j.yz, j.zz};
    for (int i = 0; i < count; ++i) pi[first + i] = n.has_mass ? n.mass : tree::parameter_at(all, i, count);
  });
  return pi;
}
#endif

/// The regressor at the positions, rates and accelerations of a state, with its moving bases. As `torque_regressor` on
/// a static chain. Throws `bad_argument` for a joint or link that is more than its `relative`, and for masses between
/// several things.
template <class S>
runtime_matrix<S> torque_regressor(const kte_map_chain& c, basic_runtime_state<S>& s) {
  detail::check_regular(c, s);
  detail::check_state_velocities(s);
  return detail::regressor_of(c, s);
}
/// The same at q, v, a, which are put into the state.
template <class S, indexable Q, indexable V, indexable A>
runtime_matrix<S> torque_regressor(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v,
                                   const A& a) {
  detail::check_regular(c, s);
  return detail::take(c, s, q, v, a).call([&] { return detail::regressor_of(c, s); });
}

#ifdef KTE_EXTERN
KTE_EXTERN template runtime_matrix<double> detail::regressor_of(const kte_map_chain&, runtime_state&);
KTE_EXTERN template runtime_matrix<double> torque_regressor(const kte_map_chain&, runtime_state&);
KTE_EXTERN template runtime_matrix<double> torque_regressor(const kte_map_chain&, runtime_state&,
                                                            const Eigen::VectorXd&, const Eigen::VectorXd&,
                                                            const Eigen::VectorXd&);
#endif

}  // namespace kte
