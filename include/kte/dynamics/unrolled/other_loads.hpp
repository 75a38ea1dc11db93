#pragma once

#include <kte/dynamics/unrolled/tree.hpp>

/// A chain whose elements have other loads, for reuse of the passes.
namespace kte::detail {

/// A core with the momentum of a body instead of its force; for mass m, moment h and inertia I about the origin:
///
///   (m v + w x h,  I w + h x v)          (1)
template <class S, class Core>
struct momentum_of {
  static constexpr auto& ports = Core::ports;
  const Core& core;

  template <class Frame>
  KTE_INLINE constexpr auto doForce(const Frame& x) const {
    return make_loads(accelerating_wrench(core.template mass<S>(), x));
  }
};

template <class Core>
inline constexpr bool is_body = has_mass<Core, double>&& is_frame(Core::ports[0].what);

/// Selects the forces of bodies, on request also those of masses on coordinates; other elements have no loads.
template <bool OnCoordinates>
struct masses_alone {
  template <class Core>
  KTE_INLINE static constexpr decltype(auto) of(const Core& core) {
    if constexpr (has_output<Core> || is_body<Core> || (OnCoordinates && has_mass<Core, double>)) {
      return (core);
    } else {
      return no_load_core<Core>{};
    }
  }
};
using bodies_alone = masses_alone<false>;
/// Selects the momenta of bodies; other elements have no loads.
template <class S>
struct momenta {
  template <class Core>
  KTE_INLINE static constexpr decltype(auto) of(const Core& core) {
    if constexpr (has_output<Core>) {
      return (core);
    } else if constexpr (is_body<Core>) {
      return momentum_of<S, Core>{core};
    } else {
      return no_load_core<Core>{};
    }
  }
};

template <class Chain, class Loads>
struct with_loads {
  using wiring = typename Chain::wiring;
  static constexpr std::size_t size = Chain::size;
  static constexpr int dofs = Chain::dofs, nq = Chain::nq;
  static constexpr bool reads_positions = Chain::reads_positions && !Chain::common, common = Chain::common,
                        unrolled = Chain::unrolled;

  static_assert(sizeof(check_loads_of<Chain>) > 0);
  static_assert(sizeof(check_bodies_of<Chain>) > 0);

  const Chain& chain;
  decltype((chain.kept)) kept = chain.kept;

  template <std::size_t I>
  KTE_INLINE constexpr decltype(auto) core() const {
    return Loads::of(chain.template core<I>());
  }
  KTE_INLINE constexpr const auto& gravity() const { return chain.gravity(); }
};

}  // namespace kte::detail
