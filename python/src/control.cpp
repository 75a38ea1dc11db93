#include <kte/control.hpp>
#include <kte/models/manipulator_dynamics_model.hpp>
#include <kte/models/runtime_models.hpp>

#include <pybind11/stl.h>

#include "one_state.hpp"
#include "parts.hpp"
#include "sweep_columns.hpp"

namespace kte_python {

namespace {

Eigen::MatrixXd any_matrix_from(const char* name, py::handle x) {
  const auto a = py::array::ensure(x);
  if (!a || a.ndim() != 2) throw kte::bad_argument(std::string("kte: ") + name + " is not a matrix");
  return matrix_from(name, x, a.shape(0), a.shape(1));
}

}  // namespace

void bind_control(py::module_& m) {
  using namespace py::literals;
  m.def(
      "linearize",
      [](py::handle chain, py::handle q, py::handle v, py::handle inputs, double t) {
        const auto& c = chain_of(chain).chain();
        const auto at = vector_from("q", q, c.nq());
        const Eigen::VectorXd rates =
            v.is_none() ? Eigen::VectorXd(Eigen::VectorXd::Zero(c.dofs())) : vector_from("v", v, c.dofs());
        const Eigen::VectorXd u =
            inputs_from(c, inputs.is_none() ? py::object(py::none()) : dict_from("inputs", "names to numbers", inputs));
        const auto r = run_interruptibly([&] {
          kte::manipulator_dynamics_model<kte::runtime_chain> model(c);
          model.setInput(u);
          return kte::linearize(model, model.make_x(at, rates), t);
        });
        return result("LinearSystem",
                      py::make_tuple(to_array(r.A), to_array(r.B), to_array(r.x_dot), names_of_inputs(c)));
      },
      R"(linearize(chain, q, v=None, *, inputs=None, t=0.0)

The motion near a state under its inputs, a `LinearSystem`: d' = x_dot + A d + B du. d are displacements along the numbers
of v, as `difference` gives them, then their rates, then internal states of elements; u are the inputs, in the order of
`.inputs`. Exact: derivatives of dynamics, and dual numbers. The state need not be an equilibrium; there x_dot is zero.
`discretize` samples the system, `lqr` finds a feedback.)",
      "chain"_a, "q"_a, "v"_a = py::none(), py::kw_only(), "inputs"_a = py::none(), "t"_a = 0.0);
  m.def(
      "_discretize",
      [](py::handle a, py::handle b, py::handle x_dot, double dt) {
        kte::linear_system<> s;
        s.A = any_matrix_from("A", a), s.B = any_matrix_from("B", b), s.x_dot = vector_from("x_dot", x_dot, -1);
        const auto d = kte::discretize(s, dt);
        return py::make_tuple(to_array(d.A), to_array(d.B), to_array(d.step));
      },
      "A"_a, "B"_a, "x_dot"_a, "dt"_a);
  m.def(
      "_lqr",
      [](py::handle a, py::handle b, py::handle q, py::handle r, py::handle n, bool discrete) {
        const auto all = {any_matrix_from("A", a), any_matrix_from("B", b), any_matrix_from("Q", q),
                          any_matrix_from("R", r), any_matrix_from("N", n)};
        const Eigen::MatrixXd* const x = all.begin();
        const auto gain = run_interruptibly([&] {
          return discrete ? kte::dlqr(x[0], x[1], x[2], x[3], x[4]) : kte::lqr(x[0], x[1], x[2], x[3], x[4]);
        });
        return py::make_tuple(to_array(gain.K), to_array(gain.X), complex_array(gain.poles, true));
      },
      "A"_a, "B"_a, "Q"_a, "R"_a, "N"_a, "discrete"_a);
}

}  // namespace kte_python
