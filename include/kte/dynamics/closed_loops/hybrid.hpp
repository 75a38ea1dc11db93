#pragma once

#include <kte/dynamics/closed_loops/derivatives.hpp>
#include <kte/dynamics/hybrid_dynamics.hpp>

#ifdef KTE_FUNCTION
#  include <kte/kernels/orthogonal_decomposition.hpp>

/// Hybrid dynamics of chains with loops.
namespace kte::detail {

/// Accelerations with some of them given; writes the forces on these coordinates to `forces`. With a0, lambda0 of
/// `constrained_dynamics` without these forces, and the response R of accelerations to forces,
///
///   E R E^T f = given - E a0,   a = a0 + R E^T f          (1)
///
/// E: selects the rows of given coordinates.
KTE_FUNCTION Eigen::VectorXd hybrid_on_loops(const runtime_chain& c, runtime_state& s,
                                             const std::vector<char>& is_given, const Eigen::VectorXd& given,
                                             Eigen::VectorXd& forces) {
  for (int i = 0; i < s.dofs(); ++i) s.work.kept[static_cast<std::size_t>(i)] = forces[i];
  Eigen::VectorXd a = accelerations_on_loops(c, s, false);
  std::vector<int> rows;
  for (int i = 0; i < s.dofs(); ++i)
    if (is_given[static_cast<std::size_t>(i)]) rows.push_back(i);
  const auto count = static_cast<Eigen::Index>(rows.size());
  if (count == 0) return a;
  const auto& e = loops_of(c, s).equations;
  Eigen::VectorXd lambda = loop_forces(e.places, s);
  Eigen::MatrixXd response(s.dofs(), count), of_lambda(e.places.rows, count), square(count, count);
  Eigen::VectorXd missing(count), sizes(count);
  loop_sensitivity equations;
  equations.compute(c, s, false);
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto column = equations.inverse.col(rows[static_cast<std::size_t>(k)]);
    response.col(k) = column.head(s.dofs()), of_lambda.col(k) = column.tail(e.places.rows);
  }
  for (Eigen::Index k = 0; k < count; ++k) {
    const int row = rows[static_cast<std::size_t>(k)];
    square.row(k) = response.row(row);
    missing[k] = given[row] - a[row], sizes[k] = std::abs(given[row]) + std::abs(a[row]);
  }
  orthogonal_decomposition factor;
  factor.compute(square);
  const Eigen::VectorXd f = factor.solve(missing);
  const Eigen::VectorXd open = square * f - missing;
  for (Eigen::Index k = 0; k < count; ++k)
    if (!(std::abs(open[k]) <= 1e-6 * (sizes.maxCoeff() + 1e-300)))
      throw bad_argument("kte: hybrid_dynamics: the closures do not allow this acceleration of '" +
                         std::string(name_of_row(layout_of_state(s), rows[static_cast<std::size_t>(k)])) +
                         "' with the others that are prescribed");
  a += response * f, lambda += of_lambda * f;
  for (Eigen::Index k = 0; k < count; ++k) {
    const int row = rows[static_cast<std::size_t>(k)];
    forces[row] = f[k], a[row] = given[row];
  }
  for (const auto& x : e.places.closures)
    for (int r = 0; r < x.rows.count(); ++r) {
      auto& loop = s.get<kind::loop>(x.loop);
      row_of(loop.force, loop.torque, x.rows, r) = lambda[x.first + r];
    }
  write_numbers<vector_of::a>(s, a, "a");
  return a;
}
#  ifndef KTE_EXTERN
inline const bool hybrid_dynamics_knows_loops = (hybrid_accelerations_on_loops = hybrid_on_loops, true);
#  endif

}  // namespace kte::detail
#endif
