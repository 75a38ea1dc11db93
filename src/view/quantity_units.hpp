#pragma once

#include <kte/view/detail/chain_parts.hpp>
#include <kte/view/scene.hpp>

namespace kte::view {

/// The unit of what is recorded of a chain: "m/s", "rad", ...; empty where nobody says.
std::string unit_of_quantity(const detail::chain_parts& chain, const scene& s, const detail::recorded& x);
/// The unit of a column by the name that a recorder gives it; empty for other names.
std::string unit_of_column(const detail::chain_parts& chain, const scene& s, const std::string& name);

}  // namespace kte::view
