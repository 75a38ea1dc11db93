#pragma once

#include <kte/detail/macros_aside.hpp>

/// Forward dynamics of runtime chains in which one coordinate moves several joints. Programs that link kte::compiled do
/// not need this header.
#include <kte/runtime_chain.hpp>

namespace kte::detail {
inline const bool shared_coordinates_are_known = (general_dynamics<runtime_state>::bring(), true);
}  // namespace kte::detail

#include <kte/detail/macros_back.hpp>
