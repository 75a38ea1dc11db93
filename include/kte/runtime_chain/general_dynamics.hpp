#pragma once

#include <kte/contract/element_core.hpp>
#include <kte/tree/given_forces.hpp>

#include <atomic>
#include <span>

namespace kte {
class runtime_chain;
}  // namespace kte

/// Forward dynamics for chains that are not trees of joints. It takes a quarter of the compile time of a small program,
/// and few chains need it, so who needs it brings it.
namespace kte::detail {

/// Whether chains with such an element may need it: coordinates follow others, masses are between several ports,
/// friction depends on loads, or a part of a joint is locked.
template <class Core>
inline constexpr bool needs_general_dynamics =
    writes_coordinate<Core> || distributed_mass<Core> || load_dependent_friction<Core> || locks_coordinate<Core>;

/// What forward dynamics calls for such chains; a template, so that headers do not instantiate its members.
template <class State>
struct general_dynamics {
  using function = void(const runtime_chain&, State&, const tree::given_forces<double>&,
                        std::span<const char> prescribed, bool tree);
  static inline std::atomic<function*> known = nullptr;
  /// Sets it (dynamics/runtime/general_dynamics.hpp). Called for elements that need it, by hybrid dynamics, by
  /// kte/shared_coordinates.hpp and by kte::compiled.
  static void bring();
};

}  // namespace kte::detail
