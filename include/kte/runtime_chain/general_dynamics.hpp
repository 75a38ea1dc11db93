#pragma once

#include <kte/contract/element_core.hpp>
#include <kte/detail/function_ref.hpp>

#include <atomic>
#include <span>

namespace kte {
class runtime_chain;
}  // namespace kte

/// Forward dynamics for chains that are not trees of joints. It takes a quarter of the compile time of a small program,
/// and few chains need it, so who needs it brings it.
namespace kte::detail {

/// Forces by row of the degree of freedom, N or Nm.
using forces_by_row = function_ref<double(int)>;

/// Whether chains with such an element may need it: coordinates follow others, masses are between several ports,
/// friction depends on loads, or a part of a joint is locked.
template <class Core>
inline constexpr bool needs_general_dynamics =
    writes_coordinate<Core> || distributed_mass<Core> || load_dependent_friction<Core> || locks_coordinate<Core>;

/// What forward dynamics calls for such chains; a template, so that headers do not instantiate its members.
template <class State>
struct general_dynamics {
  using function = void(const runtime_chain&, State&, forces_by_row, std::span<const char> prescribed, bool tree);
  static inline std::atomic<function*> known = nullptr;
  /// Sets it (dynamics/runtime/general_dynamics.hpp). Called for elements that need it, by hybrid dynamics, by
  /// kte/shared_coordinates.hpp and by kte::compiled.
  static void bring();
};

}  // namespace kte::detail
