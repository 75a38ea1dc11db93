#pragma once

#include <kte/detail/macros_aside.hpp>

/// Linear systems of models and feedback for them. Each header can be included alone.
#include <kte/control/discretize.hpp>
#include <kte/control/linearize.hpp>
#include <kte/control/lqr.hpp>

#include <kte/detail/macros_back.hpp>
