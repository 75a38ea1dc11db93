#pragma once

/// All elements in runtime chains, and the registry by which files make them.
#include <kte/elements/compiled_elements.hpp>
#include <kte/elements/registry.hpp>
