#pragma once

#include <kte/contract/thing.hpp>
#include <kte/io/thing_values.hpp>
#include <kte/runtime_chain/runtime_state.hpp>
#include <kte/static_chain/state.hpp>

#include <map>

/// States of chains of either kind as plain data, by name, and back.
namespace kte {

namespace detail {

/// The name of item `slot` of a static chain.
template <class... E>
std::string_view name_of_thing(const wiring<E...>*, kind k, int slot) {
  using all = wiring<E...>;
  std::string_view name;
  std::size_t port = 0;
  const auto look = [&]<class Core, class... Keys>(const element<Core, Keys...>*) {
    for (const std::string_view own : {std::string_view(Keys::name)...}) {
      if (all::table.what[port] == k && all::table.slot[port] == slot) name = own;
      ++port;
    }
  };
  (look(static_cast<const E*>(nullptr)), ...);
  return name;
}

/// Calls visit(kind, name, item) for all items of a state.
template <class State, class Visit>
void for_each_thing(State& s, const Visit& visit) {
  const auto of_kind = [&]<kind K>() {
    if constexpr (requires { s.made_for(); }) {
      const auto& names = s.made_for()->names[static_cast<std::size_t>(K)];
      for (std::size_t i = 0; i < names.size(); ++i)
        visit(K, std::string_view(names[i]), s.template get<K>(static_cast<int>(i)));
    } else {
      using all = typename std::remove_const_t<State>::wiring;
      for (int i = 0; i < all::count(K); ++i)
        visit(K, name_of_thing(static_cast<const all*>(nullptr), K, i), s.template get<K>(i));
    }
  };
  [&]<std::size_t... K>(std::index_sequence<K...>) { (of_kind.template operator()<static_cast<kind>(K)>(), ...); }
  (std::make_index_sequence<kinds>{});
}

template <class T>
concept any_state = requires {
  typename T::scalar;
}
&&(is_chain_state<T> || requires(const T& s) { s.made_for(); });

}  // namespace detail

/// The record of all values of a state in float, double or long double.
template <detail::any_state State>
[[nodiscard]] state_record record_of(const State& s) {
  static_assert(std::floating_point<typename State::scalar>, "kte: files hold states of float, double and long double");
  state_record r;
  detail::for_each_thing(s, [&r](kind k, std::string_view name, const auto& x) {
    r.things.push_back(detail::record_of_thing(k, name, x));
  });
  return r;
}

/// Restores the values of a record into a state; other values are unchanged. A state of lower precision rounds. Throws
/// `unknown_name`, `bad_file`, and then leaves the state unchanged.
template <detail::any_state State>
void restore(const state_record& r, State& s) {
  State filled = s;
  std::map<std::pair<kind, std::string_view>, const thing_record*> wanted;
  for (const auto& x : r.things) wanted.emplace(std::pair(x.what, std::string_view(x.name)), &x);
  detail::for_each_thing(filled, [&wanted](kind k, std::string_view name, auto& x) {
    const auto found = wanted.find({k, name});
    if (found == wanted.end()) return;
    detail::assign_thing(x, *found->second);
    wanted.erase(found);
  });
  if (!wanted.empty()) {
    const auto& x = *wanted.begin()->second;
    detail::raise<unknown_name>("kte: " + to_string(x.place) + "the chain has no " + std::string(to_string(x.what)) +
                                " '" + x.name + "'");
  }
  s = std::move(filled);
}

}  // namespace kte
