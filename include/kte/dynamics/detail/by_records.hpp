#pragma once

#include <kte/dynamics/detail/static_loops.hpp>

/// Algorithms of static chains that are loops over records for chains of all sizes.
namespace kte::detail {

/// f(elements, state) where what comes from outside is in the state.
template <class S, class Chain, class Given, class F>
auto by_records(const Chain& c, const Given& g, const F& f) {
  auto lent = c.kept.template borrow<static_state<S, Chain>>(c);
  static_state<S, Chain>& s = lent;
  s.take(g), check_regular(c, s);
  return f(static_elements{c, g}, s);
}

}  // namespace kte::detail
