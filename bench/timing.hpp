#pragma once

#include <array>
#include <string>
#include <vector>

/// What is timed, and how.
namespace bench {

/// One evaluation, out of line. x: for each degree of freedom q, then for each q_dot, then for each q_ddot or tau.
using call = void (*)(const double* x, double* y);

/// Arguments, and what must come of them. The first `rotations` results are of size 1 and judged absolutely.
struct expectation {
  std::vector<double> x;
  std::vector<long double> y;
  std::size_t rotations = 0;
};

/// The largest of max|y - y_expected| / max|y_expected| over all expectations.
double largest_error(call f, const std::vector<expectation>& expected);

/// Registers `operation/how/model`: one call an iteration, each on another of 512 random states.
void add(const std::string& operation, const std::string& how, const std::string& model, int dofs, call f,
         const std::vector<expectation>& expected);

void add_static();
void add_straightline();
void add_runtime();

}  // namespace bench
