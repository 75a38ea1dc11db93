#pragma once

#include <kte/dynamics/centre_of_mass.hpp>

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

/// The kinetic energy of an element; see<P>(): the item at port P. (As a lambda in a lambda, clang 14 would instantiate
/// both branches.)
template <class Core, class See, std::size_t... P>
KTE_INLINE auto kinetic_energy_of(const Core& core, const See& see, std::index_sequence<P...>) {
  if constexpr (has_kinetic_energy<Core, decltype(see.template operator()<P>())...>) {
    return core.kinetic_energy(see.template operator()<P>()...);
  } else {
    return zero;
  }
}
/// The potential energy of an element, including that of a distributed mass in gravity.
template <class Core, class Gravity, class See, std::size_t... P>
KTE_INLINE auto potential_energy_of(const Core& core, const Gravity& gravity, const See& see,
                                    std::index_sequence<P...>) {
  const auto own = [&]() KTE_INLINE_LAMBDA {
    if constexpr (has_potential_energy<Core, decltype(see.template operator()<P>())...>) {
      return core.potential_energy(see.template operator()<P>()...);
    } else {
      return zero;
    }
  }();
  if constexpr (has_first_moment<Core, decltype(see.template operator()<P>())...>) {
    return own - dot(gravity, core.first_moment(see.template operator()<P>()...));
  } else {
    return own;
  }
}

template <class S, class Chain, class At, class V>
KTE_INLINE auto kinetic_energy_at(const Chain& c, const At& at, const V& v) {
  const given g{at, v, same<skip>{}, rest_base_of<Chain>(base_with_velocity)};
  using given_type = std::remove_const_t<decltype(g)>;
  using types = flow_types<Chain, given_type>;
  const unrolled_motion<Chain, given_type> m(c, g);
  return sum_over_elements<Chain>([&]<std::size_t I>() KTE_INLINE_LAMBDA {
    const auto& core = c.template core<I>();
    const auto see = [&m]<std::size_t Port>() KTE_INLINE_LAMBDA -> decltype(auto) {
      return m.template get<types::template what<I, Port>, Chain::wiring::slot(I, Port)>();
    };
    return kinetic_energy_of(core, see, typename types::template inputs<I>{});
  });
}

/// The potential energy of gravity and of elements. For the latter only their anchors are evaluated.
template <class S, class Chain, class At>
KTE_INLINE auto potential_energy_at(const Chain& c, const At& at) {
  const given g{at, same<skip>{}, same<skip>{}, base_with_pose};
  using types = flow_types<Chain, std::remove_const_t<decltype(g)>>;
  const auto elastic = sum_over_elements<Chain>([&]<std::size_t I>() KTE_INLINE_LAMBDA {
    const auto& core = c.template core<I>();
    const auto see = [&]<std::size_t Port>() KTE_INLINE_LAMBDA {
      return motion_of<types, types::template what<I, Port>, Chain::wiring::slot(I, Port)>(c, g);
    };
    return potential_energy_of(core, c.gravity(), see, typename types::template inputs<I>{});
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
