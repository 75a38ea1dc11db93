#pragma once

#include <kte/dynamics/runtime/general_dynamics.hpp>

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

/// Accelerations of a chain with loops, or `bad_argument` with what its program needs.
template <class S>
const runtime_vector<S>& accelerations_with_loops(const runtime_chain& c, basic_runtime_state<S>& s) {
  if constexpr (std::is_same_v<S, double>) {
    if (accelerations_on_loops != nullptr) return accelerations_on_loops(c, s, true);
    throw bad_argument("kte: forward dynamics of a chain with closures of loops needs #include <kte/loops.hpp>");
  } else if constexpr (has_lanes_of_double<S>) {
    if (accelerations_on_loops_in_lanes<S> != nullptr) return accelerations_on_loops_in_lanes<S>(c, s);
    throw bad_argument("kte: forward dynamics of a chain with closures of loops in packs: use kte::batch, or " +
                       std::string("kte::lanes for lanes with their own parameters"));
  } else {
    refuse_first_loop(c, ": with numbers in double, forward_dynamics does");
  }
}
/// Stores the forces applied(i), which may refer to a result that the state holds, for `accelerations_at_state`.
template <class S, class Tau>
void keep_forces(basic_runtime_state<S>& s, const Tau& applied) {
  for (int i = 0; i < s.dofs(); ++i) s.work.kept[static_cast<std::size_t>(i)] = applied(i);
}
/// Forward dynamics at checked positions, under the stored forces (`keep_forces`). Rows in `prescribed` take their
/// accelerations from the state, in chains without loops.
template <class S>
const runtime_vector<S>& accelerations_at_state(const runtime_chain& c, basic_runtime_state<S>& s,
                                                std::span<const char> prescribed = {}) {
  refuse_contacts(c);
  if (has_loops(c)) [[unlikely]]
    return accelerations_with_loops(c, s);
  const auto& kept = s.work.kept;
  accelerations_on_coordinates(runtime_elements{c}, s, tree::given_forces(kept.data()), prescribed);
  check_result(s, [&] {
    diagnose("an acceleration", s, runtime_vector<S>(Eigen::Map<const runtime_vector<S>>(kept.data(), s.dofs())));
  });
  write_numbers<vector_of::a>(s, s.work.forces, "a");
  return s.work.forces;
}

#ifdef KTE_EXTERN
KTE_EXTERN template void accelerations_on_coordinates(const runtime_elements&, runtime_state&,
                                                      const tree::given_forces<double>&, std::span<const char>);
KTE_EXTERN template const runtime_vector<double>& accelerations_at_state(const runtime_chain&, runtime_state&,
                                                                         std::span<const char>);
#endif

}  // namespace kte::detail
