#pragma once

#include <kte/engine/axes.hpp>
#include <kte/frames/articulated.hpp>
#include <kte/math/select.hpp>
#include <kte/recursions/newton_euler.hpp>

#include <limits>

/// The articulated-body algorithm (ABA; Featherstone 1983; 2008, section 7.3), with classical accelerations in the axes
/// of each body. A joint is free to move, or its acceleration is given.
namespace kte::engine {

/// The part of the acceleration of a body that depends on velocities only: `centripetal` is w x (w x p), in the axes of
/// the parent; (linear, angular) are in the axes of the body.
template <class W, class A, class C, class CL>
struct bias_motion {
  using geometry = bias_motion;
  W ang_velocity;
  A centripetal;
  C linear;
  CL angular;
};
template <class W, class A, class C, class CL>
bias_motion(W, A, C, CL) -> bias_motion<W, A, C, CL>;

/// Articulated inertia I^A and bias force p^A of a body and all bodies beyond it: an acceleration a needs the wrench
/// I^A a + p^A.
template <class I, class W>
struct articulated_body {
  using geometry = articulated_body;
  I inertia;
  W bias;
};
template <class I, class W>
articulated_body(I, W) -> articulated_body<I, W>;
template <class I, class W, class J, class V>
KTE_INLINE constexpr auto operator+(const articulated_body<I, W>& a, const articulated_body<J, V>& b) {
  return articulated_body{a.inertia + b.inertia, a.bias + b.bias};
}

/// The factors of an axis s: U D^-1, u D^-1 and D^-1, with U = I^A s, D = s^T U + m, u = tau - s^T p^A, and a further
/// mass m on its coordinate.
template <class S>
struct axis_factors {
  wrench<vec3<S>, vec3<S>> gain;
  S rate, inverse;
};

/// (1)  c = w x (w x p) in the axes of the parent; 2 (R^T w) x v_J + w_J x v_J, (R^T w) x w_J, each with dS/dt q_dot,
/// and
///      with S q_ddot for joints whose acceleration is given
template <body B, class M, class S>
KTE_INLINE constexpr auto bias_motion_of(const B& b, const M& parent, const S* rate, const S* change) {
  const auto& w = parent.ang_velocity;
  const auto [v_j, w_j] = b.along_axes(rate);
  const auto w_in = b.in(w);
  const auto linear = constant<2>{} * cross(w_in, v_j) + cross(w_j, v_j);
  if constexpr (B::always_free) {
    return bias_motion{w_in + w_j, cross(w, cross(w, b.position())), linear, cross(w_in, w_j)};
  } else {
    vec3<S> a, al;
    const auto [a_s, al_s] = bias_along_axes(b, rate);
    assign(a, linear + a_s), assign(al, cross(w_in, w_j) + al_s);
    if (!b.free()) {
      const auto [a_j, al_j] = b.along_axes(change);
      a = as<S>(a + a_j), al = as<S>(al + al_j);
    }
    return bias_motion{w_in + w_j, cross(w, cross(w, b.position())), a, al};
  }
}
/// The wrench of a body at the angular velocity w and zero acceleration.
template <class B, class W>
KTE_INLINE constexpr auto velocity_wrench(const B& b, const W& w) {
  const auto& [mass, c, inertia, published] = b.inertia();
  const auto f = mass * cross(w, cross(w, c));
  return wrench{fresh(f), plus_cross(cross(w, inertia * w), c, f)};
}

/// A body with its articulated inertia, before an axis of its joint is eliminated.
template <class I, class W, class U, class G, class S>
struct axis_elimination {
  using geometry = axis_elimination;
  I inertia;
  W bias;
  U u;
  G gain;
  S rate;
};
template <class I, class W, class U, class G, class S>
axis_elimination(I, W, U, G, S) -> axis_elimination<I, W, U, G, S>;

/// The component of axis K if its elimination leaves no inertia along it; otherwise -1.
template <body_with_axes B, int K>
inline constexpr int eliminated_component = [] {
  using axis = std::remove_cvref_t<decltype(std::declval<const B&>().template axis<K>())>;
  return typed_constant<decltype(std::declval<const B&>().template mass<K>())> ? unit_axis<axis> : -1;
}();
/// The inertia or wrench with zeros for axis K and all later axes that are eliminated.
template <body_with_axes B, int K, class A>
KTE_INLINE constexpr auto without_axes(const A& a) {
  if constexpr (K == B::axes) {
    return a;
  } else {
    return without_axes<B, K + 1>(without<eliminated_component<B, K>>(a));
  }
}
/// I^A and p^A after the elimination of an axis s; `more` is added to p^A:
///
///   I' = I - U U^T D^-1,   p' = p + U u D^-1          (2)
///
/// Along a unit axis without a further mass, I' is exactly zero and p' is tau.
template <int K, body_with_axes B, class Y, class V, class S>
KTE_INLINE constexpr auto after_elimination(const B& b, const Y& y, const V& more, const S& force) {
  constexpr int n = eliminated_component<B, K>;
  const auto inertia = kte::detail::less_dyad(y.inertia, y.u, y.gain);
  const auto bias = (y.bias + more) + wrench{y.rate * y.u.force, y.rate * y.u.torque};
  if constexpr (n < 0) {
    return articulated_body{inertia, bias};
  } else {
    const auto s = b.template axis<K>();
    return articulated_body{without<n>(inertia), without<n>(bias) + wrench{force * s.linear, force * s.angular}};
  }
}
/// The threshold below which the inertia along an axis is only rounding error. `linear`, `angular`: the traces of the
/// two parts of I^A.
template <class S, class A, class I, class J>
KTE_INLINE constexpr S least_inertia(const A& s, const I& linear, const J& angular) {
  return S(16) * std::numeric_limits<S>::epsilon() *
         as<S>(dot(s.linear, s.linear) * linear + dot(s.angular, s.angular) * angular);
}
/// Notes the first axis without inertia; `first` is -1 before. d: the inertia along the axis.
template <class S>
KTE_INLINE constexpr void note(int& first, int axis, bool moves, const S&) {
  if (!moves) [[unlikely]]
    if (first < 0) first = axis;
}
/// Eliminates the axes of a joint from the last to the first. The first is left to `seen_by_parent`, which bodies on
/// bases do not need. `unmoved`: notes axes without inertia.
template <int K, body_with_axes B, class I, class W, class L, class A, class Force, class S, class Unmoved>
KTE_INLINE constexpr auto eliminate_axes(const B& b, const I& inertia, const W& bias, const L& linear, const A& angular,
                                         const Force& force, axis_factors<S>* factors, Unmoved& unmoved) {
  constexpr std::integral_constant<int, K> k{};
  const auto s = b.template axis<K>();
  const auto u = accelerating_wrench(inertia, s.linear, s.angular);
  const S d = as<S>(power(s, u) + b.template mass<K>());
  note(unmoved, b.first() + K, all(d > least_inertia<S>(s, linear, angular)), d);
  const S inverse = S(1) / d;
  const auto rate = inverse * (force(k) - power(s, bias));
  const wrench gain{inverse * u.force, inverse * u.torque};
  assign(factors[K].gain, gain);
  factors[K].rate = as<S>(rate), factors[K].inverse = inverse;
  const axis_elimination y{fresh(inertia), fresh(bias), fresh(u), fresh(gain), rate};
  if constexpr (K == 0) {
    return y;
  } else {
    const auto rest = after_elimination<K>(b, y, no_wrench, force(k));
    return eliminate_axes<K - 1>(b, rest.inertia, rest.bias, linear, angular, force, factors, unmoved);
  }
}
/// I^A and p^A of a body about the origin of its parent and in the axes of the parent.
template <body B, class I, class W, class A>
KTE_INLINE constexpr auto pulled_back(const B& b, const articulated_body<I, W>& x, const A& centripetal) {
  const auto& p = b.position();
  const articulated i{b.out(x.inertia.linear), b.out(x.inertia.coupling), b.out(x.inertia.angular)};
  const auto force = b.out(x.bias.force) + i.linear * centripetal;
  return articulated_body{
      shifted(p, i),
      wrench{fresh(force), plus_cross(b.out(x.bias.torque) + transpose(i.coupling) * centripetal, p, force)}};
}
/// Whether a body has no axes by its type: a rigid link.
template <class B>
inline constexpr bool without_joint = false;
template <body_with_axes B>
inline constexpr bool without_joint<B> = B::axes == 0;
/// The articulated inertia and bias force of a body as its parent carries them.
template <body B, class C, class Y, class Force>
KTE_INLINE constexpr auto seen_by_parent(const B& b, const C& c, const Y& y, const Force& force) {
  constexpr std::integral_constant<int, 0> first{};
  if constexpr (without_joint<B> || never_free<B>) {
    const auto more = accelerating_wrench(y.inertia, c.linear, c.angular);
    return pulled_back(b, articulated_body{y.inertia, y.bias + more}, c.centripetal);
  } else if constexpr (B::always_free) {
    const auto left = after_elimination<0>(b, y, no_wrench, force(first)).inertia;
    const auto more = accelerating_wrench(left, c.linear, c.angular);
    return pulled_back(b, articulated_body{left, after_elimination<0>(b, y, more, force(first)).bias}, c.centripetal);
  } else {
    using S = typename B::scalar;
    dense<S, decltype(articulated_body{y.inertia, y.bias})> left;
    if constexpr (body_with_axes<B>) {
      if (b.free())
        assign(left, after_elimination<0>(b, y, no_wrench, force(first)));
      else
        assign(left, articulated_body{y.inertia, y.bias});
    } else {
      assign(left, articulated_body{y.inertia, y.bias});
    }
    return pulled_back(
        b, articulated_body{left.inertia, left.bias + accelerating_wrench(left.inertia, c.linear, c.angular)},
        c.centripetal);
  }
}

/// `eliminate_axes` if the joint is free to move; otherwise x unchanged.
template <body_with_axes B, class X, class Force, class S, class Unmoved>
KTE_INLINE constexpr auto eliminated(const B& b, const X& x, const Force& force, axis_factors<S>* factors,
                                     Unmoved& unmoved) {
  if constexpr (B::axes == 0 || never_free<B>) {
    return fresh(x);
  } else {
    const auto all_axes = [&]() KTE_INLINE_LAMBDA {
      return eliminate_axes<B::axes - 1>(b, x.inertia, x.bias, trace(x.inertia.linear), trace(x.inertia.angular), force,
                                         factors, unmoved);
    };
    if constexpr (B::always_free) {
      return all_axes();
    } else {
      dense<S, decltype(all_axes())> y{};
      if (b.free())
        assign(y, all_axes());
      else
        assign(y.inertia, x.inertia), assign(y.bias, x.bias);
      return y;
    }
  }
}

/// Eliminates axes that are numbers from I^A and p^A, as `eliminate_axes`: of `least` for each unit of length and
/// angle.
template <body B, class S, class Force>
[[gnu::noinline]] void eliminate_axes_of_numbers(const B& b, S (&m)[6][6], S (&p)[6], const S& least_linear,
                                                 const S& least_angular, const Force& force, axis_factors<S>* factors,
                                                 int& unmoved) {
  for (int k = b.axis_count(); k-- > 0;) {
    const auto& [v, w] = b.axis(k);
    const S s[6]{v.x, v.y, v.z, w.x, w.y, w.z};
    S u[6], gain[6], d = b.mass(k), rate = as<S>(force(k));
    for (int r = 0; r < 6; ++r) {
      u[r] = S(0);
      for (int c = 0; c < 6; ++c) u[r] += m[r][c] * s[c];
      d += s[r] * u[r], rate -= s[r] * p[r];
    }
    note(unmoved, b.first() + k, all(d > dot(v, v) * least_linear + dot(w, w) * least_angular), d);
    const S inverse = S(1) / d;
    rate *= inverse;
    for (int r = 0; r < 6; ++r) gain[r] = inverse * u[r], p[r] += rate * u[r];
    for (int r = 0; r < 6; ++r)
      for (int c = 0; c < 6; ++c) m[r][c] -= u[r] * gain[c];
    factors[k] = {{{gain[0], gain[1], gain[2]}, {gain[3], gain[4], gain[5]}}, rate, inverse};
  }
}
/// `eliminated` for a joint of several unit axes with numbers known at run time, with I^A as a matrix of 6 x 6. If
/// nothing is passed on to the parent (`ends`), an axis needs only the rows of the axes before it. Axes given by
/// numbers are eliminated unchanged.
template <body B, class X, class Force, class S>
auto eliminated_by_number(const B& b, const X& x, const Force& force, axis_factors<S>* factors, bool ends,
                          int& unmoved) {
  if (!b.free()) return fresh(x);
  const auto& [a, h, j] = x.inertia;
  S m[6][6]{{a.xx, a.xy, a.xz, h.x.x, h.x.y, h.x.z}, {a.xy, a.yy, a.yz, h.y.x, h.y.y, h.y.z},
            {a.xz, a.yz, a.zz, h.z.x, h.z.y, h.z.z}, {h.x.x, h.y.x, h.z.x, j.xx, j.xy, j.xz},
            {h.x.y, h.y.y, h.z.y, j.xy, j.yy, j.yz}, {h.x.z, h.y.z, h.z.z, j.xz, j.yz, j.zz}};
  const auto& [f, t] = x.bias;
  S p[6]{as<S>(f.x), as<S>(f.y), as<S>(f.z), as<S>(t.x), as<S>(t.y), as<S>(t.z)};
  const S least = S(16) * std::numeric_limits<S>::epsilon(), linear = trace(a), angular = trace(j);
  bool unit_axes = true;
  if constexpr (requires { b.has_unit_axes(); }) {
    unit_axes = b.has_unit_axes();
    if (!unit_axes) [[unlikely]]
      eliminate_axes_of_numbers(b, m, p, least * linear, least * angular, force, factors, unmoved);
  }
  for (int k = unit_axes ? b.axis_count() : 0; k-- > 0;) {
    const int n = b.axis_number(k);
    const S d = m[n][n], tau = as<S>(force(k));
    note(unmoved, b.first() + k, all(d > least * (n < 3 ? linear : angular)), d);
    const S inverse = S(1) / d, rate = inverse * (tau - p[n]);
    S u[6], gain[6];
    for (int c = 0; c < 6; ++c) u[c] = m[n][c], gain[c] = inverse * u[c], p[c] += rate * u[c];
    for (int l = 0; l < (ends ? k : 6); ++l) {
      const int row = ends ? b.axis_number(l) : l;
      for (int c = 0; c < 6; ++c) m[row][c] -= u[row] * gain[c];
    }
    factors[k] = {{{gain[0], gain[1], gain[2]}, {gain[3], gain[4], gain[5]}}, rate, inverse};
    for (int c = 0; c < 6; ++c) m[n][c] = m[c][n] = S(0);  // nothing is left
    p[n] = tau;
  }
  X left;
  assign(left.inertia, articulated{sym3{m[0][0], m[0][1], m[0][2], m[1][1], m[1][2], m[2][2]},
                                   mat3{vec3{m[0][3], m[0][4], m[0][5]}, vec3{m[1][3], m[1][4], m[1][5]},
                                        vec3{m[2][3], m[2][4], m[2][5]}},
                                   sym3{m[3][3], m[3][4], m[3][5], m[4][4], m[4][5], m[5][5]}});
  assign(left.bias, wrench{vec3{p[0], p[1], p[2]}, vec3{p[3], p[4], p[5]}});
  return left;
}

/// q_ddot = u D^-1 - (U D^-1)^T a',   a = a' + s q_ddot          (3)
///
/// Along a unit axis without a further mass the component of a is u D^-1 - (U D^-1)^T (the other components of a'),
/// whatever the component of a' is.
template <int K, class S, body_with_axes B, class A>
KTE_INLINE constexpr auto accelerated(const B& b, const axis_factors<S>* factors, const A& a, S* change) {
  if constexpr (K == B::axes) {
    return fresh(a);
  } else {
    constexpr int n = eliminated_component<B, K>;
    const auto s = b.template axis<K>();
    const S x = as<S>(factors[K].rate - power(without_axes<B, K>(a), factors[K].gain));
    change[K] = n < 0 ? x : as<S>(x - (dot(s.linear, a.linear) + dot(s.angular, a.angular)));
    return accelerated<K + 1>(b, factors, without<n>(a) + x * s, change);
  }
}
/// `accelerated` for axes with numbers known at run time, or given by numbers.
template <class S, body B>
void accelerate_by_number(const B& b, const axis_factors<S>* factors, motion_vector<vec3<S>, vec3<S>>& a, S* change) {
  if constexpr (requires { b.has_unit_axes(); })
    if (!b.has_unit_axes()) [[unlikely]] {
      for (int k = 0; k < b.axis_count(); ++k) {
        const auto& s = b.axis(k);
        change[k] = factors[k].rate - power(a, factors[k].gain);
        a = {a.linear + change[k] * s.linear, a.angular + change[k] * s.angular};
      }
      return;
    }
  S* const all[]{&a.linear.x, &a.linear.y, &a.linear.z, &a.angular.x, &a.angular.y, &a.angular.z};
  for (int k = 0; k < b.axis_count(); ++k) {
    S& along = *all[b.axis_number(k)];
    const S before = along;
    along = S(0);
    along = factors[k].rate - power(a, factors[k].gain);
    change[k] = along - before;
  }
}
template <class S, body B, class A>
KTE_INLINE constexpr auto accelerated_if_free(const B& b, const axis_factors<S>* factors, const A& a, S* change) {
  if constexpr (B::always_free) {
    return accelerated<0>(b, factors, a, change);
  } else if constexpr (never_free<B>) {
    return a;
  } else {
    dense<S, A> x;
    assign(x, a);
    if (b.free()) {
      if constexpr (body_with_axes<B>)
        assign(x, accelerated<0>(b, factors, a, change));
      else
        accelerate_by_number(b, factors, x, change);
    }
    return x;
  }
}

/// Outward recursion (1), from the angular velocities of the bases in `kept`.
template <class Hand, class Driver, class Kept, class S>
KTE_INLINE auto bias_motions(const Driver& d, const Kept& kept, const S* rate, const S* change) {
  return d.template outward<Hand>(kept, [=](const body auto& b, const auto& parent) KTE_INLINE_LAMBDA {
    return bias_motion_of(b, parent, rate + b.first(), change + b.first());
  });
}
/// The steps of (2): a body alone, with own(body, bias motion) in its p^A; its joint, with force(body)(k) on axis k;
/// its parent.
template <class Own>
struct articulated_alone {
  Own own;
  template <class B, class M>
  KTE_INLINE constexpr auto operator()(const B& b, const M& m) const {
    return articulated_body{to_articulated(b.composite()), own(b, m)};
  }
};
template <class S, class Force, class Unmoved>
struct joint_elimination {
  Force force;
  axis_factors<S>* factors;
  Unmoved& unmoved;
  template <body B, class X, class Ends>
  KTE_INLINE constexpr auto operator()(const B& b, const X& x, const Ends& ends) const {
    if constexpr (body_with_axes<B>)
      return eliminated(b, x, force(b), factors + b.first(), unmoved);
    else
      return eliminated_by_number(b, x, force(b), factors + b.first(), ends, unmoved);
  }
};
template <class Force>
struct articulated_to_parent {
  Force force;
  template <body B, class M, class Y>
  KTE_INLINE constexpr auto operator()(const B& b, const M& m, const Y& y) const {
    return seen_by_parent(b, m, y, force(b));
  }
};
/// Inward recursion (2); writes `factors` by axis. `unmoved`: notes axes without inertia.
template <class Hand, class Driver, class Kept, class Biases, class Own, class Force, class S, class Unmoved>
KTE_INLINE void articulate(const Driver& d, const Kept& kept, const Biases& biases, const Own& own, const Force& force,
                           axis_factors<S>* factors, Unmoved& unmoved) {
  d.template inward<false, Hand, false>(kept, biases, articulated_alone<Own>{own},
                                        joint_elimination<S, Force, Unmoved>{force, factors, unmoved},
                                        articulated_to_parent<Force>{force});
}
/// Articulated inertias only: for a mechanism at rest, without loads and forces.
struct rest {
  template <class B>
  KTE_INLINE constexpr auto operator()(const B&) const {
    return [](int) KTE_INLINE_LAMBDA { return zero; };
  }
};
template <class Driver, class Kept, class S, class Unmoved>
KTE_INLINE void articulate_at_rest(const Driver& d, const Kept& kept, axis_factors<S>* factors, Unmoved& unmoved) {
  using inertia = articulated<sym3<S>, mat3<vec3<S>>, sym3<S>>;
  articulate<articulated_body<inertia, wrench<zero3, zero3>>>(
      d, kept, kept_constant<bias_motion<zero3, zero3, zero3, zero3>>{},
      [](const auto&, const auto&) KTE_INLINE_LAMBDA { return no_wrench; }, rest{}, factors, unmoved);
}
/// Outward recursion (3): accelerations of all bodies and axes, from the accelerations of the bases in `kept`.
template <class S>
struct acceleration_of_child {
  const axis_factors<S>* factors;
  S* change;
  template <body B, class M, class A>
  KTE_INLINE constexpr auto operator()(const B& b, const M& m, const A& parent) const {
    const motion_vector a{
        b.in(plus_cross(parent.acceleration + m.centripetal, parent.ang_acceleration, b.position())) + m.linear,
        b.in(parent.ang_acceleration) + m.angular};
    const auto found = accelerated_if_free(b, factors + b.first(), a, change + b.first());
    return body_motion{skip{}, m.ang_velocity, found.linear, found.angular};
  }
};
template <class Hand, class Driver, class Kept, class Biases, class S>
KTE_INLINE void accelerate(const Driver& d, const Kept& kept, const Biases& biases, const axis_factors<S>* factors,
                           S* change) {
  d.template descend<Hand>(kept, biases, acceleration_of_child<S>{factors, change});
}

}  // namespace kte::engine
