/// The static chain of a robot with general inertias and a hand of two fingers.
#include "panda_hyq.hpp"
#include "static_calls.hpp"

namespace bench {
namespace {

const registered static_panda_benchmarks{[] {
  using calls = static_calls<panda, double>;
  add(operation::inverse_dynamics, "static", panda::name, calls::inverse_dynamics);
  add(operation::mass_matrix, "static", panda::name, calls::mass_matrix);
  add(operation::forward_dynamics, "static", panda::name, calls::forward_dynamics);
}};

}  // namespace
}  // namespace bench
