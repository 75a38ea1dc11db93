#include <kte/dynamics.hpp>
#include <kte/elements/prismatic_joint.hpp>

#include <functional>

#include "catch.hpp"

// What a call that refuses leaves in the state of a runtime chain: every function that puts arguments into it.

namespace refused_calls_test {

using namespace kte;

using vector = Eigen::VectorXd;

/// A slide, a hinge and a ball joint, whose mass is in reach of overflow where rates or places are.
runtime_chain arm() {
  runtime_chain c;
  const rigid_body body{2.0, vec3<>{0.1, 0.2, 0.3}, sym3<>{1.0, 0.1, 0.2, 1.5, 0.1, 2.0}};
  c << prismatic_joint_3D("slide", "base", "cart", axis::x) << inertia_3D("cart", body)
    << revolute_joint_3D("hinge", "cart", "link", axis::z) << inertia_3D("link", body)
    << spherical_joint_3D("ball", "link", "hand") << inertia_3D("hand", body);
  c.gravity(vec3<>{0, 0, -9.81});
  return c;
}

struct call {
  const char* name;
  std::function<void(runtime_state&, const vector& q, const vector& v, const vector& a)> run;
};
std::vector<call> all_calls(const runtime_chain& c, const mass_matrix_calc<runtime_chain>& masses) {
  const std::vector<external_wrench> loads{{"hand", {1, 2, 3}}};
#define KTE_REFUSING(...)                                                                                              \
  {                                                                                                                    \
#    __VA_ARGS__,                                                                                                      \
        [&c, &masses, loads](                                                                                          \
            auto& s, auto& q, auto& v,                                                                                 \
            auto&                                                                                                      \
                a) { (void)(c), (void)(loads), (void)(masses), (void)(q), (void)(v), (void)(a), (void)(__VA_ARGS__); } \
  }
  return {KTE_REFUSING(inverse_dynamics(c, s, q, v, a)),
          KTE_REFUSING(mass_matrix(c, s, q)),
          KTE_REFUSING(forward_dynamics(c, s, q, v, a)),
          KTE_REFUSING(forward_kinematics(c, s, q)),
          KTE_REFUSING(forward_kinematics(c, s, q, "hand")),
          KTE_REFUSING(jacobian(c, s, q, "hand")),
          KTE_REFUSING(jacobian(c, s, q, "hand", in_world_axes)),
          KTE_REFUSING(jacobian(c, s, q, "hand", at_world_origin)),
          KTE_REFUSING(frame_velocity(c, s, q, v, "hand")),
          KTE_REFUSING(frame_acceleration(c, s, q, v, a, "hand")),
          KTE_REFUSING(external_forces(c, s, q, loads)),
          KTE_REFUSING(inverse_dynamics(c, s, q, v, a, loads)),
          KTE_REFUSING(forward_dynamics(c, s, q, v, a, loads)),
          KTE_REFUSING(jacobian_rate(c, s, q, v, "hand")),
          KTE_REFUSING(bias_acceleration(c, s, q, v, "hand")),
          KTE_REFUSING(joint_reaction(c, s, q, v, a, "hand")),
          KTE_REFUSING(joint_reactions(c, s, q, v, a)),
          KTE_REFUSING(centre_of_mass_jacobian(c, s, q)),
          KTE_REFUSING(centroidal_momentum_rate(c, s, q, v, a)),
          KTE_REFUSING(centre_of_mass_acceleration(c, s, q, v, a)),
          KTE_REFUSING(relative_pose(c, s, q, "hand", "cart")),
          KTE_REFUSING(relative_motion(c, s, q, v, a, "hand", "cart")),
          KTE_REFUSING(relative_jacobian(c, s, q, "hand", "cart")),
          KTE_REFUSING(static_forces(c, s, q)),
          KTE_REFUSING(gravity_forces(c, s, q)),
          KTE_REFUSING(nonlinear_effects(c, s, q, v)),
          KTE_REFUSING(coriolis_forces(c, s, q, v)),
          KTE_REFUSING(kinetic_energy(c, s, q, v)),
          KTE_REFUSING(potential_energy(c, s, q)),
          KTE_REFUSING(energy(c, s, q, v)),
          KTE_REFUSING(centre_of_mass(c, s, q)),
          KTE_REFUSING(centre_of_mass_velocity(c, s, q, v)),
          KTE_REFUSING(centroidal_momentum(c, s, q, v)),
          KTE_REFUSING(centroidal_momentum_matrix(c, s, q)),
          KTE_REFUSING(mass_matrix_inverse(c, s, q)),
          KTE_REFUSING(inverse_dynamics_derivatives(c, s, q, v, a)),
          KTE_REFUSING(forward_dynamics_derivatives(c, s, q, v, a)),
          KTE_REFUSING(hybrid_dynamics(c, s, q, v, a, {"hinge"})),
          KTE_REFUSING(torque_regressor(c, s, q, v, a)),
          KTE_REFUSING(coriolis_matrix(c, s, q, v)),
          KTE_REFUSING(subtree_inertia(c, s, q, "hand")),
          KTE_REFUSING(carried_mass_centre(c, s, q, "hand")),
          KTE_REFUSING(masses.mass_matrix(s, q)),
          KTE_REFUSING(masses.mass_matrix_and_rate(s, q, v)),
          KTE_REFUSING(masses.twist_shaping(s, q, v))};
#undef KTE_REFUSING
}

TEST_CASE("a call that refuses because numbers overflow leaves the state unchanged, and names one") {
  const auto c = arm();
  const mass_matrix_calc masses(c);
  const auto calls = all_calls(c, masses);
  auto s = c.make_state();
  const vector old_q{{0.1, 0.2, 1, 0, 0, 0}}, old_v{{1, 2, 3, 4, 5}}, old_a{{6, 7, 8, 9, 10}};
  const vector q{{0.5, 0.25, 0.8, 0.6, 0, 0}}, v = vector::Ones(5), a = 2 * v;
  int refused = 0;
  std::string wrong, unnamed;
  const auto attack = [&](const call& f, const vector& x, const vector& y, const vector& z) {
    set_positions(s, old_q), set_velocities(s, old_v), set_accelerations(s, old_a);
    try {
      f.run(s, x, y, z);
    } catch (const bad_argument& e) {
      ++refused;
      if (positions(s) != old_q || velocities(s) != old_v || accelerations(s) != old_a) wrong += f.name;
      if (std::string(e.what()).find("] of '") == std::string::npos) unnamed += std::string(f.name) + e.what();
    }
  };
  for (const auto& f : calls)
    for (const double large : {1e308, -1e308, 1e200, 1e155}) {
      for (int i = 0; i < 5; ++i) {
        vector fast = v, hard = a;
        fast[i] = hard[i] = large;
        attack(f, q, fast, a), attack(f, q, v, hard);
      }
      vector far = q;
      far[0] = large;
      attack(f, far, v, a);
    }
  CHECK(wrong == "");
  CHECK(unnamed == "");
  CHECK(refused > 300);
}

TEST_CASE("a state that was moved is put back too") {
  const auto c = arm();
  auto first = c.make_state();
  auto s = std::move(first);
  const vector q{{0.5, 0.25, 0.8, 0.6, 0, 0}}, v = vector::Ones(5);
  set_positions(s, q), set_velocities(s, v);
  CHECK_THROWS_AS(forward_dynamics(c, s, neutral_configuration(c), vector(1e200 * v), v), bad_argument);
  CHECK((positions(s) == q && velocities(s) == v));
}

}  // namespace refused_calls_test
