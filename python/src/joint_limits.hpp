#pragma once

#include <kte/models/joint_limits.hpp>

#include <pybind11/pybind11.h>

namespace kte_python {

/// Limits from a kte.Limits, those of a robot if that is None, or none.
kte::joint_limits<> limits_from(pybind11::handle robot_or_chain, pybind11::handle limits);

/// A kte.Limits.
pybind11::object limits_of(const kte::joint_limits<>& l);

}  // namespace kte_python
