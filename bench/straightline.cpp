/// Straight-line code, the speed limit: ours (straightline/generate.cpp) and, if KTE_STRAIGHTLINE_DIR is set, that of
/// another generator.
#include "expected.hpp"

extern "C" {
void iiwa14_inverse_dynamics(const double*, double*);
void iiwa14_mass_matrix(const double*, double*);
void iiwa14_forward_dynamics(const double*, double*);
void iiwa14_forward_kinematics(const double*, double*);
void ur5_inverse_dynamics(const double*, double*);
void ur5_mass_matrix(const double*, double*);
void ur5_forward_dynamics(const double*, double*);
void ur5_forward_kinematics(const double*, double*);
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

template <class Model>
void add_model(const char* how, call inverse_dynamics, call mass_matrix, call kinematics) {
  add<Model>(operation::inverse_dynamics, how, inverse_dynamics);
  add<Model>(operation::mass_matrix, how, mass_matrix, triangle::upper);
  add<Model>(operation::forward_kinematics, how, kinematics);
}

}  // namespace

void add_straightline() {
  constexpr auto ours = "straightline";
  add_model<iiwa14>(ours, iiwa14_inverse_dynamics, iiwa14_mass_matrix, iiwa14_forward_kinematics);
  add_model<ur5>(ours, ur5_inverse_dynamics, ur5_mass_matrix, ur5_forward_kinematics);
  add<iiwa14>(operation::forward_dynamics, ours, iiwa14_forward_dynamics);
  add<ur5>(operation::forward_dynamics, ours, ur5_forward_dynamics);
#if defined(KTE_STRAIGHTLINE_EXTERN)
  constexpr auto theirs = "straightline_extern";  // to the frame of the last joint: compare its time, not its error
  add_model<iiwa14>(theirs, iiwa14_rnea, iiwa14_crba, iiwa14_fk);
  add_model<ur5>(theirs, ur5_rnea, ur5_crba, ur5_fk);
#endif
}

}  // namespace bench
