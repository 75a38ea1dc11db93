/// All algorithms that have headers for both kinds of chain, on a runtime chain.
inline double all_algorithms(const kte::runtime_chain& c, kte::runtime_state& s, const Eigen::VectorXd& q,
                             const Eigen::VectorXd& v, const Eigen::VectorXd& a) {
  kte::set_positions(s, kte::integrate(c, q, v, 0.1));
  Eigen::VectorXd tau(a.size());
  kte::batch::inverse_dynamics(c, q, v, a, tau);
  return kte::inverse_dynamics(c, s, q, v, a)[0] + kte::forward_dynamics(c, s, q, v, a)[0] +
         kte::mass_matrix(c, s, q)(0, 0) + kte::mass_matrix_inverse(c, s, q)(0, 0) + kte::gravity_forces(c, s, q)[0] +
         kte::hybrid_dynamics(c, s, q, v, a, {"q"}).a[0] + kte::energy(c, s, q, v).kinetic +
         kte::inverse_dynamics_derivatives(c, s, q, v, a).by_q(0, 0) + kte::centre_of_mass(c, s, q).mass +
         kte::centroidal_momentum(c, s, q, v).linear.x + kte::torque_regressor(c, s, q, v, a)(0, 0) +
         kte::forward_kinematics(c, s, q, "tip").position.x + kte::frame_velocity(c, s, q, v, "tip").linear.x +
         kte::jacobian(c, s, q, "tip")(0, 0) + kte::positions(s)[0] + tau[0];
}
