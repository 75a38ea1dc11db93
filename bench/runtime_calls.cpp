#include "runtime_calls.hpp"

#include <kte/dynamics/bias_forces.hpp>
#include <kte/dynamics/centroidal.hpp>
#include <kte/dynamics/coriolis_matrix.hpp>
#include <kte/dynamics/derivatives.hpp>
#include <kte/dynamics/energy.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/frame_motion.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/jacobian.hpp>
#include <kte/dynamics/jacobian_rate.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/dynamics/mass_matrix_inverse.hpp>
#include <kte/dynamics/momentum_rate.hpp>
#include <kte/dynamics/regressor.hpp>
#include <kte/runtime_chain.hpp>

#include <algorithm>

namespace bench::runtime_calls {
namespace {
template <class... M>
void copy(double* y, const M&... m) {
  ((y = std::copy_n(m.data(), m.size(), y)), ...);
}
void put_pose(const kte::mat3<kte::vec3<double>>& r, const kte::vec3<double>& p, double* y) {
  const double all[]{r.x.x, r.x.y, r.x.z, r.y.x, r.y.y, r.y.z, r.z.x, r.z.y, r.z.z, p.x, p.y, p.z};
  std::copy(std::begin(all), std::end(all), y);
}
}  // namespace

void passes(runtime_subject& subject, const double* x, double* y) {
  auto& [chain, tool, planar, s, nq, nv] = subject;
  kte::set_positions(s, x), kte::set_velocities(s, x + nq), kte::set_accelerations(s, x + nq + nv);
  chain.doMotion(s);
  chain.clearForce(s);
  chain.doForce(s);
  if (nq == nv) {
    for (int i = 0; i < nv; ++i) y[i] = -s.coordinate(i).f;
  } else {
    Eigen::Map<Eigen::VectorXd>(y, nv) = -kte::forces(s);
  }
}
void forward_kinematics(runtime_subject& subject, const double* x, double* y) {
  auto& [chain, tool, planar, s, nq, nv] = subject;
  const auto [r, p] = kte::forward_kinematics(chain, s, x, tool);
  if (planar) {
    y[0] = r.x.x, y[1] = r.y.x, y[2] = p.x, y[3] = p.y;
  } else {
    put_pose(r, p, y);
  }
}
void jacobian(runtime_subject& subject, const double* x, double* y) {
  auto& [chain, tool, planar, s, nq, nv] = subject;
  kte::jacobian(chain, s, x, tool, kte::in_world_axes, Eigen::Map<kte::runtime_jacobian>(y, 6, nv));
}
void inverse_dynamics(runtime_subject& subject, const double* x, double* y) {
  auto& [chain, tool, planar, s, nq, nv] = subject;
  copy(y, kte::inverse_dynamics(chain, s, x, x + nq, x + nq + nv));
}
void nonlinear_effects(runtime_subject& subject, const double* x, double* y) {
  auto& [chain, tool, planar, s, nq, nv] = subject;
  copy(y, kte::nonlinear_effects(chain, s, x, x + nq));
}
void mass_matrix(runtime_subject& subject, const double* x, double* y) {
  auto& [chain, tool, planar, s, nq, nv] = subject;
  copy(y, kte::mass_matrix(chain, s, x));
}
void forward_dynamics(runtime_subject& subject, const double* x, double* y) {
  auto& [chain, tool, planar, s, nq, nv] = subject;
  copy(y, kte::forward_dynamics(chain, s, x, x + nq, x + nq + nv));
}
void mass_matrix_inverse(runtime_subject& subject, const double* x, double* y) {
  auto& [chain, tool, planar, s, nq, nv] = subject;
  copy(y, kte::mass_matrix_inverse(chain, s, x));
}
void id_derivatives(runtime_subject& subject, const double* x, double* y) {
  auto& [chain, tool, planar, s, nq, nv] = subject;
  const auto& r = kte::inverse_dynamics_derivatives(chain, s, x, x + nq, x + nq + nv);
  copy(y, r.tau, r.by_q, r.by_v, r.by_a);
}
void fd_derivatives(runtime_subject& subject, const double* x, double* y) {
  auto& [chain, tool, planar, s, nq, nv] = subject;
  const auto& r = kte::forward_dynamics_derivatives(chain, s, x, x + nq, x + nq + nv);
  copy(y, r.a, r.by_q, r.by_v, r.by_tau);
}
void regressor(runtime_subject& subject, const double* x, double* y) {
  auto& [chain, tool, planar, s, nq, nv] = subject;
  copy(y, kte::torque_regressor(chain, s, x, x + nq, x + nq + nv));
}

void frames(runtime_subject& subject, const double* x, double* y) {
  auto& [chain, tool, planar, s, nq, nv] = subject;
  const auto& f = kte::forward_kinematics(chain, s, x).frame_3D(tool);
  put_pose(f.rotation, f.position, y);
}
void kinetic_energy(runtime_subject& subject, const double* x, double* y) {
  auto& [chain, tool, planar, s, nq, nv] = subject;
  *y = kte::kinetic_energy(chain, s, x, x + nq);
}
void potential_energy(runtime_subject& subject, const double* x, double* y) {
  auto& [chain, tool, planar, s, nq, nv] = subject;
  *y = kte::potential_energy(chain, s, x);
}
void gravity_forces(runtime_subject& subject, const double* x, double* y) {
  auto& [chain, tool, planar, s, nq, nv] = subject;
  copy(y, kte::gravity_forces(chain, s, x));
}
void coriolis_matrix(runtime_subject& subject, const double* x, double* y) {
  auto& [chain, tool, planar, s, nq, nv] = subject;
  Eigen::Map<Eigen::VectorXd>(y, nv).noalias() =
      kte::coriolis_matrix(chain, s, x, x + nq) * Eigen::Map<const Eigen::VectorXd>(x + nq, nv);
}
void jacobian_rate(runtime_subject& subject, const double* x, double* y) {
  auto& [chain, tool, planar, s, nq, nv] = subject;
  copy(y, kte::jacobian_rate(chain, s, x, x + nq, tool, kte::in_world_axes));
}
void com_jacobian(runtime_subject& subject, const double* x, double* y) {
  auto& [chain, tool, planar, s, nq, nv] = subject;
  copy(y, kte::centre_of_mass_jacobian(chain, s, x));
}
void momentum_matrix(runtime_subject& subject, const double* x, double* y) {
  auto& [chain, tool, planar, s, nq, nv] = subject;
  copy(y, kte::centroidal_momentum_matrix(chain, s, x));
}
void momentum_rate(runtime_subject& subject, const double* x, double* y) {
  auto& [chain, tool, planar, s, nq, nv] = subject;
  const auto h = kte::centroidal_momentum_rate(chain, s, x, x + nq, x + nq + nv);
  const double all[]{h.linear.x, h.linear.y, h.linear.z, h.angular.x, h.angular.y, h.angular.z};
  std::copy(std::begin(all), std::end(all), y);
}

}  // namespace bench::runtime_calls
