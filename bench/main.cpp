/// Times kte: `kte_bench --benchmark_filter=inverse_dynamics`. Names are operation/how/model; the counter `error` is
/// the largest relative error against reference values.
#include <benchmark/benchmark.h>

#include "timing.hpp"

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  bench::register_all();
  benchmark::RunSpecifiedBenchmarks();
}
