#pragma once

#include <kte/math/rigid_body.hpp>

#include "data/reference_state.hpp"

namespace kte::reference {

/// A body of a serial chain and the revolute joint before it: where the joint is placed in the frame of the body
/// before, and about which axis it turns. m, kg, kg m^2.
struct serial_body {
  mat3<> rotation;  ///< of the placement
  vec3<> position;  ///< of the placement
  vec3<> axis;
  rigid_body<> body;
};

}  // namespace kte::reference
