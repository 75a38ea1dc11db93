#pragma once

#include <pybind11/pybind11.h>

/// What messages of pybind11 about wrong arguments call arguments that a function checks itself.
template <>
struct pybind11::detail::handle_type_name<pybind11::handle> {
  static constexpr auto name = const_name("Any");
};
template <>
struct pybind11::detail::handle_type_name<pybind11::object> {
  static constexpr auto name = const_name("Any");
};
