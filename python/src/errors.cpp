#include <kte/errors.hpp>
#include <kte/manipulators/nearest.hpp>

#include <pybind11/pybind11.h>

#include "parts.hpp"

namespace kte_python {

namespace py = pybind11;

namespace {

const char* text_of(kte::failure_reason r) {
  switch (r) {
    case kte::failure_reason::not_finite:
      return "not_finite";
    case kte::failure_reason::step_too_short:
      return "step_too_short";
    case kte::failure_reason::too_many_steps:
      return "too_many_steps";
    case kte::failure_reason::no_convergence:
      return "no_convergence";
    case kte::failure_reason::singular_matrix:
      return "singular_matrix";
    case kte::failure_reason::out_of_reach:
      return "out_of_reach";
    case kte::failure_reason::event_function:
      return "event_function";
    case kte::failure_reason::other:
      return "other";
  }
  return "other";
}

/// A message of C++ with the names of Python.
std::string in_python(std::string what) {
  for (std::size_t at = 0; (at = what.find("kte::", at)) != std::string::npos;) what.replace(at, 5, "kte.");
  return what;
}
void raise(const char* type, const char* what) {
  const py::object error = py::module_::import("kte.errors").attr(type);
  PyErr_SetString(error.ptr(), in_python(what).c_str());
}

void raise(const kte::integration_failure& e) {
  const py::object error = py::module_::import("kte.errors").attr("IntegrationFailure")(in_python(e.what()));
  error.attr("time") = e.time, error.attr("reason") = text_of(e.reason);
  error.attr("cause") = in_python(e.cause), error.attr("component") = e.component;
  PyErr_SetObject(py::type::of(error).ptr(), error.ptr());
}

}  // namespace

void bind_errors(py::module_&) {
  py::register_exception_translator([](std::exception_ptr p) {
    try {
      if (p) std::rethrow_exception(p);
    } catch (const kte::integration_failure& e) {
      raise(e);
    } catch (const kte::bad_parameter& e) {
      raise("BadParameter", e.what());
    } catch (const kte::bad_wiring& e) {
      raise("BadWiring", e.what());
    } catch (const kte::unknown_name& e) {
      raise("UnknownName", e.what());
    } catch (const kte::bad_argument& e) {
      raise("BadArgument", e.what());
    } catch (const kte::singular_mass_matrix& e) {
      raise("SingularMassMatrix", e.what());
    } catch (const kte::unreachable& e) {
      raise("Unreachable", e.what());
    } catch (const kte::no_solution& e) {
      raise("NoSolution", e.what());
    } catch (const kte::dead_point& e) {
      raise("DeadPoint", e.what());
    } catch (const kte::cannot_assemble& e) {
      raise("CannotAssemble", e.what());
    } catch (const kte::bad_file& e) {
      raise("BadFile", e.what());
    } catch (const kte::error& e) {
      raise("Error", e.what());
    }
  });
}

}  // namespace kte_python
