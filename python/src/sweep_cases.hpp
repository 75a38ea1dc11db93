#pragma once

#include <kte/sweep/sweep_cases.hpp>

#include <pybind11/pybind11.h>

namespace kte_python {

namespace py = pybind11;

/// How an object was made: the name of a function of the module and its arguments, for pickles and `repr`.
struct made_by {
  const char* function;
  py::tuple arguments;
};
/// kte.Cases: what a sweep varies.
struct cases_object {
  kte::sweep_cases cases;
  made_by how;
};
/// kte.Distribution: a column of random numbers.
struct distribution_object {
  kte::distributed value;
  made_by how;
};

}  // namespace kte_python
