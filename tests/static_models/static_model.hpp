#pragma once

#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/energy.hpp>
#include <kte/frames/motion.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include <Eigen/Core>

#include <utility>
#include <vector>

#include "digits50.hpp"
#include "random.hpp"

namespace kte::test {

/// The algorithms of a static chain as pointers to functions. They are instantiated once for all tests, and a law is a
/// function that is compiled once for all chains. Members are the functions of the same name in kte; frames have names.
template <class S>
struct static_model {
  using vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  using vector3 = Eigen::Matrix<S, 3, 1>;
  using vector6 = Eigen::Matrix<S, 6, 1>;
  using placed = pose<Eigen::Matrix<S, 3, 3>, vector3>;
  using body = rigid_body<S, vec3<S>, sym3<S>>;
  template <class Result>
  using of_q = Result (*)(const vector& q);
  template <class Result>
  using of_q_v = Result (*)(const vector& q, const vector& v);

  int dofs;
  vec3<> gravity;
  vector (*integrate)(const vector& q, const vector& v, const S& t);
  vector (*inverse_dynamics)(const vector& q, const vector& v, const vector& a);
  of_q<matrix> mass_matrix, centroidal_momentum_matrix;
  of_q<vector> static_forces, gravity_forces, gravity_forces_without_gravity;
  of_q_v<vector> nonlinear_effects, coriolis_forces, coriolis_forces_without_gravity, generalized_momenta;
  of_q<S> potential_energy;
  of_q_v<S> kinetic_energy;
  of_q_v<energies<S>> energy;
  of_q<mass_centre<S>> centre_of_mass;
  of_q_v<vector> centre_of_mass_velocity, centroidal_momentum;
  of_q_v<std::vector<std::pair<body, frame_3D<S>>>> bodies;  ///< with the motion of their frames by `doMotion`
  placed (*forward_kinematics)(const vector& q, const char* frame);
  matrix (*jacobian)(const vector& q, const char* frame);
  matrix (*jacobian_in_world_axes)(const vector& q, const char* frame);
  vector (*frame_velocity)(const vector& q, const vector& v, const char* frame);
  vector (*frame_acceleration)(const vector& q, const vector& v, const vector& a, const char* frame);
};

/// One chain in all forms; `runtime` has its elements one by one.
struct model {
  static_model<double> in_double;
  static_model<digits50> exact;
  runtime_chain runtime;
};
/// The chains of `small_chains`, iiwa14 and `models::tree`. Frames: `tool`; `body`, `tip`, `aside`; `disc`; `palm`,
/// `tip`; `shank`, `hand`. Chains with springs and dampers have none.
namespace static_models {
const model& iiwa14();
const model& floating();
const model& floating_with_springs();
const model& floating_with_dampers();
const model& planar();
const model& geared();
const model& tree();
}  // namespace static_models

/// n numbers up to this size.
Eigen::VectorXd random_vector(int n, double size, random_numbers& random);
/// The neutral configuration, moved at random.
template <class S>
typename static_model<S>::vector random_configuration(const runtime_chain& c, random_numbers& random) {
  return integrate(c, neutral_configuration(c), random_vector(c.dofs(), 2, random), 1.0).template cast<S>();
}
/// A configuration, velocities and accelerations: their numbers are equal in all scalars.
template <class S>
struct random_motion {
  using vector = typename static_model<S>::vector;
  vector q, v, a;

  random_motion(const runtime_chain& c, random_numbers& random)
      : q(random_configuration<S>(c, random)),
        v(random_vector(c.dofs(), 2, random).template cast<S>()),
        a(random_vector(c.dofs(), 5, random).template cast<S>()) {}
  /// Where this motion is at time t, and its velocity then: both to second order in t.
  vector position_at(const static_model<S>& c, const S& t) const { return c.integrate(q, v + a * (t / 2), t); }
  vector velocity_at(const S& t) const { return v + a * t; }
};

}  // namespace kte::test
