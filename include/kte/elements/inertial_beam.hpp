#pragma once

#include <kte/contract/transmission.hpp>
#include <kte/kernels/relative_turn.hpp>

namespace kte {

namespace core {

/// The inertia of a straight uniform beam of mass m between two frames, along the x axes of both if they are parallel:
/// inertia of translation, of rotation of its ends, and of bending. With d = p_2 - p_1, the axes x_1, x_2 of the frames
/// and their mean angular velocity W = (w_1 + w_2)/2,
///
///   l = d . (x_1 + x_2)/2,  b = l (x_1 - x_2)/2                                    (1)
///   c = (p_1 + p_2)/2 + b/6,  s = d' - W x d                                       (2)
///   T = m (|c'|^2/2 + |b'|^2/360 + |d'|^2/24 + d'.s/40 + |s|^2/60) + T_J           (3)
///   T_J = sum w_i . J w_i / 2 - J_xx (w_1x - w_2x)^2 / 12                          (4)
///
/// If the beam is an arc, its point at x from the middle of its chord is offset by b (1 - 4 x^2/l^2)/4, so c is its
/// centre of mass. s is the rate of S-shaped bending, and 0 for rigid motions. The weights of |c'|, |b'| and |d'| are
/// those of the integral along the beam. Those of s and of J_xx also compensate the error of the energy of
/// `flexible_beam`: with it, frequencies of n beams in series have errors of order 1/n^6 in bending, and 1/n^4 in
/// extension and torsion (docs/decisions/19-beams.md). Contributions of shear and J to bending have errors of order
/// 1/n^2.
///
/// The loads of T are, in common axes, with the momentum n = m (d'/40 + s/30), g = -m (c''/6 + b''/180), and k = g .
/// (x_1 - x_2)/2:
///
///   F_2 = -m (c''/2 + d''/12 + s'/40) - (n' - W x n) + k (x_1 + x_2)/2,   F_1 + F_2 = -m c''                       (5)
///   T_1 = x_1 x (k d + l g)/2 + ((d x n)' - w_1 x (d x n))/2 - J al_1 - w_1 x J w_1 + torque of (4)  (6)
///   T_2 = x_2 x (k d - l g)/2 + ((d x n)' - w_2 x (d x n))/2 - J al_2 - w_2 x J w_2 + torque of (4)
///
/// J is an additional rotary inertia of each half, in axes of its end. In space it needs a component about x, without
/// which torsion of the ends has no inertia. (Weights that compensate errors of frequencies: Goudreau and Taylor,
/// Evaluation of numerical integration methods in elastodynamics, Comp. Meth. Appl. Mech. Eng. 2 (1973).)
template <kind Dim, class Mass, class Inertia>
struct inertial_beam {
  static constexpr type_name type{"inertial_beam", Dim};
  static constexpr std::array<port, 2> ports{{{Dim, access::on, "anchor1"}, {Dim, access::on, "anchor2"}}};
  static constexpr bool reads_positions = true;
  static constexpr bool distributed_mass = true;

  Mass mass;
  Inertia inertia;

