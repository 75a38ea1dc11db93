/// Forward dynamics of batches, and packs themselves.
#include "models.hpp"
#include "packs.hpp"

namespace bench {
namespace {

const registered packs_forward_benchmarks{[] {
  using eight_doubles = pack_calls<iiwa14, double, 8>;
  add(operation::forward_dynamics, "batch8", iiwa14::name, eight_doubles::forward_dynamics, eight_doubles::states);
  using sixteen_floats = pack_calls<iiwa14, float, 16>;
  add(operation::forward_dynamics, "batch16_float", iiwa14::name, sixteen_floats::forward_dynamics,
      sixteen_floats::states);
  packed_calls<iiwa14, double, 8>::add("pack8");
  packed_calls<iiwa14, double, 16>::add("pack16");
  packed_calls<iiwa14, float, 16>::add("pack16_float");
}};

}  // namespace
}  // namespace bench
