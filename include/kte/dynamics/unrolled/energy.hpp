#pragma once

#include <kte/dynamics/centre_of_mass.hpp>

namespace kte {
/// Energies of a chain, `kinetic` and `potential`, J.
template <class S = double>
struct energies {
  S kinetic;
  S potential;
};

}  // namespace kte

/// Energies of static chains, element by element.
namespace kte::detail {

/// The sum over the elements of a chain of f<I>(), which may be a typed zero.
template <class Chain, class F>
KTE_INLINE constexpr auto sum_over_elements(const F& f) {
  return [&f]<std::size_t... I>(std::index_sequence<I...>) KTE_INLINE_LAMBDA {
    return (zero + ... + f.template operator()<I>());
  }
  (std::make_index_sequence<Chain::size>{});
}

/// The potential energy of an element, including that of a distributed mass in gravity. see<P>(): the item at port P,
/// evaluated only if the element has such an energy.
template <class Core, class Gravity, class See, std::size_t... P>
KTE_INLINE auto potential_energy_in(const Gravity& gravity, const Core& core, const See& see,
                                    std::index_sequence<P...>) {
  if constexpr (has_potential_energy<Core, decltype(see.template operator()<P>())...> ||
                has_first_moment<Core, decltype(see.template operator()<P>())...>) {
    const auto energy = [&](const auto&... x) KTE_INLINE_LAMBDA {
      return potential_energy_of(core, x...) - dot(gravity, first_moment_of(core, x...));
    };
    return energy(see.template operator()<P>()...);
  } else {
    return zero;
  }
}

template <class S, class Chain, class At, class V>
KTE_INLINE auto kinetic_energy_at(const Chain& c, const At& at, const V& v) {
  const given g{at, v, same<skip>{}, rest_base_of<Chain>(base_with_velocity)};
  using given_type = std::remove_const_t<decltype(g)>;
  using types = flow_types<Chain, given_type>;
  const unrolled_motion<Chain, given_type> m(c, g);
  return sum_over_elements<Chain>([&]<std::size_t I>() KTE_INLINE_LAMBDA {
    return [&]<std::size_t... P>(std::index_sequence<P...>) KTE_INLINE_LAMBDA {
      return kinetic_energy_of(c.template core<I>(),
                               m.template get<types::template what<I, P>, Chain::wiring::slot(I, P)>()...);
    }
    (typename types::template inputs<I>{});
  });
}

/// The potential energy of gravity and of elements. For the latter only their anchors are evaluated.
template <class S, class Chain, class At>
KTE_INLINE auto potential_energy_at(const Chain& c, const At& at) {
  const given g{at, same<skip>{}, same<skip>{}, base_with_pose};
  using types = flow_types<Chain, std::remove_const_t<decltype(g)>>;
  const auto elastic = sum_over_elements<Chain>([&]<std::size_t I>() KTE_INLINE_LAMBDA {
    const auto see = [&]<std::size_t P>() KTE_INLINE_LAMBDA {
      return motion_of<types, types::template what<I, P>, Chain::wiring::slot(I, P)>(c, g);
    };
    return potential_energy_in(c.gravity(), c.template core<I>(), see, typename types::template inputs<I>{});
  });
  return elastic - dot(c.gravity(), weight_of<S>(c, at).moment);  // (2)
}
template <class S, class X, class Diagnose = too_large>
KTE_INLINE S checked_energy(const X& energy, const Diagnose& why = {"an energy"}) {
  const S all[]{as<S>(energy)};
  check_result(all, 1, why);
  return all[0];
}

}  // namespace kte::detail
