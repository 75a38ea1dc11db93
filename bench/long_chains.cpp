/// Runtime chains of 1e3 to 1e6 links: append them one by one and as chains of one, copy and move the whole, and move
/// to the last frame. The counter is the time an element, which does not grow with the chain but for caches.
#include <kte/dynamics/forward_kinematics.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/elements/rigid_link.hpp>
#include <kte/runtime_chain.hpp>

#include <benchmark/benchmark.h>

#include "timing.hpp"

namespace bench {
namespace {

std::string frame(int i) { return "frame" + std::to_string(i); }
auto link(int i) { return kte::rigid_link_3D(frame(i), frame(i + 1), kte::along_z(0.1)); }
kte::runtime_chain links(int n) {
  kte::runtime_chain c;
  c << kte::revolute_joint_3D("q", "base", frame(0), kte::axis::x);
  for (int i = 0; i < n; ++i) c << link(i);
  return c;
}
kte::runtime_chain chains_of_one(int n) {
  kte::runtime_chain c;
  c << kte::revolute_joint_3D("q", "base", frame(0), kte::axis::x);
  for (int i = 0; i < n; ++i) c << (kte::runtime_chain() << link(i));
  return c;
}

/// Times f for a chain of `of_links` links, which is made once for all calls.
template <class F>
void add_of_chain(const char* name, int n, int of_links, const F& f) {
  benchmark::RegisterBenchmark((name + ("/runtime/" + std::to_string(n))).c_str(), [=](benchmark::State& state) {
    auto c = links(of_links);
    auto s = c.make_state();
    for (auto _ : state) f(c, s);
    state.counters["an_element"] =
        benchmark::Counter(n, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  });
}

const registered long_chains_benchmarks{[] {
  for (int n = 1000; n <= 1000000; n *= 10) {
    add_of_chain("append", n, 0, [n](auto&, auto&) { benchmark::DoNotOptimize(links(n)); });
    add_of_chain("append_chains", n, 0, [n](auto&, auto&) { benchmark::DoNotOptimize(chains_of_one(n)); });
    add_of_chain("copy", n, n, [](auto& c, auto&) { benchmark::DoNotOptimize(kte::runtime_chain(c)); });
    add_of_chain("move", n, n, [](auto& c, auto&) {
      auto moved = std::move(c);
      c = std::move(moved);
    });
    add_of_chain("last_frame", n, n, [last = frame(n)](auto& c, auto& s) {
      benchmark::DoNotOptimize(kte::forward_kinematics(c, s, last));
    });
  }
}};

}  // namespace
}  // namespace bench
