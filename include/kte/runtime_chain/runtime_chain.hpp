#pragma once

/// Runtime chains, with the algorithms of all headers of dynamics that are included, before or after this one
/// (docs/decisions/13-folders.md).
#include <kte/runtime_chain/chain.hpp>

#define KTE_RUNTIME_CHAINS
#include <kte/dynamics/runtime_parts.hpp>
