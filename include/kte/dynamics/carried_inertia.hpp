#pragma once

/// Deprecated header name; use kte/dynamics/subtree_inertia.hpp.
#include <kte/dynamics/subtree_inertia.hpp>
