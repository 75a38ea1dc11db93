#pragma once

#include "call.hpp"

/// Functions of states that are alike but for what they compute.
namespace kte_python {

/// A function of q, (q, v) or (q, v, a).
struct definition {
  const char* name;
  const char* doc;
  /// The shapes of its results for n degrees of freedom.
  std::vector<shape> (*results)(Py_ssize_t n);
  double cost;                  ///< of a state, in units of inverse dynamics
  const char* tuple = nullptr;  ///< the named tuple of its results
  const char* third = "a";      ///< the name of the third argument
};

inline call_options options_of(py::handle inputs, py::handle threads, const std::string& errors,
                               const char* function = "", std::string_view frame = {}) {
  return {inputs, threads, nan_for_errors(errors), function, frame};
}

namespace detail {
inline py::object finished(const definition& d, py::object made) { return d.tuple ? result(d.tuple, made) : made; }
}  // namespace detail

/// f(chain, workspace, out) writes the results for a state.
template <int Arguments, class F>
void define(py::module_& m, const definition& d, F f) {
  using namespace py::literals;
  const auto none = py::none();
  const auto body = [f](const kte::runtime_chain& k, workspace& w, double* const* out) { f(k, w, out); };
  const auto q_of = [](py::handle q) { return argument{"q", argument_of::q, q}; };
  const auto v_of = [](py::handle v) { return argument{"v", argument_of::v, v}; };
  if constexpr (Arguments == 1)
    m.def(
        d.name,
        [d, body, q_of](py::handle chain, py::handle q, py::handle inputs, py::handle threads,
                        const std::string& errors) {
          const auto& c = chain_of(chain);
          return detail::finished(d, call(c, {q_of(q)}, d.results(c.chain().dofs()), d.cost,
                                          options_of(inputs, threads, errors, d.name), body));
        },
        d.doc, "chain"_a, "q"_a, py::kw_only(), "inputs"_a = none, "threads"_a = none, "errors"_a = "raise");
  else if constexpr (Arguments == 2)
    m.def(
        d.name,
        [d, body, q_of, v_of](py::handle chain, py::handle q, py::handle v, py::handle inputs, py::handle threads,
                              const std::string& errors) {
          const auto& c = chain_of(chain);
          return detail::finished(d, call(c, {q_of(q), v_of(v)}, d.results(c.chain().dofs()), d.cost,
                                          options_of(inputs, threads, errors, d.name), body));
        },
        d.doc, "chain"_a, "q"_a, "v"_a, py::kw_only(), "inputs"_a = none, "threads"_a = none, "errors"_a = "raise");
  else
    m.def(
        d.name,
        [d, body, q_of, v_of](py::handle chain, py::handle q, py::handle v, py::handle a, py::handle inputs,
                              py::handle threads, const std::string& errors) {
          const auto& c = chain_of(chain);
          return detail::finished(
              d, call(c, {q_of(q), v_of(v), {d.third, argument_of::v, a}}, d.results(c.chain().dofs()), d.cost,
                      options_of(inputs, threads, errors, d.name), body));
        },
        d.doc, "chain"_a, "q"_a, "v"_a, py::arg(d.third), py::kw_only(), "inputs"_a = none, "threads"_a = none,
        "errors"_a = "raise");
}

/// A function of q, (q, v) or (q, v, a) and the name of a frame: f(chain, workspace, frame, out).
template <int Arguments, class F>
void define_of_frame(py::module_& m, const definition& d, F f) {
  using namespace py::literals;
  const auto none = py::none();
  const auto run = [d, f](py::handle chain, std::initializer_list<argument> arguments, const std::string& frame,
                          py::handle threads, const std::string& errors) {
    const auto& c = chain_of(chain);
    return detail::finished(
        d, call(c, arguments, d.results(c.chain().dofs()), d.cost, options_of({}, threads, errors),
                [&f, &frame](const kte::runtime_chain& k, workspace& w, double* const* out) { f(k, w, frame, out); }));
  };
  if constexpr (Arguments == 1)
    m.def(
        d.name,
        [run](py::handle chain, py::handle q, const std::string& frame, py::handle threads, const std::string& errors) {
          return run(chain, {{"q", argument_of::q, q}}, frame, threads, errors);
        },
        d.doc, "chain"_a, "q"_a, "frame"_a, py::kw_only(), "threads"_a = none, "errors"_a = "raise");
  else if constexpr (Arguments == 2)
    m.def(
        d.name,
        [run](py::handle chain, py::handle q, py::handle v, const std::string& frame, py::handle threads,
              const std::string& errors) {
          return run(chain, {{"q", argument_of::q, q}, {"v", argument_of::v, v}}, frame, threads, errors);
        },
        d.doc, "chain"_a, "q"_a, "v"_a, "frame"_a, py::kw_only(), "threads"_a = none, "errors"_a = "raise");
  else
    m.def(
        d.name,
        [run](py::handle chain, py::handle q, py::handle v, py::handle a, const std::string& frame, py::handle threads,
              const std::string& errors) {
          return run(chain, {{"q", argument_of::q, q}, {"v", argument_of::v, v}, {"a", argument_of::v, a}}, frame,
                     threads, errors);
        },
        d.doc, "chain"_a, "q"_a, "v"_a, "a"_a, "frame"_a, py::kw_only(), "threads"_a = none, "errors"_a = "raise");
}

// Shapes of results.
inline std::vector<shape> a_number(Py_ssize_t) { return {{}}; }
inline std::vector<shape> a_vector(Py_ssize_t n) { return {{n}}; }
inline std::vector<shape> a_matrix(Py_ssize_t n) { return {{n, n}}; }
inline std::vector<shape> xyz(Py_ssize_t) { return {{3}}; }
inline std::vector<shape> two_xyz(Py_ssize_t) { return {{3}, {3}}; }
inline std::vector<shape> six_by_n(Py_ssize_t n) { return {{6, n}}; }

inline void write_vector(const Eigen::VectorXd& x, double* out) { std::copy_n(x.data(), x.size(), out); }
template <class R>
void write_rows(const R& m, double* out) {
  write_xyz(m.x, out), write_xyz(m.y, out + 3), write_xyz(m.z, out + 6);
}

}  // namespace kte_python
