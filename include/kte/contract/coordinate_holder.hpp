#pragma once

/// Deprecated header name; use kte/contract/coordinate_lock.hpp.
#include <kte/contract/coordinate_lock.hpp>
