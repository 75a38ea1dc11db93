/// Eight states at once, in packs of doubles.
#include "models.hpp"
#include "packs.hpp"

namespace bench {
namespace {

const registered batch8_benchmarks{[] {
  using calls = pack_calls<iiwa14, double, 8>;
  add(operation::inverse_dynamics, "batch8", iiwa14::name, calls::inverse_dynamics, calls::states);
  add(operation::mass_matrix, "batch8", iiwa14::name, calls::mass_matrix, calls::states);
}};

}  // namespace
}  // namespace bench
