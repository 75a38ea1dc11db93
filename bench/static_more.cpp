/// Energies, momenta and further matrices of static chains.
#include "models.hpp"
#include "static_calls.hpp"

namespace bench {
namespace {

const registered static_more_benchmarks{[] {
  add_more<iiwa14, double>("static");
  add_more<ur5, double>("static");
}};

}  // namespace
}  // namespace bench
