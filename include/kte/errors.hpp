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
/// A file that cannot be read; what() says where.
struct bad_file : error {
  using error::error;
};
/// An integration that could not go on.
struct integration_failure : error {
  using error::error;
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
