#pragma once

#include <kte/contract/transmission.hpp>
#include <kte/frames/inverse.hpp>
#include <kte/frames/loop_state.hpp>

#include <array>
#include <utility>

namespace kte {

/// The rows of a closure: `linear` ones, in m, before `angular` ones, in rad, at most three of each; `count`: the sum.
struct closure_rows {
  int linear = 0, angular = 0;
  constexpr int count() const { return linear + angular; }
};

/// Returns the rows of a closure, in order.
template <class... R>
KTE_INLINE constexpr auto make_rows(const R&... r) {
  return values<R...>{{{r}...}};
}

namespace detail {
/// The motion of a frame relative to another, in numbers.
template <class S>
using closing_motion = motion<vec3<S>, mat3<vec3<S>>, vec3<S>, vec3<S>, vec3<S>, vec3<S>>;
template <class S, class M>
KTE_INLINE constexpr closing_motion<S> as_closing_motion(const M& m) {
  return {as<S>(m.position),     as<S>(matrix(m.rotation)), as<S>(m.velocity),
          as<S>(m.ang_velocity), as<S>(m.acceleration),     as<S>(m.ang_acceleration)};
}
/// A lane of packs.
template <class S>
closing_motion<double> lane_of(const closing_motion<S>& m, std::size_t lane) {
  const auto one = [lane](const vec3<S>& x) { return vec3<>{x.x[lane], x.y[lane], x.z[lane]}; };
  return {one(m.position),     {one(m.rotation.x), one(m.rotation.y), one(m.rotation.z)},
          one(m.velocity),     one(m.ang_velocity),
          one(m.acceleration), one(m.ang_acceleration)};
}
template <class S, class... R>
KTE_INLINE constexpr std::array<S, sizeof...(R)> rows_in_numbers(const values<R...>& rows) {
  return [&]<std::size_t... K>(std::index_sequence<K...>) {
    return std::array<S, sizeof...(R)>{as<S>(nth<K>(rows))...};
  }
  (std::index_sequence_for<R...>{});
}
/// The result for the rows of a closure of frames: the residual, its derivatives, or `wrenches`, the first derivative
/// for each unit rate v.x, v.y, v.z, w.x, w.y, w.z in turn, `closing_stride` numbers each.
enum class closing { residual, residual_dot, residual_ddot, wrenches };
inline constexpr int closing_stride = 8, all_rows_of_closing = 8 * closing_stride;
/// Writes the result to `rows`, for the motion m of the second frame in the first.
template <class Core, class S>
void close_frames_by(const Core& core, const closing_motion<S>& m, closing what, S* rows) {
  const auto put = [](const auto& all, S* to) {
    const auto numbers = rows_in_numbers<S>(all);
    for (std::size_t k = 0; k < numbers.size(); ++k) to[k] = numbers[k];
  };
  switch (what) {
    case closing::residual:
      return put(core.residual(m), rows);
    case closing::residual_dot:
      return put(core.residual_dot(m), rows);
    case closing::residual_ddot:
      return put(core.residual_ddot(m), rows);
    case closing::wrenches: {
      closing_motion<S> unit{m.position, m.rotation, {}, {}, {}, {}};
      for (S* const rate : {&unit.velocity.x, &unit.velocity.y, &unit.velocity.z, &unit.ang_velocity.x,
                            &unit.ang_velocity.y, &unit.ang_velocity.z}) {
        *rate = S(1);
        put(core.residual_dot(unit), rows);
        *rate = S(0), rows += closing_stride;
      }
    }
  }
}
/// The residual of a closure of coordinates at q with rates v, its derivatives by the coordinates, and its second
/// derivative without accelerations.
template <class Core, class S>
std::array<S, 2> close_coordinates_by(const Core& core, const S* q, const S* v, S* gradient) {
  std::array<S, Core::ports.size() - 1> at, rates;
  for (std::size_t i = 0; i < at.size(); ++i) at[i] = q[i], rates[i] = v[i];
  const auto by = core.gradient(at);
  for (std::size_t i = 0; i < at.size(); ++i) gradient[i] = by[i];
  return {core.residual(at), core.curvature(at, rates)};
}
template <class Core>
bool is_upright_by([[maybe_unused]] const Core& core, [[maybe_unused]] const closing_motion<double>& m) {
  if constexpr (requires { core.upright(m); })
    return core.upright(m);
  else
    return true;
}
/// A wrench on a frame of kind K.
template <kind K, class S>
KTE_INLINE constexpr auto in_space_of(const wrench<vec3<S>, vec3<S>>& x) {
  if constexpr (K == kind::frame_2D)
    return wrench{vec3{x.force.x, x.force.y, zero}, vec3{zero, zero, x.torque.z}};
  else
    return x;
}
/// Row k of a closure, among its forces or residuals.
template <class V>
KTE_INLINE constexpr auto& row_of(V& linear, V& angular, const closure_rows& rows, int k) {
  V& v = k < rows.linear ? linear : angular;
  const int i = k < rows.linear ? k : k - rows.linear;
  return i == 0 ? v.x : i == 1 ? v.y : v.z;
}
}  // namespace detail

/// Two frames A, B that a closure holds together. A core derived from it has
///
///   static constexpr closure_rows rows     the number of rows
///   residual(m)       g, zero where the loop is closed, from position p and rotation R of B in A          (1)
///   residual_dot(m)   dg/dt = J v, linear in the velocity v and angular velocity w of B in A              (2)
///   residual_ddot(m)  the second derivative, with acceleration a and angular acceleration al              (3)
///
/// where m is the motion of B in A (frames/motion.hpp): p in the axes of A, rates in the axes of B, so that p_dot = R v
/// and p_ddot = R a. Each function returns `make_rows(...)`. The ports are A, B and the name of the loop:
///
///   {Dim, access::on, "frame1"}, {Dim, access::on, "frame2"}, {kind::loop, access::keep, "loop"}
///
/// The load of the multipliers lambda on B has the power lambda times (2) for any rates; the opposite load acts on A,
/// at its origin.
template <class Core>
struct closure {
  static constexpr bool reads_positions = true;  ///< residuals depend on them

