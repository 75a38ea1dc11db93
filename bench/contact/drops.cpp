/// Random drops by events (tests/simulations/drops.hpp), and their outcomes: a table for docs/contact.md. Drops that
/// fail or need bridges go to standard error.
///
///   kte_drops [COUNT [FIRST]]      by default 1000 drops from number 0
#include "simulations/drops.hpp"

#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace {

/// The outcomes on one surface.
struct results {
  std::vector<double> steps, milliseconds;
  int failed = 0, bridged = 0;
  double penetration = 0, gain = 0;

  void add(const kte::test::drops::outcome& out, double ms) {
    steps.push_back(static_cast<double>(out.steps)), milliseconds.push_back(ms);
    failed += !out.failure.empty(), bridged += out.bridges > 0;
    penetration = std::max(penetration, out.penetration), gain = std::max(gain, out.gain);
  }
};
double median(std::vector<double> of) {
  std::sort(of.begin(), of.end());
  return of[of.size() / 2];
}

}  // namespace

int main(int count, char** texts) {
  using namespace kte::test::drops;
  const unsigned drops = count > 1 ? static_cast<unsigned>(std::atoi(texts[1])) : 1000;
  const unsigned first = count > 2 ? static_cast<unsigned>(std::atoi(texts[2])) : 0;
  results all[std::size(surfaces)];
  for (unsigned number = first; number < first + drops; ++number) {
    const auto drop = drop_of(number);
    const std::clock_t begin = std::clock();
    const auto out = simulate(drop.what, drop.tolerance);
    all[drop.surface].add(out, 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    if (!out.failure.empty() || out.bridges > 0 || out.penetration > 1e-8 || out.gain > 1e-12)
      std::fprintf(stderr, "%u, tolerance %.1e, %lld steps, %lld bridges, penetration %.1e, gain %.1e: %s%s\n", number,
                   drop.tolerance, out.steps, out.bridges, out.penetration, out.gain, out.failure.c_str(),
                   out.bridge.c_str());
  }
  std::printf(
      "| surface | drops | fail | bridged | steps, median, most | penetration, of the size | gain of energy at an "
      "event, relative | ms, median |\n|-|-|-|-|-|-|-|-|\n");
  int failed = 0;
  for (std::size_t i = 0; i < std::size(surfaces); ++i) {
    const auto& r = all[i];
    if (r.steps.empty()) continue;
    std::printf("| %s | %zu | %d | %d | %.0f, %.0f | %.1e | %.1e | %.3g |\n", surfaces[i], r.steps.size(), r.failed,
                r.bridged, median(r.steps), *std::max_element(r.steps.begin(), r.steps.end()), r.penetration, r.gain,
                median(r.milliseconds));
    failed += r.failed;
  }
  return failed > 0;
}
