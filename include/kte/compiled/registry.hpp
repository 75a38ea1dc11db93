#pragma once

/// Part of kte/compiled.hpp: the registry by which files make elements.
#include <kte/compiled/elements.hpp>
#include <kte/elements/registry.hpp>
