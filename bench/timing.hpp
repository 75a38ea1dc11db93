#pragma once

#include <array>
#include <string>
#include <vector>

#include "operation.hpp"

/// Operations that are timed, and the measurement.
namespace bench {

/// One evaluation, out of line, of one state or of B states. x: the configurations q of all B states, then their
/// velocities v, then their accelerations a (forces tau for forward dynamics); y: the results, state after state,
/// matrices by columns. Of packs, in both the first numbers of all states come first, then the second ones. As
/// everything is written to memory, compilers drop nothing.
template <class S>
using call = void (*)(const S* x, S* y);

/// The expected results at a state: blocks that are compared separately, such as the matrices of derivatives.
struct expectation {
  std::array<std::vector<double>, 3> x;  ///< q, v, and a or tau
  std::vector<std::vector<long double>> y;
};

/// Registers `operation/how/model`: time of one state, each time another of up to 512 random ones. The counter `error`
/// is the largest of max|y - expected| / max|expected| over all blocks and expectations (expected.hpp). S: float,
/// double, long double.
template <class S>
void add(operation o, const std::string& how, const std::string& model, call<S> f, int states = 1,
         triangle t = triangle::both, bool packed = false);

/// A file of benchmarks registers itself: `const registered NAME_benchmarks{[] { add(...); }};`. So a program has what
/// is linked to it, and nobody keeps a list.
struct registered {
  explicit registered(void (*f)());
};
void register_all();

}  // namespace bench
