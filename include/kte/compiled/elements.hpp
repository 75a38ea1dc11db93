#pragma once

/// Part of kte/compiled.hpp: the other half of the elements, and the registry by which files make elements.
#include <kte/compiled/first_elements.hpp>
#include <kte/elements/compiled_elements.hpp>
#include <kte/elements/registry.hpp>
