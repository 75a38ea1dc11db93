/// Extended precision.
#include "models.hpp"
#include "static_calls.hpp"

namespace bench {
namespace {

const registered long_double_benchmarks{[] { add_algorithms<iiwa14, long double>("long_double"); }};

}  // namespace
}  // namespace bench
