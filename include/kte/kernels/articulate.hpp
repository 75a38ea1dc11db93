#pragma once

#include <kte/contract/joint.hpp>
#include <kte/frames/articulated.hpp>
#include <kte/kernels/axis_split.hpp>
#include <kte/kernels/joint_factors.hpp>
#include <kte/kernels/solve.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

/// The articulated-body algorithm (ABA; Featherstone 1983; Rigid Body Dynamics Algorithms, 2008, section 7.3), one
/// element at a time, for static and runtime chains. It runs on classical accelerations, A = (a, al) of a frame. From
/// the passes come
///   c      what the velocities alone add to the acceleration of the end of an element over that of its base
///   W, f   the load of springs, dampers and the velocities of inertias on a frame; the force on a coordinate
/// Every frame has an articulated inertia I and a load W such that it must be pushed by I A - W.
namespace kte::detail {

/// An acceleration of a frame.
template <class A, class AL>
struct acceleration {
  A linear;
  AL angular;
};
template <class A, class AL>
acceleration(A, AL) -> acceleration<A, AL>;

/// What a frame carries: I and W.
template <class I, class W>
struct articulated_frame {
  using geometry = articulated_frame;
  I inertia;
  W load;
};
template <class I, class W>
articulated_frame(I, W) -> articulated_frame<I, W>;
template <class I, class W, class J, class V>
KTE_INLINE constexpr auto operator+(const articulated_frame<I, W>& a, const articulated_frame<J, V>& b) {
  return articulated_frame{a.inertia + b.inertia, a.load + b.load};
}
inline constexpr auto no_articulated_frame = articulated_frame{no_articulated, no_wrench};

/// How a joint divides the motions of its end. A further mass m on its coordinate keeps something along its axes, so
/// that nothing is exact.
template <class Core, class C, class M>
constexpr auto division() {
  if constexpr (std::is_same_v<M, zero_t>) {
    return split_of<Core, C>();
  } else {
    return no_split{};
  }
}

/// What is kept of a joint of N axes on the way up for the way down: with U = I s and D = s^T U,
///   gain = U D^-1,   rate = D^-1 (f + s . W)                  (1)
template <class S, int N>
struct joint_response {
  std::array<std::array<S, std::size_t{N}>, std::size_t{N}> inverse;  ///< D^-1
  std::array<wrench<vec3<S>, vec3<S>>, std::size_t{N}> gain;
  std::array<S, std::size_t{N}> rate;
};

template <int N, class F>
KTE_INLINE constexpr auto for_axes(const F& f) {
  const auto all_of_them = [&]<int... K>(std::integer_sequence<int, K...>) KTE_INLINE_LAMBDA {
    return make_loads(f.template operator()<K>()...);
  };
  return all_of_them(std::make_integer_sequence<int, N>{});
}
template <int K, class T>
KTE_INLINE constexpr const auto& axis_at(const T& t) {
  return nth<std::size_t{K}>(t);
}
/// I - U gain^T
template <int K, int N, class I, class U, class G>
KTE_INLINE constexpr auto less_dyads(const I& inertia, const U& u, const G& gain) {
  if constexpr (K == N) {
    return inertia;
  } else {
    return less_dyads<K + 1, N>(less_dyad(inertia, axis_at<K>(u), axis_at<K>(gain)), u, gain);
  }
}
/// W - U rate
template <int K, int N, class W, class U, class S>
KTE_INLINE constexpr auto less_rates(const W& load, const U& u, const joint_response<S, N>& r) {
  if constexpr (K == N) {
    return load;
  } else {
    const auto& w = axis_at<K>(u);
    return less_rates<K + 1, N>(load - wrench{r.rate[K] * w.force, r.rate[K] * w.torque}, u, r);
  }
}
/// W - w_0 - w_1 ...
template <int K, int N, class W, class Ws>
KTE_INLINE constexpr auto less_all(const W& load, const Ws& ws) {
  if constexpr (K == N) {
    return load;
  } else {
    return less_all<K + 1, N>(load - axis_at<K>(ws), ws);
  }
}
/// W - s f, for coordinate axes.
template <bool Exact, int K, int N, class W, class Core, class C, class F>
KTE_INLINE constexpr auto less_exact(const W& load, const Core& core, const C& at, const F& f) {
  if constexpr (K == N || !Exact) {
    return load;
  } else {
    const auto s = axis_of<K>(core, at);
    const auto force = f.template operator()<K>();
    return less_exact<Exact, K + 1, N>(load - wrench{force * s.velocity, force * s.ang_velocity}, core, at, f);
  }
}
/// A + s (rate - gain . rest)
template <bool Exact, int K, int N, class S, class Core, class C, class Before, class Others, class Sum, class Put>
KTE_INLINE constexpr auto with_axes(const Core& core, const C& at, const joint_response<S, N>& r, const Before& before,
                                    const Others& others, const Sum& sum, const Put& put) {
  if constexpr (K == N) {
    return sum;
  } else {
    const auto s = axis_of<K>(core, at);
    const S x = as<S>(r.rate[K] - (dot(r.gain[K].force, others.linear) + dot(r.gain[K].torque, others.angular)));
    if constexpr (Exact) {
      put(K, as<S>(x - (dot(s.velocity, before.linear) + dot(s.ang_velocity, before.angular))));
    } else {
      put(K, x);
    }
    const acceleration next{sum.linear + x * s.velocity, sum.angular + x * s.ang_velocity};
    return with_axes<Exact, K + 1, N>(core, at, r, before, others, next, put);
  }
}

/// Which coordinates move next to nothing: a bit for each, the last for all from the 64th on. (Branches at each joint
/// take longer; so does a function that gets at what is kept of the joints.)
struct unmoved {
  std::uint64_t here = 0;  ///< the bit of the joint at hand
  std::uint64_t all = 0;
  std::uint64_t non_finite = 0;  ///< what they move is not finite; of those behind one that moves nothing, neither
  constexpr void at(std::size_t coordinate) { here = std::uint64_t{1} << (std::min)(coordinate, std::size_t{63}); }
};
/// `good` is a bool, or says more.
template <class S>
KTE_INLINE constexpr void judge(bool& good, bool moves, const S&) {
  good = moves && good;
}
template <class S>
KTE_INLINE constexpr void judge(unmoved& x, bool moves, const S& moved) {
  x.all |= moves ? 0 : x.here;
  x.non_finite |= all(moved * S(0) == S(0)) ? 0 : x.here;
}

/// (1), and gain again with its typed entries.
template <class S, class Core, class C, class I, class W, class U, class F, class M, int N, class Good>
KTE_INLINE constexpr auto respond(const Core& core, const C& at, const articulated_frame<I, W>& b, const U& u,
                                  const F& f, const M& m, joint_response<S, N>& r, Good& good) {
  const auto& j = b.inertia;
  // Below this, what moves along an axis is nothing but rounding of what does not.
  const auto least = [&](const auto& s) KTE_INLINE_LAMBDA {
    return as<S>(
        S(16) * std::numeric_limits<S>::epsilon() *
        as<S>(dot(s.velocity, s.velocity) * trace(j.linear) + dot(s.ang_velocity, s.ang_velocity) * trace(j.angular)));
  };
  if constexpr (N == 1) {
    const auto s = axis_of<0>(core, at);
    const S d = as<S>(power(s, axis_at<0>(u)) + m);
    judge(good, all(d > least(s)), d);
    const S inverse = S(1) / d;
    r.inverse[0][0] = inverse;
    r.rate[0] = inverse * as<S>(f.template operator()<0>() + power(s, b.load));
    const auto gain = wrench{inverse * axis_at<0>(u).force, inverse * axis_at<0>(u).torque};
    r.gain[0] = {as<S>(gain.force), as<S>(gain.torque)};
    return make_loads(gain);
  } else {
    joint_factors<S, N> d;
    S moved(0);
    std::array<std::array<S, std::size_t{N}>, 6> rows;  // of U, then of gain
    for_each_number<N>([&]<int K>() KTE_INLINE_LAMBDA {
      const auto s = axis_of<K>(core, at);
      const auto& w = axis_at<K>(u);
      for_each_number<K>([&]<int L>() KTE_INLINE_LAMBDA { d.template at<K, L>() = as<S>(power(s, axis_at<L>(u))); });
      d.template at<K, K>() = as<S>(power(s, w) + m);
      moved += d.template at<K, K>();
      rows[0][K] = as<S>(w.force.x), rows[1][K] = as<S>(w.force.y), rows[2][K] = as<S>(w.force.z);
      rows[3][K] = as<S>(w.torque.x), rows[4][K] = as<S>(w.torque.y), rows[5][K] = as<S>(w.torque.z);
      r.rate[K] = as<S>(f.template operator()<K>() + power(s, b.load));
    });
    judge(good, d.factorise(), moved);
    r.rate = d.solved(r.rate);
    constexpr auto wanted = division<Core, C, M>().leaves;
    for_each_number<6>([&]<int R>() KTE_INLINE_LAMBDA {
      if constexpr (wanted[R]) rows[R] = d.solved(rows[R]);
    });
    for_each_number<N>([&]<int K>() KTE_INLINE_LAMBDA {
      judge(good, all(d.template pivot<K>() > least(axis_of<K>(core, at))), S(0));
      r.inverse[K] = d.template inverse_column<K>();
      r.gain[K] = {{rows[0][K], rows[1][K], rows[2][K]}, {rows[3][K], rows[4][K], rows[5][K]}};
    });
    return for_axes<N>([&]<int K>() KTE_INLINE_LAMBDA { return r.gain[K]; });
  }
}

/// A link, or a joint whose acceleration is given: what its end carries, seen from its base. Where the base stands
/// still, the end accelerates by c.
///
///   I' = I,  W' = W - I c          both seen from the base                                          (2)
template <class Pose, class Motion, class I, class W>
KTE_INLINE constexpr auto carried_rigidly(const Pose& x, const Motion& c, const articulated_frame<I, W>& b) {
  const auto w = b.load - accelerating_wrench(b.inertia, c.acceleration, c.ang_acceleration);
  return articulated_frame{transported(x.rotation, x.position, b.inertia), transmit(x, w)};
}

/// The same of a joint that is free to move under the force f<n>() on its axis n, which moves a further mass m:
///
///   I' = I - U D^-1 U^T,  W' = W - I' c - U D^-1 (f + s . W)                                        (3)
///
/// D and U as in (1), D with m on its diagonal. Along coordinate axes I' is nothing and W' is -f. `good` is judged
/// by whether an axis has more than next to nothing to move.
template <class S, class Core, class C, class Motion, class I, class W, class F, class M, int N, class Good>
KTE_INLINE constexpr auto carried_by_joint(const Core& core, const C& at, const Motion& c,
                                           const articulated_frame<I, W>& b, const F& f, const M& m,
                                           joint_response<S, N>& response, Good& good) {
  constexpr auto split = division<Core, C, M>();
  const auto u = for_axes<N>([&]<int K>() KTE_INLINE_LAMBDA {
    const auto s = axis_of<K>(core, at);
    return accelerating_wrench(b.inertia, s.velocity, s.ang_velocity);
  });
  const auto gain = respond<S>(core, at, b, u, f, m, response, good);
  const auto x = core.relative(position_only(at));
  if constexpr (split.leaves_nothing) {
    return articulated_frame{no_articulated, transmit(x, less_exact<true, 0, N>(no_wrench, core, at, f))};
  } else {
    const auto inertia = rest(split, less_dyads<0, N>(b.inertia, u, gain));
    const auto load =
        less_rates<0, N>(b.load - accelerating_wrench(inertia, c.acceleration, c.ang_acceleration), u, response);
    const auto w = less_exact<split.exact, 0, N>(rest(split, load), core, at, f);
    return articulated_frame{transported(x.rotation, x.position, inertia), transmit(x, w)};
  }
}

/// A load W at the end of a joint alone, and a force f[n] on its axes: how fast these answer, and what reaches the
/// base. The same as above for M^-1, where nothing else moves. f becomes e. S, or several at a time.
///
///   e = f + s . W,   rate = D^-1 e,   W' = W - gain e                                                (4)
template <class S, class Core, class C, class M, class F, class T, class X, std::size_t N>
KTE_INLINE constexpr auto transmitted_by_joint(const Core& core, const C& at, const M&, const wrench<F, T>& load,
                                               const joint_response<S, int(N)>& r, std::array<X, N>& f,
                                               std::array<X, N>& rate) {
  constexpr auto split = division<Core, C, M>();
  constexpr int axes{N};
  const std::array<X, N> force = f;
  for_each_number<axes>([&]<int K>() KTE_INLINE_LAMBDA { f[K] = X(f[K] + power(axis_of<K>(core, at), load)); });
  for (std::size_t i = 0; i < N; ++i) {
    rate[i] = r.inverse[i][0] * f[0];
    for (std::size_t k = 1; k < N; ++k) rate[i] += r.inverse[i][k] * f[k];
  }
  const auto gains = for_axes<axes>([&]<int K>() KTE_INLINE_LAMBDA {
    return wrench{f[K] * r.gain[K].force, f[K] * r.gain[K].torque};
  });
  const auto rest_of_load = rest(split, less_all<0, axes>(load, gains));
  const auto given_force = [&]<int K>() KTE_INLINE_LAMBDA { return force[K]; };
  return transmit(core.relative(position_only(at)),
                  less_exact<split.exact, 0, axes>(rest_of_load, core, at, given_force));
}

/// Of an element in a position x: the acceleration of the end as far as the base and the velocities make it.
template <class Pose, class Motion, class A, class AL>
KTE_INLINE constexpr auto carried_acceleration(const Pose& x, const Motion& c, const acceleration<A, AL>& base) {
  const auto t = transpose(x.rotation);
  return acceleration{t * (base.linear + cross(base.angular, x.position)) + c.acceleration,
                      t * base.angular + c.ang_acceleration};
}

/// The way down, at a joint: the accelerations of its coordinate, q_ddot(n, value), and that of its end,
///
///   A = A' + s q_ddot,   q_ddot = rate - gain . A',   A' from `carried_acceleration`                (5)
///
/// Along a coordinate axis A is rate - gain . (rest of A'), whatever A' is.
template <class S, class Core, class C, int N, class M, class A, class AL, class Put>
KTE_INLINE constexpr auto accelerated(const Core& core, const C& at, const joint_response<S, N>& response, const M&,
                                      const acceleration<A, AL>& before, const Put& put) {
  constexpr auto split = division<Core, C, M>();
  const acceleration others{each_times(split.linear, before.linear), each_times(split.angular, before.angular)};
  return with_axes<split.exact, 0, N>(core, at, response, before, others, others, put);
}

}  // namespace kte::detail