  template <class A, class B, class Loop>
  KTE_INLINE constexpr auto doForce(const A& a, const B& b, const Loop& loop) const {
    using S = std::remove_cvref_t<decltype(loop.force.x)>;
    auto m = detail::as_closing_motion<S>(relative(a, b));
    m.velocity = m.ang_velocity = {};
    const auto power = [&](S& rate) KTE_INLINE_LAMBDA {
      rate = S(1);
      const auto rows = detail::rows_in_numbers<S>(core().residual_dot(m));
      rate = S(0);
      S sum(0);
      for (int k = 0; k < Core::rows.count(); ++k)
        sum = S(sum + detail::row_of(loop.force, loop.torque, Core::rows, k) * rows[static_cast<std::size_t>(k)]);
      return sum;
    };
    const auto load = [&](vec3<S>& rates) KTE_INLINE_LAMBDA {
      return vec3<S>{power(rates.x), power(rates.y), power(rates.z)};
    };
    const wrench<vec3<S>, vec3<S>> on_b{load(m.velocity), load(m.ang_velocity)};
    const wrench<vec3<S>, vec3<S>> on_a = transmit(m, on_b);
    return make_loads(detail::in_space_of<Core::ports[0].what>(wrench{-on_a.force, -on_a.torque}),
                      detail::in_space_of<Core::ports[0].what>(on_b));
  }
  /// Writes (1) to the loop; called by doMotion.
  template <class A, class B, class S>
  constexpr void put_residual(const A& a, const B& b, loop_state<S>& loop) const {
    const auto m = detail::as_closing_motion<S>(relative(spatial(a), spatial(b)));
    const auto g = detail::rows_in_numbers<S>(core().residual(m));
    for (int k = 0; k < Core::rows.count(); ++k)
      detail::row_of(loop.residual, loop.ang_residual, Core::rows, k) = g[static_cast<std::size_t>(k)];
  }

 private:
  KTE_INLINE constexpr const Core& core() const { return static_cast<const Core&>(*this); }
};

namespace detail {
template <kind Dim>
inline constexpr std::array<port, 3> closure_ports{
    {{Dim, access::on, "frame1"}, {Dim, access::on, "frame2"}, {kind::loop, access::keep, "loop"}}};
}  // namespace detail

}  // namespace kte
