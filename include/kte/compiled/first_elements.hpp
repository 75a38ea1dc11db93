#pragma once

/// Part of kte/compiled.hpp: half of the elements in runtime chains.
#include <kte/compiled/chains.hpp>
#include <kte/elements/detail/first_elements.hpp>
