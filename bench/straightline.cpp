/// Straight-line code, the speed limit: ours (straightline/generate.cpp) and, if KTE_STRAIGHTLINE_DIR is set, that of
/// another generator.
#include "timing.hpp"

extern "C" {
void iiwa14_inverse_dynamics(const double*, double*);
void iiwa14_nonlinear_effects(const double*, double*);
void iiwa14_mass_matrix(const double*, double*);
void iiwa14_forward_dynamics(const double*, double*);
void iiwa14_articulated(const double*, double*);
void iiwa14_forward_kinematics(const double*, double*);
void iiwa14_jacobian(const double*, double*);
void ur5_inverse_dynamics(const double*, double*);
void ur5_nonlinear_effects(const double*, double*);
void ur5_mass_matrix(const double*, double*);
void ur5_forward_dynamics(const double*, double*);
void ur5_articulated(const double*, double*);
void ur5_forward_kinematics(const double*, double*);
void ur5_jacobian(const double*, double*);
void panda_inverse_dynamics(const double*, double*);
void panda_mass_matrix(const double*, double*);
void panda_articulated(const double*, double*);
void solo12_inverse_dynamics(const double*, double*);
void solo12_mass_matrix(const double*, double*);
void solo12_articulated(const double*, double*);
void hyq_inverse_dynamics(const double*, double*);
void hyq_mass_matrix(const double*, double*);
void hyq_articulated(const double*, double*);
#if defined(KTE_STRAIGHTLINE_EXTERN)
void iiwa14_rnea(const double*, double*);
void iiwa14_crba(const double*, double*);
void iiwa14_fk(const double*, double*);
void ur5_rnea(const double*, double*);
void ur5_crba(const double*, double*);
void ur5_fk(const double*, double*);
#endif
}

namespace bench {
namespace {

void add_robot(const char* how, const char* model, call<double> inverse_dynamics, call<double> mass_matrix,
               call<double> kinematics) {
  add(operation::inverse_dynamics, how, model, inverse_dynamics);
  add(operation::mass_matrix, how, model, mass_matrix, 1, triangle::upper);
  add(operation::forward_kinematics, how, model, kinematics);
}

void add_tree(const char* model, call<double> inverse_dynamics, call<double> mass_matrix, call<double> articulated) {
  add(operation::inverse_dynamics, "straightline", model, inverse_dynamics);
  add(operation::mass_matrix, "straightline", model, mass_matrix, 1, triangle::upper);
  add(operation::forward_dynamics, "straightline_aba", model, articulated);
}

const registered straightline_benchmarks{[] {
  constexpr auto ours = "straightline";
  add_robot(ours, "iiwa14", iiwa14_inverse_dynamics, iiwa14_mass_matrix, iiwa14_forward_kinematics);
  add_robot(ours, "ur5", ur5_inverse_dynamics, ur5_mass_matrix, ur5_forward_kinematics);
  // Forward dynamics by factorising the mass matrix, and by articulated bodies.
  add(operation::forward_dynamics, ours, "iiwa14", iiwa14_forward_dynamics);
  add(operation::forward_dynamics, ours, "ur5", ur5_forward_dynamics);
  add(operation::forward_dynamics, "straightline_aba", "iiwa14", iiwa14_articulated);
  add(operation::forward_dynamics, "straightline_aba", "ur5", ur5_articulated);
  add(operation::nonlinear_effects, ours, "iiwa14", iiwa14_nonlinear_effects);
  add(operation::nonlinear_effects, ours, "ur5", ur5_nonlinear_effects);
  add(operation::jacobian, ours, "iiwa14", iiwa14_jacobian);
  add(operation::jacobian, ours, "ur5", ur5_jacobian);
  add_tree("panda", panda_inverse_dynamics, panda_mass_matrix, panda_articulated);
  add_tree("solo12", solo12_inverse_dynamics, solo12_mass_matrix, solo12_articulated);
  add_tree("hyq", hyq_inverse_dynamics, hyq_mass_matrix, hyq_articulated);
#if defined(KTE_STRAIGHTLINE_EXTERN)
  constexpr auto theirs = "straightline_extern";  // to the frame of the last joint: compare its time, not its error
  add_robot(theirs, "iiwa14", iiwa14_rnea, iiwa14_crba, iiwa14_fk);
  add_robot(theirs, "ur5", ur5_rnea, ur5_crba, ur5_fk);
#endif
}};

}  // namespace
}  // namespace bench
