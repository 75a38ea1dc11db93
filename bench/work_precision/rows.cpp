#include "rows.hpp"

#include <cmath>
#include <cstdio>

namespace work_precision {
namespace {

std::string text(double x) {
  if (std::isnan(x)) return "-";
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.4g", x);
  return digits;
}

}  // namespace

void print(const problem& p, const row& r) {
  const auto& c = r.cost;
  const std::string error = r.failure.empty() ? text(r.how_good.error) : "failed";
  std::printf("%s %s %.6g %s %.6g %lld %lld %lld %lld %lld %s %s %s%s\n", p.name.c_str(), r.by->method.c_str(),
              r.setting, error.c_str(), r.median_seconds(), c.evaluations, c.steps, c.rejected, c.jacobians,
              c.factorizations, text(r.how_good.energy).c_str(), text(r.how_good.momentum).c_str(),
              text(r.how_good.norm).c_str(), r.failure.empty() ? "" : (" # " + r.failure).c_str());
}

}  // namespace work_precision
