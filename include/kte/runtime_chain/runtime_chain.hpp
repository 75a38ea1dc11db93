#pragma once

/// Runtime chains, with the runtime parts of all included headers of dynamics, whether included before or after this
/// one (docs/decisions/13-folders.md).
#include <kte/runtime_chain/chain.hpp>

#define KTE_RUNTIME_CHAINS
#include <kte/dynamics/runtime_parts.hpp>
