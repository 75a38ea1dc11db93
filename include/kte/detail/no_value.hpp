#pragma once

namespace kte::detail {

/// In place of a value or member that a type does not have.
struct no_value {};

}  // namespace kte::detail
