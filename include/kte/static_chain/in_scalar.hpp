#pragma once

#include <kte/contract/core_in_scalar.hpp>
#include <kte/static_chain/static_chain.hpp>

namespace kte {

namespace detail {
template <class S, class Core, class... Keys>
constexpr auto element_in(const element<Core, Keys...>& e) {
  return element<in_scalar<Core, S>, Keys...>{converted<S>(e.core, to_scalar<S>{})};
}
}  // namespace detail

/// A static chain with all parameters, and gravity, in the scalar S: float, a pack, a dual number, a multiprecision
/// number. Numbers are converted; typed constants, lists (tables of springs) and functions are unchanged.
///
///   const auto fast = kte::in<float>(arm);   // no arithmetic in double with states in float
///
/// An element with numbers in its type must have `parameters` and a default constructor (contract/element_core.hpp).
template <class S, class Gravity, class... E>
[[nodiscard]] constexpr auto in(const static_chain<Gravity, E...>& c) {
  return boost::hana::unpack(c.elements(), [&c](const auto&... e) {
    detail::in_scalar<Gravity, S> gravity{};
    detail::convert_numbers(c.gravity(), gravity, detail::to_scalar<S>{});
    return static_chain<detail::in_scalar<Gravity, S>, decltype(detail::element_in<S>(e))...>(
        boost::hana::tuple<decltype(detail::element_in<S>(e))...>(detail::element_in<S>(e)...), gravity);
  });
}

}  // namespace kte
