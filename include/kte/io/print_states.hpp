#pragma once

#include <kte/io/print_numbers.hpp>
#include <kte/runtime_chain.hpp>
#include <kte/static_chain/layout.hpp>

#include <utility>

/// `std::cout << state`: a line for each coordinate, frame and signal, with its name. `std::cout << by_names(chain,
/// v)`: one for each coordinate, with its numbers in a joint vector.
namespace kte {

namespace detail {
/// Prints a line for each item of a state. name(kind, i) is the name of an item, count(kind) their number.
template <class State, class Count, class Name>
std::ostream& print_state(std::ostream& out, const State& s, const Count& count, const Name& name) {
  const auto all_of = [&]<std::size_t K>(std::integral_constant<std::size_t, K>) {
    constexpr kind k = static_cast<kind>(K);
    for (int i = 0; i < count(k); ++i)
      out << name(k, i) << "  " << to_string(k) << "  " << s.template get<k>(i) << '\n';
  };
  [&]<std::size_t... K>(std::index_sequence<K...>) { (all_of(std::integral_constant<std::size_t, K>{}), ...); }
  (std::make_index_sequence<kinds>{});
  return out;
}
}  // namespace detail

template <class S, class... E>
std::ostream& operator<<(std::ostream& out, const chain_state<S, detail::wiring<E...>>& s) {
  using wiring = detail::wiring<E...>;
  const auto names = detail::names_at_ports<wiring, E...>();
  const auto name = [&names](kind k, int i) {
    std::size_t port = 0;
    while (wiring::table.what[port] != k || wiring::table.slot[port] != i) ++port;
    return names[port];
  };
  return detail::print_state(out, s, &wiring::count, name);
}
template <class S>
std::ostream& operator<<(std::ostream& out, const basic_runtime_state<S>& s) {
  const auto& names = s.made_for()->names;
  const auto of = [&names](kind k) -> const auto& { return names[static_cast<std::size_t>(k)]; };
  return detail::print_state(
      out, s, [&of](kind k) { return static_cast<int>(of(k).size()); },
      [&of](kind k, int i) -> const auto& { return of(k)[static_cast<std::size_t>(i)]; });
}

/// A joint vector, q, v, a or tau, that is printed with the names of the coordinates. It refers to the `chain` and the
/// vector `x`.
template <class Chain, indexable X>
struct named_vector {
  const Chain& chain;
  const X& x;
};
/// A joint vector for printing with the names of the coordinates: `std::cout << by_names(arm, tau)`. Printing throws
/// `bad_argument` if x has neither the length of q nor that of v.
template <class Chain, indexable X>
[[nodiscard]] named_vector<Chain, X> by_names(const Chain& chain, const X& x) {
  return {chain, x};
}
template <class Chain, indexable X>
std::ostream& operator<<(std::ostream& out, const named_vector<Chain, X>& named) {
  const auto table = layout(named.chain);
  int nq = 0, nv = 0;
  for (const auto& e : table) nq += e.nq, nv += e.nv;
  const auto size = named.x.size();
  if (std::cmp_not_equal(size, nq) && std::cmp_not_equal(size, nv))
    throw bad_argument("kte: a joint vector of this chain has " + std::to_string(nq) + " numbers (q) or " +
                       std::to_string(nv) + " (v), not " + std::to_string(size));
  for (const auto& e : table) {
    out << e.name;
    const bool configuration = std::cmp_equal(size, nq);
    const int first = configuration ? e.q : e.v, count = configuration ? e.nq : e.nv;
    for (int i = first; i < first + count; ++i) out << "  " << named.x[static_cast<std::size_t>(i)];
    out << '\n';
  }
  return out;
}

}  // namespace kte
