#pragma once

#include <kte/dynamics/detail/bodies.hpp>
#include <kte/dynamics/forward_kinematics.hpp>

namespace kte::detail {

/// Composite inertias, from the tips to a frame.
template <class S, class Chain, class Given>
struct local_composite {
  using types = local_types<Chain, Given>;
  using wiring = typename Chain::wiring;
  template <std::size_t I>
  using core_t = typename types::template core<I>;

  const Chain& chain;
  const Given& given;

  template <kind K, int Slot>
  KTE_INLINE constexpr auto carried() const {
    return sum<K, Slot>(std::make_index_sequence<loads_on<wiring, K, Slot>.size()>{});
  }

 private:
  template <kind K, int Slot, std::size_t... N>
  KTE_INLINE constexpr auto sum(std::index_sequence<N...>) const {
    return (no_mass + ... + part<loads_on<wiring, K, Slot>[N].element>());
  }
  template <std::size_t I>
  KTE_INLINE constexpr auto part() const {
    if constexpr (is_body<core_t<I>>) {
      return chain.template core<I>().template mass<S>();
    } else if constexpr (is_transmission<core_t<I>>) {
      const auto x = element_pose<I>(chain, given);
      return transported(x.rotation, x.position,
                         carried<types::template output_kind<I>, types::template output_slot<I>>());
    } else {
      return no_mass;  // nor does a frame carry what stands on frames that follow it
    }
  }
};

}  // namespace kte::detail
