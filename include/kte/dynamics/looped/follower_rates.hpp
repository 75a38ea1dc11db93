#pragma once

#include <kte/dynamics/looped/mass_matrix.hpp>
#include <kte/math/select.hpp>

#include <vector>

/// Time derivatives of the ratios of dependent coordinates.
namespace kte::detail {

/// The time derivative of `ratio_of` by the coordinate on a port. If the followed coordinates move at rates v, the
/// follower has the acceleration
///
///   A(v) = sum_ij f_ij v_i v_j,   so   d/dt f_i = sum_j f_ij v_j = (A(v + e_i h) - A(v - e_i h)) / (4 h)          (1)
///
/// This is exact, because A is quadratic; h has the size of v, or any size if nothing moves.
template <class Elements, class State>
auto ratio_rate_of(const Elements& c, State& s, int follower, std::size_t port) {
  using S = typename State::scalar;
  const auto ports = c.ports(follower);
  const auto coordinate = [&](std::size_t p) -> auto& { return s.template get<kind::gen>(c.index(follower, p)); };
  std::vector<std::remove_cvref_t<decltype(coordinate(0))>> before;
  S h(0);
  for (std::size_t p = 0; p < ports.size(); ++p) {
    if (ports[p].what != kind::gen) continue;
    before.push_back(coordinate(p));
    coordinate(p).q_ddot = S(0);
    using std::abs;
    if (p + 1 < ports.size()) h += S(abs(before.back().q_dot));
  }
  const auto& end = s.template get<kind::gen>(c.written(follower));
  const auto acceleration_at = [&](const S& change) -> S {
    const S rate = coordinate(port).q_dot;
    coordinate(port).q_dot = rate + change;
    c.move(follower, s);
    coordinate(port).q_dot = rate;
    return end.q_ddot;
  };
  h = select(h == S(0), S(1), h);
  const S rate = (acceleration_at(h) - acceleration_at(-h)) / (S(4) * h);  // (1)
  for (std::size_t p = ports.size(); p-- > 0;)  // if two ports have one coordinate, the first counts for both
    if (ports[p].what == kind::gen) coordinate(p) = before.back(), before.pop_back();
  return rate;
}
/// `pull_back_followers` with the rates of ratios: calls add(to, from, ratio, rate of the ratio).
template <class Elements, class State, class Add>
void pull_back_followers_with_rates(const Elements& c, State& s, const Add& add) {
  for_each_followed(c, s, [&](int follower, std::size_t port, int to, int from) {
    const auto ratio = ratio_of(c, s, follower, s.template get<kind::gen>(c.index(follower, port)));
    add(to, from, ratio, ratio_rate_of(c, s, follower, port));
  });
}

}  // namespace kte::detail
