#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/configurations.hpp>
#include <kte/dynamics/reduced.hpp>

#include <optional>
#include <pybind11/stl.h>
#include <random>

#include "define.hpp"
#include "parts.hpp"

namespace kte_python {

namespace {

/// A function of two arguments that gives a configuration, or a velocity if `of_v`.
template <class F>
py::object of_two(py::handle chain, const argument& x, const argument& y, argument_of what, const F& f) {
  const auto& c = chain_of(chain);
  const Py_ssize_t size = what == argument_of::q ? c.chain().nq() : c.chain().dofs();
  return call(c, {x, y}, {{size}}, 0.5, {}, [&f](const kte::runtime_chain& k, workspace& w, double* const* out) {
    write_vector(f(k, w.x[0], w.x[1]), out[0]);
  });
}

}  // namespace

void bind_configurations(py::module_& m) {
  using namespace py::literals;
  m.def(
      "neutral_configuration",
      [](py::handle chain) { return to_array(kte::neutral_configuration(chain_of(chain).chain())); },
      "neutral_configuration(chain)\n\nq with all numbers 0 and all rotations the identity.", "chain"_a);
  m.def(
      "integrate",
      [](py::handle chain, py::handle q, py::handle v, double dt) {
        return of_two(chain, {"q", argument_of::q, q}, {"v", argument_of::v, v}, argument_of::q,
                      [dt](const auto& c, const auto& x, const auto& y) { return kte::integrate(c, x, y, dt); });
      },
      "integrate(chain, q, v, dt=1.0)\n\nThe configuration after time dt, s, at constant v, on the group; of one state "
      "or of several, (..., n).",
      "chain"_a, "q"_a, "v"_a, "dt"_a = 1.0);
  m.def(
      "difference",
      [](py::handle chain, py::handle q0, py::handle q1) {
        return of_two(chain, {"q0", argument_of::q, q0}, {"q1", argument_of::q, q1}, argument_of::v,
                      [](const auto& c, const auto& x, const auto& y) { return kte::difference(c, x, y); });
      },
      "difference(chain, q0, q1)\n\nThe v for which `integrate` gets from q0 to q1 in unit time; of several too.",
      "chain"_a, "q0"_a, "q1"_a);
  m.def(
      "interpolate",
      [](py::handle chain, py::handle q0, py::handle q1, double t) {
        return of_two(chain, {"q0", argument_of::q, q0}, {"q1", argument_of::q, q1}, argument_of::q,
                      [t](const auto& c, const auto& x, const auto& y) { return kte::interpolate(c, x, y, t); });
      },
      "interpolate(chain, q0, q1, t)\n\nThe configuration between q0 (t = 0) and q1 (t = 1) at constant rates; of "
      "several too.",
      "chain"_a, "q0"_a, "q1"_a, "t"_a);
  m.def(
      "random_configuration",
      [](py::handle chain, py::handle lower, py::handle upper, unsigned long long seed,
         std::optional<Py_ssize_t> n) -> py::object {
        const auto& c = chain_of(chain).chain();
        std::mt19937_64 engine(seed);
        const auto limit = [&c](const char* name, py::handle x) {
          auto all = vector_from(name, x, -1);
          if (all.size() == 1) all = Eigen::VectorXd::Constant(c.nq(), all[0]).eval();
          if (all.size() != c.nq())
            throw kte::bad_argument(std::string("kte: ") + name + " has shape (" + std::to_string(all.size()) +
                                    ",), expected (" + std::to_string(c.nq()) + ",) or a number");
          return all;
        };
        const Eigen::VectorXd least = limit("lower", lower), most = limit("upper", upper);
        const auto one = [&] { return kte::random_configuration(c, engine, least, most); };
        if (!n) return to_array(one());
        if (*n < 0) throw kte::bad_argument("kte: n must not be negative, got " + std::to_string(*n));
        array all({*n, static_cast<Py_ssize_t>(c.nq())});
        for (Py_ssize_t i = 0; i < *n; ++i) write_vector(one(), all.mutable_data(i, 0));
        return py::object(std::move(all));
      },
      R"(random_configuration(chain, lower, upper, seed, n=None)

A configuration with numbers uniform between limits, which are arrays over q or numbers, and arbitrary rotations; n of
them, (n, nq). Equal seeds give equal configurations.)",
      "chain"_a, "lower"_a, "upper"_a, "seed"_a, "n"_a = py::none());
  m.def(
      "reduced",
      [](py::handle chain, py::handle q, py::handle locked) {
        const auto& c = chain_of(chain).chain();
        return std::make_unique<chain_object>(kte::reduced(c, vector_from("q", q, c.nq()), names_from(locked)));
      },
      R"(reduced(chain, q, locked)

A chain without the named degrees of freedom: their joints become links, fixed at q. Other coordinates keep their names
and order.)",
      "chain"_a, "q"_a, "locked"_a);
}

}  // namespace kte_python
