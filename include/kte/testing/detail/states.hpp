#pragma once

#include <kte/runtime_chain.hpp>
#include <kte/testing/detail/numeric.hpp>
#include <kte/testing/detail/trial.hpp>

#include <bit>
#include <cmath>

/// Random contents of states of chains, and their differences.
namespace kte::testing::detail {

/// The indices of generalized coordinates of a runtime chain in the order of a static chain: degrees of freedom first.
inline std::vector<int> in_static_order(const topology& t) {
  std::vector<int> order;
  for (const auto& f : t.free)
    if (f.what == kind::gen) order.push_back(f.slot);
  for (int i = 0; i < t.count(kind::gen); ++i)
    if (std::find(order.begin(), order.end(), i) == order.end()) order.push_back(i);
  return order;
}
inline std::size_t place_in(const runtime_state&, const std::vector<int>& order, kind k, std::size_t i) {
  return k == kind::gen ? static_cast<std::size_t>(order[i]) : i;
}
template <class State>
std::size_t place_in(const State&, const std::vector<int>&, kind, std::size_t i) {
  return i;
}
/// Calls f(a, b) for each item of kind K of a state and the same item of a runtime state.
template <kind K, class State, class F>
void pairs_of_kind(State& s, runtime_state& r, const F& f) {
  const topology& t = *r.made_for();
  const auto order = in_static_order(t);
  for (std::size_t i = 0; i < static_cast<std::size_t>(t.count(K)); ++i)
    f(s.template get<K>(static_cast<int>(place_in(s, order, K, i))),
      r.get<K>(static_cast<int>(place_in(r, order, K, i))));
}
/// Calls f(a, b) for each item of a static or runtime state and the same item of a runtime state.
template <class State, class F>
void for_each_pair(State& s, runtime_state& r, const F& f) {
  [&]<std::size_t... K>(std::index_sequence<K...>) { (pairs_of_kind<static_cast<kind>(K)>(s, r, f), ...); }
  (std::make_index_sequence<kinds>{});
}

template <class T>
auto as_array(const T& thing) {
  return std::bit_cast<std::array<double, sizeof(T) / sizeof(double)>>(thing);
}
/// Sets equal random motions and inputs in both.
template <class State, class Draw>
void draw_motion(State& s, runtime_state& r, Draw& draw) {
  for_each_pair(s, r,
                [&draw]<class T>(T& a, T& b) { a = b = random_thing<kte::detail::kind_of_thing<T>, double>(draw); });
}
/// Sets equal random loads on both.
template <class State, class Draw>
void draw_loads(State& s, runtime_state& r, Draw& draw) {
  for_each_pair(s, r, [&draw]<class T>(T& a, T& b) {
    if constexpr (frame<T>)
      kte::detail::visit_rates(a.force, a.torque, [&draw](double& x) { x = draw(); });
    else if constexpr (coordinate<T>)
      kte::detail::visit_f(a, [&draw](double& x) { x = draw(); });
    b = a;
  });
}
/// The number of compared numbers, the number of differences (signs of zeros ignored), and the largest difference,
/// relative to the largest number or 1. NaN equals only NaN.
struct gap {
  int numbers = 0, differ = 0;
  double size = 1, most = 0;

  void add(double a, double b) {
    ++numbers;
    if (a == b || (a != a && b != b)) return;
    ++differ;
    size = (std::max)({size, std::abs(a), std::abs(b)}), most = worse(most, std::abs(a - b));
  }
  /// The fraction of differing numbers.
  double share() const { return numbers == 0 ? 0.0 : static_cast<double>(differ) / numbers; }
};
template <class State>
void add_gap(gap& g, State& s, runtime_state& r) {
  for_each_pair(s, r, [&g](const auto& a, const auto& b) {
    const auto x = as_array(a), y = as_array(b);
    for (std::size_t i = 0; i < x.size(); ++i) g.add(x[i], y[i]);
  });
}
/// The difference of the three passes of two chains on equal states.
template <class Chain, class State, class Draw>
gap gap_of_passes(const Chain& c, State& s, const runtime_chain& d, runtime_state& r, Draw& draw) {
  gap g;
  c.doMotion(s), d.doMotion(r), add_gap(g, s, r);
  draw_loads(s, r, draw);
  c.doForce(s), d.doForce(r), add_gap(g, s, r);
  c.clearForce(s), d.clearForce(r), add_gap(g, s, r);
  return g;
}

}  // namespace kte::testing::detail
