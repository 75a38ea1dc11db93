#pragma once

#include <kte/dynamics/runtime/vectors.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace kte {

/// The closures of a chain at a configuration.
struct loops_report {
  int rows = 0;      ///< number of rows of all closures
  int rank = 0;      ///< number of independent rows
  int mobility = 0;  ///< remaining degrees of freedom: dofs - rank
  /// The smallest pivot of independent rows over the largest, for the block where this ratio is smallest; it tends to
  /// zero near singular configurations. 1 without rows.
  double pivot_ratio = 1;
  double gap = 0;                      ///< the largest residual, m or rad
  std::string widest;                  ///< the closure with this residual
  std::vector<std::string> dependent;  ///< rows that follow from others: "pin[2]", or "pin" of a closure of one row
  std::vector<std::string> blocks;     ///< closures that share degrees of freedom, in a text: "pin, slot"
};

/// The result of `constrained_dynamics`. `rank`: the number of independent rows of closures; `mobility`: the remaining
/// degrees of freedom, dofs - rank.
struct constrained_dynamics_result {
  Eigen::VectorXd a;  ///< accelerations
  /// The force of a closure, N and Nm, by its rows (frames/loop_state.hpp). Throws `unknown_name`.
  const loop_state<>& loop(std::string_view name) const {
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i] == name) return loops[i];
    throw unknown_name("kte: this chain has no closure '" + std::string(name) + "'");
  }
  int rank = 0, mobility = 0;
  double gap = 0;                      ///< the largest residual, m or rad: above rounding, q is off the loops
  std::vector<std::string> dependent;  ///< redundant rows, which have no force

  std::vector<std::string> names;  ///< of closures, in order
  std::vector<loop_state<>> loops;
};

namespace detail {
/// A text or a key.
template <class Name>
std::string text_of_name(const Name& name) {
  if constexpr (key_type<Name>)
    return std::string(Name::name);
  else
    return std::string(std::string_view(name));
}
}  // namespace detail

/// The `names` of actuated coordinates, an argument of `inverse_dynamics` of a chain with loops.
struct actuated_coordinates {
  std::vector<std::string> names;
};
/// The actuated coordinates, texts or keys, an argument of `inverse_dynamics` of a chain with loops.
template <class... Text>
actuated_coordinates actuated(const Text&... names) {
  return {{detail::text_of_name(names)...}};
}
/// The `names` of coordinates that `assemble` does not change.
struct held_coordinates {
  std::vector<std::string> names;
};
/// The coordinates, texts or keys, that `assemble` does not change.
template <class... Text>
held_coordinates held(const Text&... names) {
  return {{detail::text_of_name(names)...}};
}

/// A parameter of a closure, by the name of its loop:
///
///   "length", "factor1", "factor2", "constant"    of `distance`, `coupled_coordinates`
///   "frame1.x", "frame1.y", "frame1.z"            for a closure of frames: the displacement of frame1 on its body, m,
///                                                 in its axes; "frame2.x" ... likewise
///   "frame1.rx", "frame1.ry", "frame1.rz"         its rotation about its axes, rad
struct closure_parameter {
  std::string closure, parameter;
};

}  // namespace kte