  template <class A, class B>
  KTE_INLINE constexpr auto mass_loads(const A& x, const B& y) const {
    return doForce(at_rest(x), at_rest(y));
  }
  template <class A, class B>
  KTE_INLINE constexpr auto doForce(const A& x, const B& y) const {
    const auto p = placed(x, y);
    const auto v = moving(p, x, y);
    const auto al_1 = x.ang_acceleration;
    const auto al_2 = p.turn * y.ang_acceleration;
    const auto a_2 = p.turn * y.acceleration;
    const auto d = a_2 - x.acceleration;  // d''
    const auto x_1 = plus_cross(cross(al_1, axis::x), v.w_1, cross(v.w_1, axis::x));
    const auto x_2 = plus_cross(cross(al_2, p.x_2), v.w_2, cross(v.w_2, p.x_2));
    const auto twice = v.l + v.l;
    const auto l = dot(d, p.along) + dot(v.d + v.d, v.along) + dot(p.d, 0.5 * (x_1 + x_2));
    const auto b = l * p.across + twice * v.across + p.l * (0.5 * (x_1 - x_2));
    const auto s = d - cross(0.5 * (al_1 + al_2), p.d) - cross(v.w, v.d);
    const auto sum = x.acceleration + a_2;
    const auto f = share(2) * sum + share(6) * b;       // m c''
    const auto g = -(share(12) * sum + share(30) * b);  // m (c''/6 + b''/180)
    const auto k = dot(g, p.across);
    const auto n = share(40) * v.d + share(30) * v.s;
    const auto n_rate = share(40) * d + share(30) * s;
    const auto apart = k * p.along - (share(12) * d + share(40) * s) - (n_rate - cross(v.w, n));
    const auto half = 0.5 * f;
    const auto c = cross(p.d, n);
    const auto c_rate = plus_cross(cross(v.d, n), p.d, n_rate);
    const auto t_1 = 0.5 * plus_cross(c_rate - cross(v.w_1, c), axis::x, k * p.d + p.l * g);
    const auto t_2 = 0.5 * plus_cross(c_rate - cross(v.w_2, c), p.x_2, k * p.d - p.l * g);
    const auto back = transpose(p.turn);
    const auto twist = torsion(x.ang_velocity, y.ang_velocity);
    const auto twist_rate = torsion(x.ang_acceleration, y.ang_acceleration);
    return make_loads(wrench{-half - apart, t_1 - spin(x, -twist, -twist_rate)},
                      wrench{back * (apart - half), back * t_2 - spin(y, twist, twist_rate)});
  }
  template <class A, class B>
  KTE_INLINE constexpr auto kinetic_energy(const A& x, const B& y) const {
    const auto p = placed(x, y);
    const auto v = moving(p, x, y);
    const auto sum = x.velocity + p.turn * y.velocity;
    const auto between = x.ang_velocity.x - y.ang_velocity.x;
    return share(8) * dot(sum, sum) + share(12) * dot(sum, v.b) + share(60) * (dot(v.b, v.b) + dot(v.s, v.s)) +
           share(24) * dot(v.d, v.d) + share(40) * dot(v.d, v.s) +
           detail::half(dot(x.ang_velocity, inertia * x.ang_velocity) + dot(y.ang_velocity, inertia * y.ang_velocity) -
                        between * torsion(x.ang_velocity, y.ang_velocity).x);  // (3)
  }
  /// m c
  template <class A, class B>
  KTE_INLINE constexpr auto first_moment(const A& x, const B& y) const {
    const auto p = placed(x, y);
    return detail::half(mass) * (x.position + y.position) + share(6) * (x.rotation * (p.l * p.across));
  }
  constexpr void check(const parameter_check& where) const {
    where.not_negative(mass, "mass must be finite and not negative");
    where.finite(inertia, "inertia must be finite");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("mass", self.mass), visit("inertia", self.inertia);
  }

