#pragma once

#include <functional>
#include <initializer_list>

#include "arrays.hpp"
#include "chain.hpp"
#include "signal_watch.hpp"

namespace kte_python {

/// The vector that an argument is.
enum class argument_of { q, v };
/// An argument of a call: its name and what was passed.
struct argument {
  const char* name;
  argument_of what;
  py::handle value;
};
/// A result of a call for one state: an array of this shape; of the shape () it is a number.
using shape = std::vector<Py_ssize_t>;

/// Options of all calls with arrays of states.
struct call_options {
  py::handle inputs{};   ///< a dict, None or nothing
  py::handle threads{};  ///< a number, None or nothing
  bool nan_for_errors = false;
  /// What a compiled chain may have as a type: the function, and its frame.
  const char* function = "";
  std::string_view frame{};
};

/// One state: writes results, by rows, to out[0], out[1], ...
using state_function = const std::function<void(const kte::runtime_chain&, workspace&, double* const* out)>&;
/// Several states in packs, of arrays with the numbers of states side by side.
using pack_function =
    const std::function<void(const kte::runtime_chain&, std::size_t states, const std::vector<const double*>& in,
                             double* out, const interruptible_threads& team)>&;

/// Computes a function of states. Arguments of shape (..., n) are computed in threads without the GIL; arguments of
/// shape (n,) are then the same for all states, and Ctrl-C stops them. `cost` is the time of a state in units of
/// inverse dynamics. Errors of several states name the first of them.
py::object call(const chain_object& c, std::initializer_list<argument> arguments, const std::vector<shape>& results,
                double cost, const call_options& options, state_function of_chain,
                pack_function packs_of_chain = nullptr);

/// The number of threads of calls with several states.
std::size_t threads_from(py::handle threads);
/// "raise" or "nan".
bool nan_for_errors(const std::string& errors);

/// Runs f without the GIL if it takes longer than about 10 microseconds: `cost` as above.
template <class F>
void run(const kte::runtime_chain& c, double cost, const F& f) {
  if (static_cast<double>(size_of(c)) * cost > 400) {
    const py::gil_scoped_release without;
    f();
  } else {
    f();
  }
}
/// A named tuple of kte._results.
py::object result(const char* name, const py::tuple& values);

}  // namespace kte_python
