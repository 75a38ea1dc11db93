#pragma once

/// Former path of kte/runtime_chain.hpp.
#include <kte/runtime_chain.hpp>
