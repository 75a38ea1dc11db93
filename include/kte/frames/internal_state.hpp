#pragma once

namespace kte {

/// A number that an element keeps: z, and its rate z_dot as of the last doMotion, in the unit of z per second.
template <class Scalar = double>
struct internal_state {
  Scalar z{};
  Scalar z_dot{};
};

}  // namespace kte
