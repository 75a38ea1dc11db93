#pragma once

namespace kte {

/// An internal state of an element: z, and its rate z_dot computed by the last doMotion, in the unit of z per second.
template <class Scalar = double>
struct internal_state {
  Scalar z{};
  Scalar z_dot{};
};

}  // namespace kte
