#pragma once

#include <kte/elements/joint_lugre.hpp>
#include <kte/math/plain_scalar.hpp>

namespace kte {

/// Parameters of elasto-plastic friction: those of LuGre friction and the deflection at which bristles begin to slip.
struct elasto_plastic_parameters {
  double sigma0;             ///< stiffness of the bristles, N/m or Nm/rad; positive
  double sigma1;             ///< their damping, Ns/m or Nms/rad; not negative
  double sigma2;             ///< viscous friction, Ns/m or Nms/rad; not negative
  double coulomb;            ///< Fc, force of fast sliding, N or Nm; positive
  double stiction;           ///< Fs, force at which sliding begins, N or Nm; not below Fc
  double stribeck_velocity;  ///< vs, rate over which the force falls from Fs to Fc, m/s or rad/s; positive
  double breakaway;          ///< z_b, largest elastic deflection, m or rad; positive, not above Fc / sigma0
};

namespace core {

/// Friction of a joint that sticks elastically below its breakaway force, without drift, and slides beyond it. Bristles
/// between the surfaces are deflected by z, the internal state of the element (m or rad):
///
///   g(v) = Fc + (Fs - Fc) exp(-(v/vs)^2),  z_s = g(v)/sigma0,  u = z sign(v)          (1)
///   alpha = 0 for u <= z_b,  1 for u >= z_s,  else 1/2 + sin(pi ((u - z_b)/(z_s - z_b) - 1/2))/2          (2)
///   z_dot = v (1 - alpha u/z_s)                                                       (3)
///   f -= sigma0 z + sigma1 z_dot + sigma2 v
///
/// With z_b = 0 and alpha = 1 it is `joint_lugre_gen`, which creeps under a load that oscillates below stiction.
/// Equally stiff.
///
/// Dupont, Hayward, Armstrong and Altpeter, Single state elastoplastic friction models, IEEE Trans. Automatic Control
/// 47 (2002).
struct joint_elasto_plastic_gen : bristle_friction<joint_elasto_plastic_gen, elasto_plastic_parameters> {
  static constexpr type_name type{"joint_elasto_plastic", kind::gen};
  static constexpr const char* arguments = "{sigma0, sigma1, sigma2, coulomb, stiction, stribeck_velocity, breakaway}";
  using bristle_friction::bristle_friction;

  constexpr void check(const parameter_check& where) const {
    bristle_friction::check(where);
    where.positive(p.breakaway, "breakaway must be finite and positive");
    where.require(p.breakaway <= p.coulomb / p.sigma0, "breakaway must not be above coulomb / sigma0", p.breakaway);
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    bristle_friction::parameters(self, visit);
    visit("breakaway", self.p.breakaway);
  }
  template <class V, class Z>
  KTE_INLINE constexpr auto rate(const V& v, const Z& z) const {
    using std::acos;
    using std::sin;
    using number = std::remove_cvref_t<decltype(v / p.stribeck_velocity + z)>;
    using plain = detail::plain_scalar<number>;
    const auto g = detail::stribeck_force(v, p.coulomb, p.stiction, p.stribeck_velocity);
    const number rate_now(v), deflection(as<number>(z)), z_s = number(g / p.sigma0), z_b = number(p.breakaway);
    const number u = select(rate_now < number(0), number(-deflection), deflection);  // (1)
    const number pi(plain(acos(plain(-1)))), range = z_s - z_b, over = u - z_b;
    const auto sharp = range <= number(0);
    const number x = select(sharp, number(select(over > number(0), number(1), number(0))),
                            number(over / select(sharp, number(1), range)));
    const number middle = number(0.5) + number(0.5) * number(sin(number(pi * (x - number(0.5)))));
    const number alpha = select(x > number(0), number(select(x < number(1), middle, number(1))), number(x - x));  // (2)
    return number(rate_now * (number(1) - alpha * u / z_s));                                                      // (3)
  }
};

}  // namespace core

/// Elasto-plastic friction on a coordinate; `bristles` is its internal state:
///
///   joint_elasto_plastic_gen(q, bristles, {.sigma0 = 1e5, .sigma1 = 316.0, .sigma2 = 0.4, .coulomb = 1.0,
///                                          .stiction = 1.5, .stribeck_velocity = 0.001, .breakaway = 7e-6})
template <class Q, class Z>
[[nodiscard]] constexpr auto joint_elasto_plastic_gen(const Q& coordinate, const Z& bristles,
                                                      const elasto_plastic_parameters& p) {
  return connect(core::joint_elasto_plastic_gen(p), coordinate, bristles);
}

KTE_CALL(joint_elasto_plastic_gen, "(coordinate, bristles, parameters)")

}  // namespace kte
