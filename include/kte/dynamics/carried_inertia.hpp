#pragma once

/// The former name of this header.
#include <kte/dynamics/subtree_inertia.hpp>
