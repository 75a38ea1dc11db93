#pragma once

/// Former header name; use kte/runtime_chain.hpp.
#include <kte/runtime_chain.hpp>
