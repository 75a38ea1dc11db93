/// The static chain of a robot that floats, with general inertias.
#include "panda_hyq.hpp"
#include "static_calls.hpp"

namespace bench {
namespace {

const registered static_hyq_benchmarks{[] {
  using calls = static_calls<hyq, double>;
  add(operation::inverse_dynamics, "static", hyq::name, calls::inverse_dynamics);
  add(operation::mass_matrix, "static", hyq::name, calls::mass_matrix);
  add(operation::forward_dynamics, "static", hyq::name, calls::forward_dynamics);
}};

}  // namespace
}  // namespace bench
