#pragma once

#include <kte/dynamics/runtime/algorithms.hpp>

/// Forward dynamics of runtime chains with or without loops.
namespace kte::detail {

/// Accelerations of a chain with loops under the forces `kept` in the working memory; `assembled`: refuses loops that
/// are not assembled. kte/loops.hpp sets the pointer, so that programs without loops do not compile this; kte::compiled
/// sets it too.
inline const Eigen::VectorXd& (*accelerations_on_loops)(const runtime_chain&, runtime_state&, bool assembled) = nullptr;
#ifdef KTE_EXTERN
/// In kte::compiled (loop_dynamics.hpp).
const Eigen::VectorXd& kept_accelerations_on_loops(const runtime_chain&, runtime_state&, bool assembled);
#  ifdef KTE_FUNCTION
inline const bool loops_are_known = (accelerations_on_loops = kept_accelerations_on_loops, true);
#  endif
#endif
/// Those of packs of states; set by `kte::lanes` (dynamics/lanes.hpp) and by batches.
template <class S>
inline const runtime_vector<S>& (*accelerations_on_loops_in_lanes)(const runtime_chain&,
                                                                   basic_runtime_state<S>&) = nullptr;

/// At checked positions, under the stored forces (`keep_forces`).
template <class S>
const runtime_vector<S>& accelerations_of_chain(const runtime_chain& c, basic_runtime_state<S>& s) {
  refuse_contacts(c);
  if constexpr (std::is_same_v<S, double>)
    if (has_loops(c)) [[unlikely]] {
      if (accelerations_on_loops == nullptr)
        throw bad_argument("kte: forward dynamics of a chain with closures of loops needs #include <kte/loops.hpp>");
      return accelerations_on_loops(c, s, true);
    }
  if constexpr (has_lanes_of_double<S>)
    if (has_loops(c)) [[unlikely]] {
      if (accelerations_on_loops_in_lanes<S> == nullptr)
        throw bad_argument("kte: forward dynamics of a chain with closures of loops in packs: use kte::batch, or " +
                           std::string("kte::lanes for lanes with their own parameters"));
      return accelerations_on_loops_in_lanes<S>(c, s);
    }
  return accelerations_under_kept(c, s);
}

}  // namespace kte::detail
