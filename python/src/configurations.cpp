#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/configurations.hpp>

#include <random>

#include "arrays.hpp"
#include "chain.hpp"
#include "parts.hpp"

namespace kte_python {

namespace {
Eigen::VectorXd q_from(const char* name, py::handle x, const kte::runtime_chain& c) {
  return vector_from(name, x, c.nq());
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
        const auto& c = chain_of(chain).chain();
        return to_array(kte::integrate(c, q_from("q", q, c), vector_from("v", v, c.dofs()), dt));
      },
      "integrate(chain, q, v, dt=1.0)\n\nThe configuration after time dt, s, at constant v, on the group.", "chain"_a,
      "q"_a, "v"_a, "dt"_a = 1.0);
  m.def(
      "difference",
      [](py::handle chain, py::handle q0, py::handle q1) {
        const auto& c = chain_of(chain).chain();
        return to_array(kte::difference(c, q_from("q0", q0, c), q_from("q1", q1, c)));
      },
      "difference(chain, q0, q1)\n\nThe v for which `integrate` gets from q0 to q1 in unit time.", "chain"_a, "q0"_a,
      "q1"_a);
  m.def(
      "interpolate",
      [](py::handle chain, py::handle q0, py::handle q1, double t) {
        const auto& c = chain_of(chain).chain();
        return to_array(kte::interpolate(c, q_from("q0", q0, c), q_from("q1", q1, c), t));
      },
      "interpolate(chain, q0, q1, t)\n\nThe configuration between q0 (t = 0) and q1 (t = 1) at constant rates.",
      "chain"_a, "q0"_a, "q1"_a, "t"_a);
  m.def(
      "random_configuration",
      [](py::handle chain, py::handle lower, py::handle upper, unsigned long long seed) {
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
        return to_array(kte::random_configuration(c, engine, limit("lower", lower), limit("upper", upper)));
      },
      R"(random_configuration(chain, lower, upper, seed)

A configuration with numbers uniform between limits, which are arrays over q or numbers, and arbitrary rotations. Equal
seeds give equal configurations.)",
      "chain"_a, "lower"_a, "upper"_a, "seed"_a);
}

}  // namespace kte_python
