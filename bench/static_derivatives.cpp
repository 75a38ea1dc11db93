/// Static chains: the inverse of the mass matrix, derivatives, the regressor. A separate file, because it takes long to
/// compile.
#include "models.hpp"
#include "static_calls.hpp"

namespace bench {
namespace {

const registered static_derivatives_benchmarks{[] {
  add_derivatives<pendulum, double>("static");
  add_derivatives<iiwa14, double>("static");
  add_derivatives<ur5, double>("static");
  add(operation::regressor, "static", iiwa14::name, static_calls<iiwa14, double>::regressor);
}};

}  // namespace
}  // namespace bench
