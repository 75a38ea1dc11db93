#pragma once

#include <kte/dynamics/bias_forces.hpp>
#include <kte/dynamics/closed_loops/actuated_forces.hpp>
#include <kte/dynamics/jacobian.hpp>
#include <kte/dynamics/mass_matrix.hpp>

/// The equations of motion of a mechanism with loops in its actuated coordinates y, whose number is the mobility. With
/// G of `loop_motion`, and M, h, J of the tree,
///
///   v = G y',   a = G y'' + G_dot y'                              (1)
///   (G^T M G) y'' + G^T (M G_dot y' + h) = tau_y                  (2)
///
/// q and v contain all coordinates and satisfy the loops: v = G y'.
namespace kte {

namespace detail {
Eigen::VectorXd actuated_drift(const runtime_chain& c, runtime_state& s, const std::vector<std::string>& names);
Eigen::VectorXd actuated_bias(const runtime_chain& c, runtime_state& s, const std::vector<std::string>& names);
}  // namespace detail

/// The mass matrix in actuated coordinates, G^T M G. Throws as `loop_motion`.
template <indexable Q>
Eigen::MatrixXd mass_matrix(const runtime_chain& c, runtime_state& s, const Q& q, const actuated_coordinates& by) {
  const Eigen::MatrixXd g = loop_motion(c, s, q, by);
  detail::mass_of_coordinates(detail::runtime_elements{c}, s);
  return g.transpose() * s.work.mass * g;
}
/// The accelerations of all coordinates for y'' = 0: G_dot y'. Throws as `loop_motion`.
template <indexable Q, indexable V>
Eigen::VectorXd bias_acceleration(const runtime_chain& c, runtime_state& s, const Q& q, const V& v,
                                  const actuated_coordinates& by) {
  detail::check_regular_tree(c, s);
  return detail::take(c, s, q, v).call([&] { return detail::actuated_drift(c, s, by.names); });
}
/// The forces on the actuated coordinates for y'' = 0, with gravity, springs and dampers: G^T (M G_dot y' + h). Throws
/// as `loop_motion` and `inverse_dynamics`.
template <indexable Q, indexable V>
Eigen::VectorXd nonlinear_effects(const runtime_chain& c, runtime_state& s, const Q& q, const V& v,
                                  const actuated_coordinates& by) {
  detail::check_regular_tree(c, s);
  return detail::take(c, s, q, v, detail::found_later{}).call([&] { return detail::actuated_bias(c, s, by.names); });
}
/// The forces on the actuated coordinates that hold the bodies against gravity: G^T times `gravity_forces`.
template <indexable Q>
Eigen::VectorXd gravity_forces(const runtime_chain& c, runtime_state& s, const Q& q, const actuated_coordinates& by) {
  const Eigen::MatrixXd g = loop_motion(c, s, q, by);
  return g.transpose() * gravity_forces(c, s, q);
}
/// The Jacobian of a frame by the actuated coordinates, J G: velocities in the axes of the frame, linear rows first.
template <indexable Q>
Eigen::MatrixXd jacobian(const runtime_chain& c, runtime_state& s, const Q& q, const name_or_handle& frame,
                         const actuated_coordinates& by) {
  const Eigen::MatrixXd g = loop_motion(c, s, q, by);
  return jacobian(c, s, q, frame) * g;
}
/// The Jacobian in axes of the base.
template <indexable Q>
Eigen::MatrixXd jacobian(const runtime_chain& c, runtime_state& s, const Q& q, const name_or_handle& frame,
                         in_world_axes_t, const actuated_coordinates& by) {
  const Eigen::MatrixXd g = loop_motion(c, s, q, by);
  return jacobian(c, s, q, frame, in_world_axes) * g;
}

}  // namespace kte

#ifdef KTE_FUNCTION
namespace kte::detail {

/// The motion d with J d = -off in which the actuated coordinates are fixed.
inline Eigen::VectorXd followed_motion(runtime_state& s, loop_memory_of_state& loops, const Eigen::MatrixXd& g,
                                       const std::vector<int>& actuated, const Eigen::VectorXd& off) {
  const Eigen::VectorXd d = -loops.factor.least_change(s, loops.equations, off);
  Eigen::VectorXd of_actuated(g.cols());
  for (Eigen::Index k = 0; k < g.cols(); ++k) of_actuated[k] = d[actuated[static_cast<std::size_t>(k)]];
  return d - g * of_actuated;
}
KTE_FUNCTION Eigen::VectorXd actuated_drift(const runtime_chain& c, runtime_state& s,
                                            const std::vector<std::string>& names) {
  const Eigen::MatrixXd g = actuated_motion(c, s, names);
  if (!has_loops(c)) return Eigen::VectorXd::Zero(s.dofs());
  auto& loops = loops_of(c, s);
  loops.equations.at_rates(closures_of(c), s);
  return followed_motion(s, loops, g, rows_of_coordinates(c, s, names), loops.equations.acceleration);
}
KTE_FUNCTION Eigen::VectorXd actuated_bias(const runtime_chain& c, runtime_state& s,
                                           const std::vector<std::string>& names) {
  write_numbers<vector_of::a>(s, actuated_drift(c, s, names), "a");
  return actuated_forces(c, s, names);
}

}  // namespace kte::detail
#endif
