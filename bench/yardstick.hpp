#pragma once

#include <benchmark/benchmark.h>

namespace bench {

/// Compares the loop of a benchmark with straight-line inverse dynamics of the iiwa14, run just before and just after
/// it: a machine that others share is by a third faster or slower from one second to the next, and for minutes. Two
/// counters: `yardstick`, CPU time of one such evaluation, ns; `yardsticks`, how many of them an iteration took.
class against_yardstick {
 public:
  explicit against_yardstick(benchmark::State& state);
  ~against_yardstick();
  against_yardstick(const against_yardstick&) = delete;

 private:
  benchmark::State& state_;
  double before_, begin_;
};

}  // namespace bench
