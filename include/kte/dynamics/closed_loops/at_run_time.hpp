#pragma once

#include <kte/dynamics/closed_loops/derivatives.hpp>
#include <kte/dynamics/looped/static_state.hpp>
#include <kte/runtime_chain.hpp>

namespace kte::detail {

/// A static chain as a runtime chain, with a state: algorithms on loops that are not unrolled are those of runtime
/// chains. The static chain keeps it. S: double, or packs of it.
template <class S>
struct chain_at_run_time {
  runtime_chain chain;
  basic_runtime_state<S> state;

  template <class Gravity, class... E>
  explicit chain_at_run_time(const static_chain<Gravity, E...>& c) : chain_at_run_time(runtime_chain() << c) {}
  chain_at_run_time(const chain_at_run_time& o) : chain_at_run_time(o.chain) {}
  chain_at_run_time& operator=(const chain_at_run_time&) = delete;
  ~chain_at_run_time() = default;

 private:
  explicit chain_at_run_time(const runtime_chain& c) : chain(c), state(chain.template make_state<S>()) {}
};
/// Calls f(runtime chain, its state).
template <class S = double, class Gravity, class... E, class F>
decltype(auto) at_run_time(const static_chain<Gravity, E...>& c, const F& f) {
  static_assert(has_plain_parameters<double, static_chain<Gravity, E...>>,
                "kte: this algorithm does not support static chains with other parameters in each lane, but runtime "
                "chains of kte::lanes");
  auto lent = c.kept.template borrow<chain_at_run_time<S>>(c);
  chain_at_run_time<S>& x = lent;
  return f(x.chain, x.state);
}
/// q of a static chain for algorithms of runtime chains.
template <class Chain, indexable Q>
Eigen::VectorXd positions_at_run_time(const Q& q) {
  static_assert(std::is_convertible_v<value_of<Q>, double>, "kte: closed loops are computed in double");
  check_configuration<Chain>(q);
  return as_vector(q, Chain::nq);
}
/// v, a or tau, for messages called `name`.
template <class Chain, indexable X>
Eigen::VectorXd rates_at_run_time(const X& x, const char* name) {
  static_assert(std::is_convertible_v<value_of<X>, double>, "kte: closed loops are computed in double");
  check_size<Chain::dofs>(x, name);
  return as_vector(x, Chain::dofs);
}

}  // namespace kte::detail
