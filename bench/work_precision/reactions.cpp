/// Stiff equations with their Jacobians.
#include "data/problems/hires.hpp"
#include "data/problems/orego.hpp"
#include "data/problems/rober.hpp"
#include "data/problems/vdpol.hpp"
#include "equations.hpp"

namespace work_precision {
namespace {

using namespace kte::problems;

/// The error is the largest of any component relative to it. Sizes: see introduction.md.
template <class Problem>
void add_stiff(std::vector<problem>& all, const char* name, const vector<Problem::size>& sizes) {
  static constexpr int n = Problem::size;
  static constexpr equations_with_jacobian<n> f{{rate_of<Problem>}, jacobian_of<Problem>};
  auto t = task_of<Problem>();
  t.judge = [](const vector<n>& x) {
    return judgement{largest_relative_error(x, Problem::reference), none, none, none};
  };
  t.sizes = sizes;
  auto& p = all.emplace_back(problem{name, t.t_end, 0});
  entrants<equations_with_jacobian<n>, vector<n>>(p, f, t).add_stiff();
}
/// Components at the end.
template <class Problem>
vector<Problem::size> last() {
  vector<Problem::size> x;
  for (int i = 0; i < Problem::size; ++i) x[i] = static_cast<double>(std::fabs(Problem::reference[i]));
  return x;
}

}  // namespace

void add_reactions(std::vector<problem>& all) {
  add_stiff<hires<>>(all, "hires", last<hires<>>());
  add_stiff<vdpol<>>(all, "vdpol", {1, 1e-3});
  add_stiff<orego<>>(all, "orego", {1, 1e-2, 1});
  add_stiff<rober<>>(all, "rober", last<rober<>>());
}

}  // namespace work_precision
