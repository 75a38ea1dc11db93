#pragma once

#include <kte/detail/macros_aside.hpp>

#include <kte/detail/raise.hpp>

#include <stdexcept>
#include <string>
#include <string_view>

/// Everything kte throws. All derive from kte::error; what() names the element, the frame, the value or the place.
namespace kte {

namespace detail {

/// A text with its zero bytes as \x00, because what() ends at the first. By push_back alone: each program compiles it.
[[gnu::cold]] inline std::string without_zero_bytes(const std::string& text) {
  std::string shown;
  for (const char *at = text.data(), *const end = at + text.size(); at < end; ++at) {
    if (*at != '\0')
      shown.push_back(*at);
    else
      for (const char* x = "\\x00"; *x != '\0'; ++x) shown.push_back(*x);
  }
  return shown;
}

}  // namespace detail

/// The base of all errors of this library.
struct error : std::runtime_error {
  explicit error(const std::string& what) : std::runtime_error(detail::without_zero_bytes(what)) {}
};
/// An invalid parameter of an element: a negative mass, an axis that is not of length 1, NaN.
struct bad_parameter : error {
  using error::error;
};
/// Elements that do not fit together: a frame written twice, read before it is written, of the wrong kind, unknown.
struct bad_wiring : error {
  using error::error;
};
/// A name that a chain or state does not have.
struct unknown_name : error {
  using error::error;
};
/// An argument of the wrong size or out of its range, or a result that is not finite.
struct bad_argument : error {
  using error::error;
};
/// The mass matrix has no factorisation: a coordinate moves no mass.
struct singular_mass_matrix : error {
  using error::error;
};
/// Equations without a solution, or with several: joints that jam; a Riccati equation of a system that is not
/// stabilisable.
struct no_solution : error {
  using error::error;
};
/// A linkage is at a dead point: the position of its crank does not determine that of its follower. Integrators stop; a
/// shorter step does not help.
struct dead_point : error {
  using error::error;
};
/// Loops that do not close from a guess, with the closure that is open.
struct cannot_assemble : error {
  using error::error;
};
/// A file that cannot be read; what() says where.
struct bad_file : error {
  using error::error;
};
/// Why an integration failed.
enum class failure_reason {
  not_finite,          ///< f, a state, a Jacobian or the state after a reset is not finite or cannot be computed
  step_too_short,      ///< the tolerances need steps below the smallest step, or below the rounding of the time
  too_many_steps,      ///< more steps than `max_steps`
  no_convergence,      ///< an iteration does not converge
  singular_matrix,     ///< the matrix of Newton's iteration, or of a Rosenbrock method, is singular
  out_of_reach,        ///< the tolerances are below the rounding errors
  event_function,      ///< the function of an event is not finite
  accumulated_events,  ///< events accumulate before the end time
  other                ///< an error of another library; the text names it
};
/// An integration failed. The members hold the data of the text.
struct integration_failure : error {
  integration_failure(const std::string& what, double at, failure_reason why, std::string of = {}, long long i = -1)
      : error(what), time(at), reason(why), cause(std::move(of)), component(i) {}

  double time;            ///< of the failure, s
  failure_reason reason;  ///< the kind of failure
  std::string cause;      ///< the message of the right-hand side, with the coordinate or element; or the event's name
  long long component;    ///< the first entry of the state that is not finite; -1 if unknown
};

namespace detail {

/// A number for a message, with all its digits.
inline std::string number(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

}  // namespace detail
}  // namespace kte

#include <kte/detail/macros_back.hpp>
