#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>

#include "parts.hpp"

namespace kte_python {

namespace {

namespace py = pybind11;

constexpr std::size_t most_classes = 16;
std::array<std::string, most_classes> class_names;

template <std::size_t i>
void* refuse(std::size_t /*bytes*/) {
  throw py::type_error("kte: " + class_names[i] + ".__init__() was not called: a class derived from " + class_names[i] +
                       " calls super().__init__(...) before it uses self");
}
template <std::size_t... i>
constexpr std::array<void* (*)(std::size_t), sizeof...(i)> refusals(std::index_sequence<i...>) {
  return {&refuse<i>...};
}

/// What pybind11 leaves to crash. For objects whose `__init__` was not called it asks `operator_new` for memory, and
/// passes it on as if it were an object; protocols of pickle below 2 make objects of its base class.
void make_safe(const py::module_& m) {
  constexpr auto functions = refusals(std::make_index_sequence<most_classes>());
  const py::object reduce = py::module_::import("builtins").attr("object").attr("__reduce_ex__");
  std::size_t count = 0;
  for (const auto& [name, object] : m.attr("__dict__").cast<py::dict>()) {
    auto* const type = reinterpret_cast<PyTypeObject*>(object.ptr());
    auto* const info = PyType_Check(object.ptr()) ? py::detail::get_type_info(type) : nullptr;
    if (!info) continue;
    class_names.at(count) = name.cast<std::string>();
    info->operator_new = functions.at(count++);
    object.attr("__reduce_ex__") =
        py::cpp_function([reduce](py::handle self, int protocol) { return reduce(self, std::max(protocol, 2)); },
                         py::name("__reduce_ex__"), py::is_method(object));
  }
}

/// Lets `inspect.signature` find what the first lines of the docstrings of functions state: Python looks for a mark
/// behind it.
void give_signatures(const py::module_& m) {
  for (const auto& [name, object] : m.attr("__dict__").cast<py::dict>()) {
    if (!PyCFunction_Check(object.ptr())) continue;
    auto* const method = reinterpret_cast<PyCFunctionObject*>(object.ptr())->m_ml;
    const std::string doc = method->ml_doc == nullptr ? "" : method->ml_doc;
    const auto end = doc.find(")\n\n");
    if (end == doc.npos || !doc.starts_with(std::string(method->ml_name) + "(")) continue;
    char* const marked = strdup((doc.substr(0, end + 1) + "\n--" + doc.substr(end + 1)).c_str());
    if (marked == nullptr) continue;
    std::free(const_cast<char*>(method->ml_doc));  // pybind11 has allocated it so, and frees it
    method->ml_doc = marked;
  }
}

}  // namespace

}  // namespace kte_python

PYBIND11_MODULE(_kte, m) {
  namespace py = pybind11;
  py::options options;
  options.disable_function_signatures();
  m.doc() = "The compiled part of kte.";
  m.attr("__version__") = KTE_VERSION;
  kte_python::bind_errors(m);
  kte_python::bind_arrays(m);
  kte_python::bind_chain(m);
  kte_python::bind_dynamics(m);
  kte_python::bind_derivatives(m);
  kte_python::bind_momentum(m);
  kte_python::bind_frames(m);
  kte_python::bind_configurations(m);
  kte_python::bind_loops(m);
  kte_python::bind_contacts(m);
  kte_python::bind_state(m);
  kte_python::bind_files(m);
  kte_python::bind_robots(m);
  kte_python::bind_inverse_kinematics(m);
  kte_python::bind_joint_motions(m);
  kte_python::bind_statics(m);
  kte_python::bind_control(m);
  kte_python::bind_simulation(m);
  kte_python::bind_rollout(m);
  kte_python::bind_compiled(m);
  kte_python::bind_sweep_cases(m);
  kte_python::bind_sweep(m);
  kte_python::bind_view(m);
  kte_python::make_safe(m);
  kte_python::give_signatures(m);
}
