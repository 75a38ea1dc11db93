#pragma once

namespace bench {

/// `frames`: poses of all frames; the result is that of the tool. `coriolis_matrix`: the result is C v, because C is
/// not unique.
enum class operation {
  passes,
  forward_kinematics,
  jacobian,
  inverse_dynamics,
  nonlinear_effects,
  mass_matrix,
  forward_dynamics,
  mass_matrix_inverse,
  id_derivatives,
  fd_derivatives,
  regressor,
  frames,
  kinetic_energy,
  potential_energy,
  gravity_forces,
  coriolis_matrix,
  jacobian_rate,
  com_jacobian,
  momentum_matrix,
  momentum_rate
};

constexpr const char* to_string(operation o) {
  constexpr const char* names[]{"passes",           "forward_kinematics",  "jacobian",
                                "inverse_dynamics", "nonlinear_effects",   "mass_matrix",
                                "forward_dynamics", "mass_matrix_inverse", "id_derivatives",
                                "fd_derivatives",   "regressor",           "frames",
                                "kinetic_energy",   "potential_energy",    "gravity_forces",
                                "coriolis_matrix",  "jacobian_rate",       "com_jacobian",
                                "momentum_matrix",  "momentum_rate"};
  return names[static_cast<int>(o)];
}

/// Whether a mass matrix is written in full or, by rows, from the diagonal on.
enum class triangle { both, upper };

}  // namespace bench
