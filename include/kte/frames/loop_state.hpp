#pragma once

#include <kte/math/vec.hpp>

namespace kte {

/// What a closure carries: its residuals as of the last doMotion, zero where the loop is closed, and the forces of the
/// closure, one for each residual. Rows in m come first, those in rad are apart; what a closure does not have stays
/// zero.
///   residual       m
///   ang_residual   rad
///   force          N, that of residual k: power is force_k times the rate of residual_k
///   torque         Nm
/// The load of the closure on its second frame is J^T times these, and the opposite on its first.
template <class Scalar = double>
struct loop_state {
  vec3<Scalar> residual{};
  vec3<Scalar> ang_residual{};
  vec3<Scalar> force{};
  vec3<Scalar> torque{};
};

}  // namespace kte
