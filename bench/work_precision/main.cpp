/// Error against CPU time of all integrators: `kte_work_precision [--quick] [WORD...]`, of problems that have one of
/// the words in their name, as lines of rows.hpp. `--quick`: once each, without those that take long.
/// `--long-time`, `--overhead`: see more.hpp.
#include <algorithm>
#include <cstdio>
#include <string_view>

#include "more.hpp"
#include "rows.hpp"

namespace {

using namespace work_precision;

std::vector<problem> all_problems() {
  std::vector<problem> all;
  add_planar(all), add_spherical(all), add_bodies(all), add_robots(all), add_stars(all);
  add_reactions(all), add_governor(all), add_closed_loops(all);
  return all;
}

/// These three take longer than all others.
bool takes_long(const problem& p) {
  return p.name == "closed_loops_four_bars_40" || p.name == "dzhanibekov" || p.name == "flyball_governor";
}

}  // namespace

int main(int count, char** texts) {
  const std::vector<std::string_view> words(texts + 1, texts + count);
  const auto given = [&](std::string_view w) { return std::find(words.begin(), words.end(), w) != words.end(); };
  const bool quick = given("--quick");
  if (given("--long-time") || quick) print_long_time(quick ? 1000 : 1000000);
  if (given("--overhead") || quick) print_overhead(quick ? 1 : 51);
  if (given("--long-time") || given("--overhead")) return 0;

  const bool some = std::any_of(words.begin(), words.end(), [](std::string_view w) { return !w.starts_with("--"); });
  for (const problem& p : all_problems()) {
    if (quick && takes_long(p)) continue;
    if (some && std::none_of(words.begin(), words.end(),
                             [&](std::string_view w) { return p.name.find(w) != std::string::npos; }))
      continue;
    for (const row& r : measure(p, {.quick = quick, .longest = 0.3})) print(p, r);
    std::fflush(stdout);
  }
}
