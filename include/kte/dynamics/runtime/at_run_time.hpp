#pragma once

#include <kte/contract/core_in_scalar.hpp>
#include <kte/dynamics/looped/static_state.hpp>
#include <kte/runtime_chain.hpp>
#include <kte/runtime_chain/element_in_lanes.hpp>

#include <array>
#include <span>

/// The way from static chains to algorithms that are written for runtime chains: those on loops and contacts.
namespace kte::detail {

/// A static chain as a runtime chain; parameters in packs by lane.
template <class Gravity, class... E>
runtime_chain with_texts(const static_chain<Gravity, E...>& c) {
  runtime_chain r;
  boost::hana::for_each(c.elements(), [&r](const auto& e) {
    const auto named = with_texts(e);
    constexpr std::size_t lanes = lanes_in<typename std::remove_cvref_t<decltype(named)>::core_type>;
    if constexpr (lanes > 1) {
      std::vector<std::unique_ptr<kte_element>> all;
      for (std::size_t i = 0; i < lanes; ++i) {
        auto of_lane = converted<double>(named.core, to_lane<double>{i});
        all.push_back(adapted(named_element<decltype(of_lane)>{std::move(of_lane), named.names}));
      }
      r.append(std::make_unique<element_in_lanes>(std::move(all)));
    } else {
      r << named;
    }
  });
  constexpr std::size_t lanes = lanes_in<Gravity>;
  if constexpr (lanes > 1) {
    std::vector<vec3<>> all;
    for (std::size_t i = 0; i < lanes; ++i) {
      const to_lane<double> of_lane{i};
      all.push_back({of_lane(c.gravity().x), of_lane(c.gravity().y), of_lane(c.gravity().z)});
    }
    r.gravity_of_lanes(std::move(all));
  } else {
    r.gravity(as<double>(c.gravity()));
  }
  return r;
}

/// A static chain as a runtime chain, with a state and vectors for arguments. S: double, or packs of it.
template <class S>
struct chain_at_run_time {
  runtime_chain chain;
  basic_runtime_state<S> state;
  runtime_vector<S> q, v, third;

  template <class Gravity, class... E>
  explicit chain_at_run_time(const static_chain<Gravity, E...>& c) : chain_at_run_time(with_texts(c)) {}
  chain_at_run_time(const chain_at_run_time& o) : chain_at_run_time(o.chain) {}
  chain_at_run_time& operator=(const chain_at_run_time&) = delete;
  ~chain_at_run_time() = default;

  template <indexable X>
  static void copy(const X& from, int n, runtime_vector<S>& to) {
    to.resize(n);
    for (int i = 0; i < n; ++i) to[i] = static_cast<S>(from[static_cast<std::size_t>(i)]);
  }

 private:
  explicit chain_at_run_time(const runtime_chain& c) : chain(c), state(chain.template make_state<S>()) {}
};
template <class Chain>
inline constexpr std::array<double, std::size_t{Chain::dofs}> zero_rates{};
/// The scalar of a runtime chain for arguments with the numbers of q.
template <class Q>
using scalar_at_run_time = std::conditional_t<has_lanes_of_double<value_of<Q>>, value_of<Q>, double>;

/// Calls f(runtime chain, its state, q, v, third); fewer arguments need not be given. The static chain keeps the
/// runtime chain for the next call. `name`: of the third argument, for messages.
template <class Gravity, class... E, indexable Q, indexable V, indexable X, class F>
decltype(auto) at_run_time(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const X& third, const F& f,
                           const char* name = "tau") {
  using chain_type = static_chain<Gravity, E...>;
  using S = scalar_at_run_time<Q>;
  static_assert(is_pack<S> || std::is_convertible_v<value_of<Q>, double>,
                "kte: loops and contacts are computed in double, and packs of it");
  static_assert(is_pack<S> || has_plain_parameters<double, chain_type>,
                "kte: this algorithm does not support static chains with other parameters in each lane, but runtime "
                "chains of kte::lanes");
  check_configuration<chain_type>(q);
  check_size<chain_type::dofs>(v, "v"), check_size<chain_type::dofs>(third, name);
  auto lent = c.kept.template borrow<chain_at_run_time<S>>(c);
  chain_at_run_time<S>& x = lent;
  x.copy(q, chain_type::nq, x.q), x.copy(v, chain_type::dofs, x.v), x.copy(third, chain_type::dofs, x.third);
  return f(x.chain, x.state, std::as_const(x.q), std::as_const(x.v), std::as_const(x.third));
}
template <class Gravity, class... E, indexable Q, indexable V, class F>
decltype(auto) at_run_time(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const F& f) {
  return at_run_time(c, q, v, zero_rates<static_chain<Gravity, E...>>,
                     [&f](const auto& r, auto& s, const auto& x, const auto& rates, const auto&) -> decltype(auto) {
                       return f(r, s, x, rates);
                     });
}
template <class Gravity, class... E, indexable Q, class F>
decltype(auto) at_run_time(const static_chain<Gravity, E...>& c, const Q& q, const F& f) {
  return at_run_time(c, q, zero_rates<static_chain<Gravity, E...>>,
                     [&f](const auto& r, auto& s, const auto& x, const auto&) -> decltype(auto) { return f(r, s, x); });
}

/// One that has the coordinates, signals and bases of a state of the static chain.
struct given_chain_at_run_time : chain_at_run_time<double> {
  using chain_at_run_time::chain_at_run_time;

  /// Copies all given quantities (dynamics/unrolled/given.hpp) but accelerations.
  template <class Wiring, class Given>
  void take(const Given& g) {
    write_numbers<vector_of::q>(state, numbers_of_given<Wiring::nq>(g.at.q), "q");
    write_numbers<vector_of::v>(state, numbers_of_given<Wiring::dofs>(g.v), "v");
    copy_given_items<Wiring>(g, state, [&]<kind K>(int slot) { return slot_of<Wiring, K>(slot); });
  }

 private:
  template <int N, class Numbers>
  static std::array<double, std::size_t{N}> numbers_of_given(const Numbers& x) {
    return [&]<int... I>(std::integer_sequence<int, I...>) {
      return std::array<double, std::size_t{N}>{as<double>(x.template at<I>())...};
    }
    (std::make_integer_sequence<int, N>{});
  }
  /// Only coordinates have other slots than in the static chain.
  template <class Wiring, kind K>
  int slot_of(int slot) const {
    if constexpr (K == kind::gen)
      for (std::size_t p = 0; p < std::size_t{Wiring::ports}; ++p)
        if (Wiring::table.what[p] == K && Wiring::table.slot[p] == slot) {
          const auto e = static_cast<std::size_t>(Wiring::table.element[p]);
          return chain.wiring().elements[e].index[p - static_cast<std::size_t>(Wiring::first[e])];
        }
    return slot;
  }
};
/// Calls f(runtime chain, its state) where the state has the given quantities.
template <class Gravity, class... E, class Given, class F>
decltype(auto) at_run_time_with(const static_chain<Gravity, E...>& c, const Given& g, const F& f) {
  static_assert(has_plain_parameters<double, static_chain<Gravity, E...>>,
                "kte: this algorithm computes in double, with parameters in double");
  auto lent = c.kept.template borrow<given_chain_at_run_time>(c);
  given_chain_at_run_time& x = lent;
  x.template take<typename static_chain<Gravity, E...>::wiring>(g);
  return f(x.chain, x.state);
}

}  // namespace kte::detail
