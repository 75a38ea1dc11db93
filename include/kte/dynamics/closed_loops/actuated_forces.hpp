#pragma once

#include <kte/dynamics/closed_loops/assemble.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>

namespace kte {

namespace detail {
Eigen::VectorXd actuated_forces(const runtime_chain& c, runtime_state& s, const std::vector<std::string>& names);
Eigen::MatrixXd actuated_motion(const runtime_chain& c, runtime_state& s, const std::vector<std::string>& names);
}  // namespace detail

/// The matrix G of all velocities by those of the actuated coordinates of a chain with loops, v = G v_actuated: the
/// null space of the constraint Jacobian with identity rows at these,
///
///   J G = 0,   G_actuated = 1          (1)
///
/// so that G^T M G is the mass matrix of the mechanism in these coordinates, and J_tool G its Jacobian. Throws
/// `bad_argument` if their number is not the mobility, `no_solution` if they do not determine the motion.
template <indexable Q>
Eigen::MatrixXd loop_motion(const runtime_chain& c, runtime_state& s, const Q& q, const actuated_coordinates& by) {
  detail::check_regular_tree(c, s);
  return detail::take(c, s, q).call([&] { return detail::actuated_motion(c, s, by.names); });
}

/// Inverse dynamics of a chain with loops: the forces on the actuated coordinates, in their order, for a motion that
/// keeps the loops closed, with no force on the others:
///
///   tau = G^T (inverse dynamics of the tree)          (2)
///
/// Throws as `loop_motion`, and `bad_argument` for accelerations that do not keep the loops closed.
template <indexable Q, indexable V, indexable A>
Eigen::VectorXd inverse_dynamics(const runtime_chain& c, runtime_state& s, const Q& q, const V& v, const A& a,
                                 const actuated_coordinates& by) {
  detail::check_regular_tree(c, s);
  return detail::take(c, s, q, v, a).call([&] { return detail::actuated_forces(c, s, by.names); });
}

}  // namespace kte

namespace kte::detail {

/// Raises `bad_argument` for an actuated coordinate that is named twice.
inline void refuse_repeated(const std::vector<std::string>& actuated) {
  for (auto i = actuated.begin(); i != actuated.end(); ++i)
    if (std::find(actuated.begin(), i, *i) != i) [[unlikely]]
      raise<bad_argument>("kte: the actuated coordinate '" + *i + "' is named twice");
}
/// (1) for the degrees of freedom in `actuated`; call `factorize_loops` first. m is null without loops.
Eigen::MatrixXd motion_by(const std::vector<int>& actuated, int n, const loop_workspace* m);
/// Raises `bad_argument` if the accelerations of a state do not keep the loops closed; call `factorize_loops` first.
void check_accelerations_on_loops(const chain_constraints& c, runtime_state& s, loop_equations& e);
#ifdef KTE_FUNCTION
KTE_FUNCTION Eigen::MatrixXd actuated_motion(const runtime_chain& c, runtime_state& s,
                                             const std::vector<std::string>& names) {
  refuse_repeated(names);
  const auto rows = rows_of_coordinates(c, s, names);
  return motion_by(rows, s.dofs(), has_loops(c) ? &factorized_loops(c, s) : nullptr);
}
KTE_FUNCTION Eigen::VectorXd actuated_forces(const runtime_chain& c, runtime_state& s,
                                             const std::vector<std::string>& names) {
  refuse_contacts(c);
  const Eigen::MatrixXd g = actuated_motion(c, s, names);
  if (has_loops(c)) check_accelerations_on_loops(closures_of(c), s, loops_of(c, s).equations);
  return g.transpose() * forces_at_state(c, s);
}
#endif

#ifdef KTE_FUNCTION
KTE_FUNCTION Eigen::MatrixXd motion_by(const std::vector<int>& actuated, int n, const loop_workspace* m) {
  Eigen::MatrixXd j(0, n);
  int rank = 0;
  if (m) {
    rank = m->factor.rank();
    const Eigen::MatrixXd all = m->equations.scaled_jacobian();
    j.resize(rank, n);
    for (int k = 0, row = 0; k < m->equations.places.rows; ++k)
      if (m->factor.is_chosen(m->equations, k)) j.row(row++) = all.row(k);
  }
  if (static_cast<int>(actuated.size()) != n - rank)
    raise<bad_argument>("kte: this chain has mobility " + std::to_string(n - rank) +
                        " here, so it is driven by as many coordinates, not by " + std::to_string(actuated.size()));
  std::vector<char> is_actuated(static_cast<std::size_t>(n), 0);
  for (const int row : actuated) is_actuated[static_cast<std::size_t>(row)] = 1;
  std::vector<int> others, all_rows;
  for (int row = 0; row < n; ++row)
    if (!is_actuated[static_cast<std::size_t>(row)]) others.push_back(row);
  for (int k = 0; k < rank; ++k) all_rows.push_back(k);
  pivoted_qr qr;
  auto b = qr.matrix(rank, rank);
  Eigen::MatrixXd actuated_columns(rank, n - rank);
  for (int k = 0; k < rank; ++k) b.row(k) = j.col(others[static_cast<std::size_t>(k)]).transpose();
  for (int k = 0; k < n - rank; ++k) actuated_columns.col(k) = j.col(actuated[static_cast<std::size_t>(k)]);
  if (!qr.take(all_rows, least_pivot))
    raise<no_solution>("kte: the actuated coordinates do not determine the motion of the loops here");
  Eigen::MatrixXd x(rank + pivoted_qr::padding, n - rank);
  for (Eigen::Index k = 0; k < x.cols(); ++k) {
    actuated_columns.col(k) *= -1;
    qr.solve_transposed(actuated_columns.col(k).data());
    qr.times_q(actuated_columns.col(k).data(), x.col(k).data());
  }
  Eigen::MatrixXd g = Eigen::MatrixXd::Zero(n, n - rank);
  for (int k = 0; k < rank; ++k) g.row(others[static_cast<std::size_t>(k)]) = x.row(k);
  for (int k = 0; k < n - rank; ++k) g(actuated[static_cast<std::size_t>(k)], k) = 1;
  return g;
}
KTE_FUNCTION void check_accelerations_on_loops(const chain_constraints& c, runtime_state& s, loop_equations& e) {
  Eigen::VectorXd a(s.dofs());
  read_listed_numbers<vector_of::a>(s, a);
  e.at_rates(c, s);
  const Eigen::VectorXd off = e.acceleration + e.times(a);
  const Eigen::VectorXd sizes = e.acceleration.cwiseAbs() + e.times_sizes(a);
  double of_bases = 0;  // at rest `sizes` are rounding errors of these: gravity acts as an acceleration of the bases
  for_each_base(s, [&](const auto& /*motion*/, std::size_t slot) {
    const auto& b = s.work.bodies[slot];
    of_bases = (std::max)({of_bases, std::sqrt(dot(b.acceleration, b.acceleration)) / e.places.length,
                           std::sqrt(dot(b.ang_acceleration, b.ang_acceleration))});
  });
  const double bound = 1e-6 * sizes.maxCoeff() + 1e-12 * of_bases + 1e-300;
  for (int k = 0; k < e.places.rows; ++k)
    if (std::abs(off[k]) > bound) [[unlikely]]
      raise<bad_argument>("kte: these accelerations do not keep '" + c.loop_name(e.places.closure_of_row(k).loop) +
                          "' closed: those of constrained_dynamics do");
}
#endif

}  // namespace kte::detail
