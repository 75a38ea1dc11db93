/// Times kte: `kte_bench --benchmark_filter=inverse_dynamics`. Names are operation/how/model; the counter `error` is
/// the largest relative error against reference values.
#include <benchmark/benchmark.h>

#include "timing.hpp"

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  bench::add_static();
#if !defined(KTE_SCALAR_SINCOS)
  bench::add_straightline();
  bench::add_runtime();
#endif
  benchmark::RunSpecifiedBenchmarks();
}
