#include "measure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <time.h>

namespace work_precision {

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double row::median_seconds() const {
  auto s = seconds;
  const auto middle = s.begin() + static_cast<std::ptrdiff_t>(s.size() / 2);
  std::nth_element(s.begin(), middle, s.end());
  return *middle;
}

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double setting_of(const problem& p, const contender& c, int i) {
  return c.step_ratio == 0 ? std::pow(10, -3 - i) : p.t_end / (p.steps * std::pow(c.step_ratio, i));
}

row try_once(contender& c, double setting) {
  row r{&c, setting, {infinity, NAN, NAN, NAN}, {}, {}};
  const double before = cpu_seconds();
  try {
    c.integrate(setting);
    r.seconds = {cpu_seconds() - before};
    r.how_good = c.judge();
  } catch (const std::exception& e) {
    r.failure = e.what();
    r.seconds = {cpu_seconds() - before};
  }
  r.cost = c.cost;
  return r;
}

/// Until three settings in turn are no better than the best before, nor than the one before: that is its floor.
void refine(const problem& p, contender& c, const effort& e, std::vector<row>& rows) {
  constexpr double promising = 1e-4;  // errors before may be those of another motion
  double best = infinity, before = infinity, last = 0;
  int worse = 0;
  const int settings = c.step_ratio == 0 ? 12 : 24;
  for (int i = 0; i < settings && worse < 3; ++i) {
    const row& r = rows.emplace_back(try_once(c, setting_of(p, c, i)));
    const double s = r.seconds.front(), growth = c.step_ratio != 0 ? c.step_ratio : last > 0 ? s / last : 1;
    const double error = r.how_good.error;
    worse = best < promising && error > best / 1.5 && error > before / 1.5 ? worse + 1 : 0;
    best = std::min(best, error), before = error;
    last = s;
    if (s * growth > (p.longest > 0 ? p.longest : e.longest)) return;
  }
}

void repeat(row& r) {
  constexpr double least = 2e-3;  // s that a time is of
  const double once = r.seconds.front();
  const int n = once > least ? 1 : static_cast<int>(least / once) + 1;
  const double before = cpu_seconds();
  for (int i = 0; i < n; ++i) r.by->integrate(r.setting);
  r.seconds.push_back((cpu_seconds() - before) / n);
}
/// How often an integration is timed, in addition to the first time.
int repetitions_of(const row& r) {
  const double once = r.seconds.front();
  return !r.failure.empty() ? 0 : once > 0.1 ? 1 : once > 0.02 ? 2 : 6;
}

void time_all(std::vector<row>& rows) {
  std::vector<row*> turns;
  for (row& r : rows) turns.insert(turns.end(), static_cast<std::size_t>(repetitions_of(r)), &r);
  std::shuffle(turns.begin(), turns.end(), std::mt19937(1));
  for (row* r : turns) repeat(*r);
}

}  // namespace

std::vector<row> measure(const problem& p, const effort& e) {
  std::vector<row> rows;
  for (const auto& c : p.contenders) {
    if (e.quick) {
      if (p.name == "rober" && c->method == "trapezoidal") continue;  // stops there after 3e6 steps, most of all work
      rows.push_back(try_once(*c, setting_of(p, *c, 1)));
    } else {
      refine(p, *c, e, rows);
    }
  }
  if (!e.quick) time_all(rows);
  return rows;
}

}  // namespace work_precision
