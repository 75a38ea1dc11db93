#pragma once

namespace kte {

/// How contacts that meet at one time are resolved.
enum class impact_law {
  at_once,    ///< all contacts in one friction problem (Moreau)
  sequential  ///< one contact at a time, the fastest first
};

}  // namespace kte
