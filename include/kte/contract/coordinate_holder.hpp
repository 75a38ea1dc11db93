#pragma once

/// The former name of this header.
#include <kte/contract/coordinate_lock.hpp>
