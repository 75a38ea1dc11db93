#pragma once

/// Part of kte/compiled.hpp: the elements in runtime chains.
#include <kte/compiled/chains.hpp>
#include <kte/elements/compiled_elements.hpp>
