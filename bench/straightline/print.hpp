#pragma once

#include <cmath>

#include "straightline/traced.hpp"

namespace straightline {

/// Values printed as the statements of a C function, one operation each; those that no result needs are left out.
class printer {
 public:
  explicit printer(const std::vector<traced>& results) : wanted_(current().size()) {
    for (const auto& y : results) wanted_[y.index()] = true;
    for (std::size_t i = wanted_.size(); i-- > 0;) {
      const node& n = current()[i];
      if (!wanted_[i] || n.by == op::number || n.by == op::input) continue;
      wanted_[n.a] = true;
      if (n.by >= op::sum) wanted_[n.b] = true;
    }
  }

  void function(const char* name, const std::vector<traced>& results) const {
    std::printf("/* %zu products, %zu sums, %zu quotients, %zu sines and cosines */\n", count(op::product),
                count(op::sum) + count(op::difference), count(op::quotient), count(op::sine) + count(op::cosine));
    std::printf("void %s(const double* restrict x, double* restrict y) {\n", name);
    for (std::size_t i = 0; i < wanted_.size(); ++i)
      if (wanted_[i]) statement(i, current()[i]);
    for (std::size_t i = 0; i < results.size(); ++i) {
      std::printf("  y[%zu] = %s", i, results[i].negative() ? "-" : "");
      value(results[i].index());
      std::puts(";");
    }
    std::puts("}\n");
  }

 private:
  std::size_t count(op by) const {
    std::size_t n = 0;
    for (std::size_t i = 0; i < wanted_.size(); ++i) n += wanted_[i] && current()[i].by == by;
    return n;
  }
  static void value(std::size_t i) {
    if (const node& n = current()[i]; n.by == op::number) {
      std::printf("%.17g%s", n.number, n.number == std::trunc(n.number) ? ".0" : "");
    } else {
      std::printf("t%zu", i);
    }
  }
  static void statement(std::size_t i, const node& n) {
    if (n.by == op::number) return;
    std::printf("  const double t%zu = ", i);
    if (n.by == op::input) {
      std::printf("x[%zu]", n.a);
    } else if (n.by < op::sum) {
      std::printf("%s(t%zu)", n.by == op::sine ? "sin" : n.by == op::cosine ? "cos" : "sqrt", n.a);
    } else {
      value(n.a);
      std::printf(" %c ", n.by == op::sum ? '+' : n.by == op::difference ? '-' : n.by == op::product ? '*' : '/');
      value(n.b);
    }
    std::puts(";");
  }

  std::vector<bool> wanted_;
};

}  // namespace straightline
