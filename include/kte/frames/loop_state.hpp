#pragma once

#include <kte/math/vec.hpp>

namespace kte {

/// The state of a closure: its residuals at the last doMotion, zero if the loop is closed, and its forces, one per
/// residual. Rows in m and rows in rad are separate; rows that a closure does not have are zero.
///   residual       m
///   ang_residual   rad
///   force          N, one per residual: power is force_k times the rate of residual_k
///   torque         Nm
/// The load of the closure on its second frame is J^T times these forces; the opposite acts on its first frame.
template <class Scalar = double>
struct loop_state {
  vec3<Scalar> residual{};
  vec3<Scalar> ang_residual{};
  vec3<Scalar> force{};
  vec3<Scalar> torque{};
};

}  // namespace kte
