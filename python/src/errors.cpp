#include <kte/errors.hpp>
#include <kte/manipulators/nearest.hpp>

#include <cerrno>
#include <cstring>
#include <pybind11/pybind11.h>
#include <string_view>
#include <utility>

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
    case kte::failure_reason::accumulated_events:
      return "accumulated_events";
    case kte::failure_reason::other:
      return "other";
  }
  return "other";
}

constexpr std::string_view moving_surfaces =
    "where signals move its surface, position, velocity and acceleration must belong together";
/// Texts of C++ messages that name what Python does not have, or has by another name.
constexpr std::pair<std::string_view, std::string_view> texts[]{
    {R"(inverse_dynamics(c, s, q, v, a, kte::actuated("q1")) of kte/loops.hpp)", "kte.actuated_forces"},
    {"use kte::consistent_velocities, or kte::impulse after an impact", "use kte.consistent_velocities"},
    {"kte::element_events(model) finds impacts, and so does kte::moreau_jean", moving_surfaces},
    {"kte::settled gives consistent modes", moving_surfaces},
    {"robot_options::", ""},
    {"rigid_body{...}.as_published()", "a body with as_published=True"},
    {"kte::numerical_inverse_kinematics", "kte.inverse_kinematics with numeric=True"},
    {"kte::", "kte."},
};

}  // namespace

std::string in_python(std::string what) {
  for (const auto& [cpp, python] : texts)
    for (std::size_t at = 0; (at = what.find(cpp, at)) != std::string::npos; at += python.size())
      what.replace(at, cpp.size(), python);
  return what;
}

namespace {

void raise(const char* type, const char* what) {
  const py::object error = py::module_::import("kte.errors").attr(type);
  PyErr_SetString(error.ptr(), in_python(what).c_str());
}

/// For a message of pybind11, such as "Unable to cast Python instance of type <class 'str'> to C++ type 'double'".
std::string of_wrong_type(std::string_view what) {
  const auto begin = what.find('<'), end = what.find('>');
  const bool named = begin < end && end != what.npos;
  return "kte: an argument has a wrong type" + (named ? ": " + std::string(what.substr(begin, end + 1 - begin)) : "");
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
      const bool missing = std::string_view(e.what()).ends_with(std::strerror(ENOENT));
      raise(missing ? "MissingFile" : "BadFile", e.what());
    } catch (const kte::error& e) {
      raise("Error", e.what());
    } catch (const py::cast_error& e) {
      PyErr_SetString(PyExc_TypeError, of_wrong_type(e.what()).c_str());
    }
  });
}

}  // namespace kte_python
