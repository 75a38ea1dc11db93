#pragma once

#include <cstddef>

/// The functions of a robot whose chain is a type, as a shared library has them for its host (static_library_of.hpp
/// writes them).
namespace evaluate {

/// An error of a function: its class, and its message.
struct library_failure {
  enum class kind { none, bad_argument, singular_mass_matrix, other };
  kind what = kind::none;
  char text[1000]{};
};
/// One state: writes results to out[0], out[1] ..., matrices by rows.
using function_of_state = void (*)(const double* const* in, double* const* out, library_failure& f);
/// Many states side by side, in threads.
using function_of_states = void (*)(std::size_t states, const double* const* in, double* out, std::size_t threads,
                                    library_failure& f);

/// A function of a robot: its name, its frame or null, and its two forms; the second may be null.
struct library_function {
  const char* name;
  const char* frame;
  function_of_state one;
  function_of_states many;
};
/// All functions; the last one has no name. The library exports them as `kte_functions`.
using library_functions = const library_function*;

}  // namespace evaluate
