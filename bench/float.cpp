/// Single precision: one state, and sixteen at once in packs. Errors count the rounding of the arguments to float.
#include "models.hpp"
#include "packs.hpp"
#include "static_calls.hpp"

namespace bench {
namespace {

const registered float_benchmarks{[] {
  add_algorithms<iiwa14, float>("float");
  using calls = pack_calls<iiwa14, float, 16>;
  add(operation::inverse_dynamics, "batch16_float", iiwa14::name, calls::inverse_dynamics, calls::states);
  add(operation::mass_matrix, "batch16_float", iiwa14::name, calls::mass_matrix, calls::states);
}};

}  // namespace
}  // namespace bench
