/// The static chain of KTE_BENCH_BODIES bodies: compiled once for each number in KTE_BENCH_STATIC (CMakeLists.txt).
#include "models.hpp"
#include "static_calls.hpp"

namespace bench {
namespace {

const registered static_serial_benchmarks{[] {
  using model = serial<KTE_BENCH_BODIES>;
  add(operation::passes, "static", model::name, static_calls<model, double>::passes);
  add_algorithms<model, double>("static");
#if KTE_BENCH_BODIES <= KTE_BENCH_STATIC_DERIVATIVES
  add_derivatives<model, double>("static");
#endif
}};

}  // namespace
}  // namespace bench
