#pragma once

/// Part of kte/compiled.hpp: all elements in runtime chains, and the registry by which files make them.
#include <kte/compiled/chains.hpp>
#include <kte/elements/compiled_elements.hpp>
#include <kte/elements/registry.hpp>
