// expect: error: .*kte: this algorithm does not support contacts; contact_dynamics
// clang-format off
#include <kte/kte.hpp>
#include "touching_slide.hpp"
// clang-format on

int main() { return static_cast<int>(kte::inverse_dynamics(touching_slide, at_zero, at_zero, at_zero)[0]); }
