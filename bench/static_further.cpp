/// Energies, momenta and further matrices of static chains.
#include "further_operations.hpp"
#include "models.hpp"
#include "static_calls.hpp"

namespace bench {
namespace {

const registered static_further_benchmarks{[] {
  add_further<static_calls<iiwa14, double>>("static", iiwa14::name);
  add_further<static_calls<ur5, double>>("static", ur5::name);
}};

}  // namespace
}  // namespace bench
