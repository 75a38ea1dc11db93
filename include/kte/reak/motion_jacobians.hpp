#pragma once

#include <kte/dynamics/jacobian_rate.hpp>
#include <kte/reak/motion_jacobian.hpp>
#include <kte/runtime_chain.hpp>

/// Motion Jacobians of a coordinate and a frame, or another coordinate, of a static or runtime chain.
namespace kte {

namespace detail {
/// Columns `first`, first + 1 ... of a Jacobian and its rate, with six rows or, of a coordinate, one.
template <class Result, class Matrix>
Result motion_jacobian_from(const Matrix& value, const Matrix& rate, int first) {
  using S = typename Result::scalar;
  Result r;
  for (int k = 0; k < Result::columns; ++k) {
    const auto j = value.col(first + k), d = rate.col(first + k);
    auto& x = r.column[static_cast<std::size_t>(k)];
    if constexpr (Result::moved == kind::gen)
      x = {j[0], d[0]};
    else if constexpr (Result::moved == kind::frame_2D)
      x = {{j[0], j[1]}, j[5], {d[0], d[1]}, d[5]};
    else
      x = {vec3<S>{j[0], j[1], j[2]}, {j[3], j[4], j[5]}, {d[0], d[1], d[2]}, {d[3], d[4], d[5]}};
  }
  return r;
}
/// The derivatives of a generalized coordinate by the rates of all degrees of freedom, at a configuration in dual
/// numbers.
template <int Slot, class Chain, class Q>
auto coordinate_row(const Chain& c, const Q& q) {
  using D = value_of<Q>;
  const configuration<D, typename Chain::wiring, Q> at(q);
  at.check();
  Eigen::Matrix<D, 1, Chain::dofs> row;
  std::array<D, std::size_t{Chain::dofs}> v;
  v.fill(D(0));
  for (std::size_t i = 0; i < v.size(); ++i) {
    v[i] = D(1);
    const given g{at, each<D, decltype(v)>{v}, same<zero_t>{}, base_at_rest};
    row[static_cast<Eigen::Index>(i)] =
        as<D>(motion_of<flow_types<Chain, std::remove_const_t<decltype(g)>>, kind::gen, Slot>(c, g).q_dot);
    v[i] = D(0);
  }
  return row;
}
}  // namespace detail

/// The Jacobian of `moved`, a frame or a generalized coordinate, by the rates of `coordinate`, a degree of freedom, at
/// the velocities v: a `motion_jacobian` of the kinds of both, such as jacobian_gen_3D, for bases at rest.
template <class Gravity, class... E, indexable Q, indexable V, key_type Coordinate, key_type Moved>
auto motion_jacobian_of(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const Coordinate&,
                        const Moved& moved) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  using wiring = typename chain_type::wiring;
  using S = value_of<Q>;
  constexpr int slot = wiring::template find<Coordinate>();
  static_assert(is_coordinate(Coordinate::what) && slot >= 0, "kte: this chain has no coordinate of this name");
  constexpr freedom at = wiring::freedom_of(Coordinate::what, slot < 0 ? 0 : slot);
  static_assert(slot < 0 || at.what == Coordinate::what,
                "kte: this coordinate is not a degree of freedom: its motion is prescribed");
  using result = motion_jacobian<Coordinate::what, Moved::what, S>;
  if constexpr (Moved::what == kind::gen) {
    constexpr int of = wiring::template find<Moved>();
    static_assert(of >= 0, "kte: this chain has no coordinate of this name");
    check_configuration<chain_type>(q), check_velocities<chain_type>(v);
    const auto row = coordinate_row<(of < 0 ? 0 : of)>(c, moving_along(c, q, v));
    Eigen::Matrix<S, 1, chain_type::dofs> value, rate;
    for (int i = 0; i < chain_type::dofs; ++i) value[i] = row[i].value, rate[i] = row[i].derivative[0];
    return motion_jacobian_from<result>(value, rate, at.v);
  } else {
    const auto rate = jacobian_rate(c, q, v, moved);
    return motion_jacobian_from<result>(jacobian(c, q, moved), rate, at.v);
  }
}

