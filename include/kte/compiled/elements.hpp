#pragma once

/// Part of kte/compiled.hpp: the other half of the elements.
#include <kte/compiled/first_elements.hpp>
#include <kte/elements/compiled_elements.hpp>
