#pragma once

#include <kte/detail/raise.hpp>

#include <stdexcept>
#include <string>
#include <string_view>

/// Everything kte throws. All derive from kte::error; what() names the element, the frame, the value or the place.
namespace kte {

/// The base of all errors of this library.
struct error : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// A parameter of an element that makes no sense: a negative mass, an axis of length 0, NaN.
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
/// Arguments of the wrong size, or a result that is not a number.
struct bad_argument : error {
  using error::error;
};
/// A mass matrix that cannot be factorised: some coordinate moves no mass.
struct singular_mass_matrix : error {
  using error::error;
};
/// Equations that have no solution, or not a single one: joints that jam; Riccati equations of what inputs cannot hold.
struct no_solution : error {
  using error::error;
};
/// A linkage at a dead point: what follows its crank does not follow from there. Integrators stop: no shorter step
/// helps.
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
/// Why an integration could not go on.
enum class failure_reason {
  not_finite,       ///< f, a state or a Jacobian is not finite, or cannot be computed; or a reset's state
  step_too_short,   ///< the tolerances need steps that are lost in the rounding of time, or below the smallest one
  too_many_steps,   ///< `max_steps`
  no_convergence,   ///< of an iteration
  singular_matrix,  ///< of Newton's iterations, or of a Rosenbrock method
  out_of_reach,     ///< the tolerances are below what arithmetic can reach
  event_function,   ///< the function of an event is not finite
  other             ///< of other libraries; the text says
};
/// An integration that could not go on, also as data.
struct integration_failure : error {
  integration_failure(const std::string& what, double at, failure_reason why, std::string of = {}, long long i = -1)
      : error(what), time(at), reason(why), cause(std::move(of)), component(i) {}

  double time;  ///< s, as in the text
  failure_reason reason;
  std::string cause;    ///< what the right-hand side said, with the coordinate or element; or the name of the event
  long long component;  ///< of the state, the first that is not finite, where that is known; else -1
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