namespace detail {
/// The first index in v of a coordinate of kind K. Throws `unknown_name`, `bad_argument`.
inline int place_in_v(const runtime_chain& c, const name_or_handle& coordinate, kind k) {
  const int slot = coordinate.find(c.wiring(), k);
  for (const freedom& f : c.wiring().free)
    if (f.what == k && f.slot == slot) return f.v;
  throw bad_argument("kte: '" + c.wiring().names[static_cast<std::size_t>(k)][static_cast<std::size_t>(slot)] +
                     "' is not a degree of freedom: its motion is given already");
}
/// The derivatives of generalized coordinate i by the rates of all degrees of freedom, for positions and rates that
/// have been checked.
template <class S>
jacobian_with_rate<Eigen::Matrix<S, 1, Eigen::Dynamic>> coordinate_row_with_rate(const runtime_chain& c,
                                                                                 basic_runtime_state<S>& s, int i) {
  using row_type = Eigen::Matrix<S, 1, Eigen::Dynamic>;
  const auto& plan = s.tree().plan;
  jacobian_with_rate<row_type> row{row_type::Zero(plan.coordinates), row_type::Zero(plan.coordinates)};
  row.value[plan.row_of_gen[static_cast<std::size_t>(i)]] = S(1);
  bring_up_to_date(runtime_elements{c}, s);
  pull_back_followers_with_rates(runtime_elements{c}, s, [&row](int to, int from, const S& ratio, const S& change) {
    row.rate[to] += ratio * row.rate[from] + change * row.value[from];
    row.value[to] += ratio * row.value[from];
  });
  row.value.conservativeResize(s.dofs()), row.rate.conservativeResize(s.dofs());
  return row;
}
/// `motion_jacobian_of`, for positions and rates that have been checked.
template <class Result, class S>
Result motion_jacobian_at_state(const runtime_chain& c, basic_runtime_state<S>& s, const name_or_handle& coordinate,
                                const name_or_handle& moved) {
  const int first = place_in_v(c, coordinate, Result::joint), index = moved.find(c.wiring(), Result::moved);
  if constexpr (Result::moved == kind::gen) {
    const auto row = coordinate_row_with_rate(c, s, index);
    return motion_jacobian_from<Result>(row.value, row.rate, first);
  } else {
    const auto j = jacobian_with_rate_of<in_own_axes_t>(c, s, runtime_frame{Result::moved, index});
    return motion_jacobian_from<Result>(j.value, j.rate, first);
  }
}
}  // namespace detail

/// The Jacobian of a frame or coordinate by a coordinate of a runtime chain, of the kinds given by the type of the
/// result, with the bases of the state:
///
///   motion_jacobian_of<jacobian_gen_3D<>>(arm, s, q, v, "elbow", "tool")
///
/// Throws `unknown_name` if a name is of another kind.
template <class Result, class S>
Result motion_jacobian_of(const runtime_chain& c, basic_runtime_state<S>& s, const name_or_handle& coordinate,
                          const name_or_handle& moved) {
  detail::check_motion(c, s), detail::check_state_velocities(s);
  return detail::motion_jacobian_at_state<Result>(c, s, coordinate, moved);
}
template <class Result, class S, indexable Q, indexable V>
Result motion_jacobian_of(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v,
                          const name_or_handle& coordinate, const name_or_handle& moved) {
  detail::check_motion(c, s);
  (void)detail::place_in_v(c, coordinate, Result::joint), (void)moved.find(c.wiring(), Result::moved);
  return detail::take(c, s, q, v).call([&] {
    return detail::motion_jacobian_at_state<Result>(c, s, coordinate, moved);
  });
}

}  // namespace kte
