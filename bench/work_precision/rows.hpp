#pragma once

#include "measure.hpp"

namespace work_precision {

/// A line of text:
///
///   problem method setting error cpu_seconds evaluations steps rejected jacobians factorizations energy_drift
///   momentum_drift quaternion_norm_drift
///
/// without a break; `failed` as the error of an integration that stopped, with the reason at the end; - for what there
/// is not.
void print(const problem& p, const row& r);

}  // namespace work_precision
