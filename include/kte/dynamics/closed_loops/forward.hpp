#pragma once

#include <kte/dynamics/runtime/algorithms.hpp>

#ifdef KTE_FUNCTION
#  include <kte/dynamics/closed_loops/loop_dynamics.hpp>
#endif

/// Forward dynamics of runtime chains, whether they have loops or not.
namespace kte::detail {

/// `constrained_accelerations` under the forces that are `kept` in the working memory.
const Eigen::VectorXd& constrained_accelerations_under_kept(const runtime_chain& c, runtime_state& s);
#ifdef KTE_FUNCTION
KTE_FUNCTION const Eigen::VectorXd& constrained_accelerations_under_kept(const runtime_chain& c, runtime_state& s) {
  const std::vector<double> applied = s.work.kept;
  return constrained_accelerations(c, s, [&applied](int i) { return applied[static_cast<std::size_t>(i)]; });
}
#endif

/// At positions that are good, under applied(i).
template <class S, class Tau>
const runtime_vector<S>& accelerations_of_chain(const runtime_chain& c, basic_runtime_state<S>& s, const Tau& applied) {
  if constexpr (std::is_same_v<S, double>)
    if (has_loops(c)) [[unlikely]] {
      for (int i = 0; i < s.dofs(); ++i) s.work.kept[static_cast<std::size_t>(i)] = applied(i);
      return constrained_accelerations_under_kept(c, s);
    }
  return accelerations_under(c, s, applied);
}

}  // namespace kte::detail