 private:
  KTE_INLINE constexpr auto share(int n) const { return mass / Mass(n); }
  template <class X>
  KTE_INLINE static constexpr auto at_rest(const X& x) {
    return motion{x.position, x.rotation, zero3{}, zero3{}, x.acceleration, x.ang_acceleration};
  }
  /// R_1^T R_2, d, x_2, (x_1 + x_2)/2, (x_1 - x_2)/2, l. These and all following quantities are in axes of frame 1.
  template <class R, class D, class X, class U, class N, class L>
  struct place {
    R turn;
    D d;
    X x_2;
    U along;
    N across;
    L l;
  };
  template <class R, class D, class X, class U, class N, class L>
  place(R, D, X, U, N, L) -> place<R, D, X, U, N, L>;
  template <class A, class B>
  KTE_INLINE static constexpr auto placed(const A& x, const B& y) {
    const auto turn = detail::relative_rotation<Dim>(x.rotation, y.rotation);
    const auto d = transpose(x.rotation) * (y.position - x.position);
    const auto x_2 = turn * axis::x;
    const auto along = 0.5 * (axis::x + x_2);
    const auto across = 0.5 * (axis::x - x_2);
    const auto l = dot(d, along);
    return place{turn, d, x_2, along, across, l};  // (1)
  }
  /// Rates: w_1, w_2, W, d', ((x_1 + x_2)/2)', ((x_1 - x_2)/2)', l', b', s
  template <class V, class W, class M, class D, class U, class N, class L, class B, class S>
  struct rates {
    V w_1;
    W w_2;
    M w;
    D d;
    U along;
    N across;
    L l;
    B b;
    S s;
  };
  template <class V, class W, class M, class D, class U, class N, class L, class B, class S>
  rates(V, W, M, D, U, N, L, B, S) -> rates<V, W, M, D, U, N, L, B, S>;
  template <class P, class A, class B>
  KTE_INLINE static constexpr auto moving(const P& p, const A& x, const B& y) {
    const auto w_2 = p.turn * y.ang_velocity;
    const auto w = 0.5 * (x.ang_velocity + w_2);
    const auto d = p.turn * y.velocity - x.velocity;
    const auto x_1 = cross(x.ang_velocity, axis::x);
    const auto x_2 = cross(w_2, p.x_2);
    const auto along = 0.5 * (x_1 + x_2);
    const auto across = 0.5 * (x_1 - x_2);
    const auto l = dot(d, p.along) + dot(p.d, along);
    const auto b = l * p.across + p.l * across;
    const auto s = d - cross(w, p.d);
    return rates{x.ang_velocity, w_2, w, d, along, across, l, b, s};
  }
  /// The torque of (4) on frame 2, and minus that on frame 1.
  template <class A, class B>
  KTE_INLINE constexpr auto torsion(const A& of_1, const B& of_2) const {
    return vec3{1.0 / 6 * inertia.xx * (of_1.x - of_2.x), zero, zero};
  }
  /// The torque due to J and (4).
  template <class X, class L, class R>
  KTE_INLINE constexpr auto spin(const X& x, const L& twist, const R& rate) const {
    return plus_cross(inertia * x.ang_acceleration + rate, x.ang_velocity, inertia * x.ang_velocity + twist);
  }
};

}  // namespace core

/// The inertia of a uniform beam between two frames in the plane, along x of both: its mass, kg, and optionally the
/// rotary inertia of each half, kg m^2, at its end.
template <class F1, class F2, variable M, entry J = zero_t>
[[nodiscard]] constexpr auto inertial_beam_2D(const F1& anchor1, const F2& anchor2, const M& mass,
                                              const J& inertia = {}) {
  const auto m = real(mass);
  const sym3 about{zero, zero, zero, zero, zero, real(inertia)};
  return connect(
      core::inertial_beam<kind::frame_2D, std::remove_const_t<decltype(m)>, std::remove_const_t<decltype(about)>>{
          m, about},
      anchor1, anchor2);
}
/// The inertia of a uniform beam between two frames in space, along x of both: its mass, kg, and optionally the rotary
/// inertia of each half, kg m^2, in axes of its end.
template <class F1, class F2, variable M, class Inertia = decltype(diagonal(zero, zero, zero))>
[[nodiscard]] constexpr auto inertial_beam_3D(const F1& anchor1, const F2& anchor2, const M& mass,
                                              const Inertia& inertia = {}) {
  const auto m = real(mass);
  return connect(core::inertial_beam<kind::frame_3D, std::remove_const_t<decltype(m)>, Inertia>{m, inertia}, anchor1,
                 anchor2);
}

KTE_CALL(inertial_beam_2D, "(anchor1, anchor2, mass[, inertia])")
KTE_CALL(inertial_beam_3D, "(anchor1, anchor2, mass[, inertia])")

}  // namespace kte
