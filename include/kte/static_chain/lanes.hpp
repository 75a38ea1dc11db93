#pragma once

#include <kte/contract/parameter_paths.hpp>
#include <kte/static_chain/in_scalar.hpp>

#include <boost/hana/for_each.hpp>

namespace kte {

namespace detail {

template <class Core, class... Keys>
constexpr std::array<std::string_view, sizeof...(Keys)> names_of(const element<Core, Keys...>&) {
  return {Keys::name...};
}
/// Sets the number of a path in all elements (an array of pointers to cores would lose their types).
template <class Elements, class S>
void set_parameter(Elements& elements, std::string_view path, const S& value) {
  int hits = 0;
  for (const bool all : {false, true}) {
    boost::hana::for_each(elements, [&](auto& e) {
      const auto put = [&](auto& number) {
        if constexpr (typed_constant<decltype(number)>) {
          raise_fixed(path);
        } else if constexpr (std::is_assignable_v<decltype(number), const S&>) {
          number = value;
        } else {
          raise_one_number(path);
        }
      };
      hits += at_path(e.core, names_of(e), path, all, put);
    });
    if (hits == 1) return;
    if (hits > 1) raise_ambiguous_parameter(path, hits);
  }
  raise_no_parameter(path);
}
}  // namespace detail

/// The chain in the scalar of the parameters, with these parameters replaced: with packs a chain of another robot in
/// each lane, all of one structure.
///
///   using P = kte::pack<double, 8>;
///   const auto arms = kte::lanes(arm, kte::parameter{"tool/mass", P::load(masses)});
///   kte::forward_dynamics(arms, q, v, tau);     // of eight arms, in packs
///
/// A lane has the result of a chain with its parameters, whatever the other lanes have. All parameters of the chain
/// become packs, so that one function serves all lanes. Throws `unknown_name` for a path that the chain does not have,
/// `bad_argument` for one that several elements have or that is a typed constant, and `bad_parameter`, with the lane,
/// for values that an element rejects.
template <class Gravity, class... E, class S, class... More>
[[nodiscard]] auto lanes(const static_chain<Gravity, E...>& c, const parameter<S>& first,
                         const parameter<More>&... more) {
  static_assert((std::is_same_v<S, More> && ...), "kte: the values of the parameters have one type");
  using number = std::conditional_t<std::is_arithmetic_v<S> && !std::is_same_v<S, float>, double, S>;
  const auto wide = in<number>(c);
  auto elements = wide.elements();
  auto gravity = wide.gravity();
  const auto set = [&](std::string_view path, const number& x) {
    const std::string_view component = detail::after_name(path, "gravity");
    const bool found = detail::at_component(gravity, component, [&](auto& g) {
      if constexpr (typed_constant<decltype(g)>) {
        detail::raise_fixed(path);
      } else {
        g = x;
      }
    });
    if (!found) detail::set_parameter(elements, path, x);
  };
  set(first.path, number(first.value));
  (set(more.path, number(more.value)), ...);
  detail::check_gravity(gravity);
  boost::hana::for_each(elements, []<class Core, class... Keys>(element<Core, Keys...>& e) {
    parameter_check::breach broken;
    detail::check_lanes(e.core, parameter_check{Core::type, Core::ports, detail::names_of(e), broken});
  });
  return std::remove_const_t<decltype(wide)>(elements, gravity);
}
template <class Chain, class... Parameters>
auto lanes(const Chain& c, const Parameters&...) {
  static_assert(
      detail::fit<Chain>,
      "kte: call it as lanes(chain, kte::parameter{\"tool/mass\", masses}, ...), with a static chain, or a runtime "
      "chain and #include <kte/dynamics/lanes.hpp>");
  return c;
}

}  // namespace kte
