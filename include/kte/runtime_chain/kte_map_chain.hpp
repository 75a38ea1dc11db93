#pragma once

/// The former name of this header.
#include <kte/runtime_chain/runtime_chain.hpp>
