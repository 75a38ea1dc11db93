#pragma once

#include <kte/contract/force_derivatives.hpp>
#include <kte/dynamics/unrolled/flow.hpp>

/// Derivatives of the forces of elements on generalized coordinates of static chains: springs, dampers, masses.
namespace kte::detail {

/// The ports of element I for contract/force_derivatives.hpp.
template <class Chain, class Given, std::size_t I>
struct given_ports {
  using types = flow_types<Chain, Given>;
  using wiring = typename Chain::wiring;
  const Given& given;

  template <std::size_t P>
  KTE_INLINE decltype(auto) item() const {
    return types::template given<types::template what<I, P>, wiring::slot(I, P)>(given);
  }
  template <std::size_t P>
  static constexpr int row() {
    constexpr kind k = types::template what<I, P>;
    if constexpr (wiring::template is_free<k, wiring::slot(I, P)>)
      return wiring::template at<k, wiring::slot(I, P)>.v;
    else
      return -1;
  }
  static constexpr bool are_one(std::size_t a, std::size_t b) { return wiring::slot(I, a) == wiring::slot(I, b); }
};
/// Subtracts them from the derivatives of inverse dynamics.
template <class S, class Chain, class Given, class Result>
KTE_INLINE void subtract_coordinate_derivatives(const Chain& c, const Given& g, Result& r) {
  unroll<Chain::size>([&]<std::size_t I>() KTE_INLINE_LAMBDA {
    using core = typename flow_types<Chain, Given>::template core<I>;
    const given_ports<Chain, Given, I> ports{g};
    force_derivatives<S, core, given_ports<Chain, Given, I>, Result>{c.template core<I>(), ports, r}.subtract();
  });
}

}  // namespace kte::detail
