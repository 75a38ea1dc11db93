#pragma once

namespace bench {

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
  regressor
};

constexpr const char* to_string(operation o) {
  constexpr const char* names[]{"passes",
                                "forward_kinematics",
                                "jacobian",
                                "inverse_dynamics",
                                "nonlinear_effects",
                                "mass_matrix",
                                "forward_dynamics",
                                "mass_matrix_inverse",
                                "id_derivatives",
                                "fd_derivatives",
                                "regressor"};
  return names[static_cast<int>(o)];
}

/// Whether a mass matrix is written in full or, by rows, from the diagonal on.
enum class triangle { both, upper };

}  // namespace bench
