#pragma once

#include <kte/dynamics/closed_loops/hybrid.hpp>
#include <kte/dynamics/closed_loops/static_chains.hpp>

#include <string_view>
#include <vector>

namespace kte {

/// The result of `hybrid_dynamics` of a static chain with loops: a and tau, r.loop(pin), r.force(pin).
template <class Chain>
struct static_hybrid_dynamics_result : hybrid_dynamics_result<double, Chain::dofs>, static_loop_results<Chain> {};

namespace detail {
/// By the code of runtime chains. Arguments and errors are those of runtime chains, without a state, and with keys.
template <class Gravity, class... E>
struct static_hybrid<static_chain<Gravity, E...>> {
  using chain = static_chain<Gravity, E...>;

  template <class Q, class V, class X, class... Keys>
  static static_hybrid_dynamics_result<chain> dynamics(const chain& c, const Q& q, const V& v, const X& known,
                                                       prescribed_coordinates<Keys...>) {
    static_assert(sizeof(check_contacts_of<chain>) > 0);
    static_assert(sizeof(some_accelerations<double, typename chain::wiring, X, Keys...>) > 0);
    const auto find = [](auto& r, auto& s, auto&... given) {
      const std::vector<std::string> names{text_of_name(Keys{})...};
      const auto found = hybrid_dynamics(r, s, given..., std::vector<std::string_view>(names.begin(), names.end()));
      static_hybrid_dynamics_result<chain> result;
      result.a = found.a, result.tau = found.tau;
      copy_loops(s, result);
      return result;
    };
    return at_run_time(c, q, v, known, find, "known");
  }
};
}  // namespace detail
}  // namespace kte
