#pragma once

#include <kte/contract/transmission.hpp>
#include <kte/kernels/force_laws.hpp>

namespace kte {

/// Parameters of LuGre friction: forces, N, for a length, torques, Nm, for an angle.
struct lugre_parameters {
  double sigma0;             ///< stiffness of the bristles, N/m or Nm/rad; positive
  double sigma1;             ///< their damping, Ns/m or Nms/rad; not negative
  double sigma2;             ///< viscous friction, Ns/m or Nms/rad; not negative
  double coulomb;            ///< Fc, force of fast sliding, N or Nm; positive
  double stiction;           ///< Fs, force at which sliding begins, N or Nm; not below Fc
  double stribeck_velocity;  ///< vs, rate over which the force falls from Fs to Fc, m/s or rad/s; positive
};

namespace core {

/// Friction on a coordinate by bristles between its surfaces. Their deflection z, m or rad, is the internal state of
/// the element, and `Model::rate(v, z)` is z_dot at a rate v that is not a typed zero:
///
///   f -= sigma0 z + sigma1 z_dot + sigma2 v          (1)
template <class Model, class Parameters>
struct bristle_friction {
  static constexpr std::array<port, 2> ports{
      {{kind::gen, access::on, "coordinate"}, {kind::internal, access::keep, "bristles"}}};

  Parameters p;

  bristle_friction() = default;
  constexpr explicit bristle_friction(const Parameters& x) : p(x) {}

  template <class C, class Z>
  KTE_INLINE constexpr auto z_dot(const C& c, const Z& z) const {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(c.q_dot)>, zero_t>) {
      return zero;
    } else {
      return static_cast<const Model&>(*this).rate(c.q_dot, z);
    }
  }
  template <class C, class Z>
  KTE_INLINE constexpr auto doForce(const C& c, const Z& z) const {
    return make_loads(-(p.sigma0 * z + p.sigma1 * z_dot(c, z) + p.sigma2 * c.q_dot));  // (1)
  }
  constexpr void check(const parameter_check& where) const {
    where.positive(p.sigma0, "sigma0 must be finite and positive");
    where.not_negative(p.sigma1, "sigma1 must be finite and not negative");
    where.not_negative(p.sigma2, "sigma2 must be finite and not negative");
    where.positive(p.coulomb, "coulomb must be finite and positive");
    where.finite(p.stiction, "stiction must be finite and not below coulomb");
    where.require(p.stiction >= p.coulomb, "stiction must be finite and not below coulomb", p.stiction);
    where.positive(p.stribeck_velocity, "stribeck_velocity must be finite and positive");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("sigma0", self.p.sigma0), visit("sigma1", self.p.sigma1), visit("sigma2", self.p.sigma2);
    visit("coulomb", self.p.coulomb), visit("stiction", self.p.stiction);
    visit("stribeck_velocity", self.p.stribeck_velocity);
  }
};

/// LuGre friction of a joint, with stiction, presliding displacement and the Stribeck effect. Bristles between the
/// surfaces are deflected by z, m or rad, the internal state of the element:
///
///   g(v) = Fc + (Fs - Fc) exp(-(v/vs)^2)          (1)
///   z_dot = v - sigma0 |v| z / g(v)               (2)
///   f -= sigma0 z + sigma1 z_dot + sigma2 v
///
/// At constant rate f tends to -(g(v) sign(v) + sigma2 v). Below stiction it is a spring of stiffness sigma0. |z| stays
/// within Fs / sigma0. The system is stiff: its fastest rates are about sigma0 |v| / g and (sigma1 + sigma2) / mass. At
/// a reversal f is continuous, with a kink. It has no `switching`, as a joint that sticks reverses again and again.
///
/// Canudas de Wit, Olsson, Astrom and Lischinsky, A new model for control of systems with friction, IEEE Trans.
/// Automatic Control 40 (1995), (1) to (4).
struct joint_lugre_gen : bristle_friction<joint_lugre_gen, lugre_parameters> {
  static constexpr type_name type{"joint_lugre", kind::gen};
  static constexpr const char* arguments = "{sigma0, sigma1, sigma2, coulomb, stiction, stribeck_velocity}";
  using bristle_friction::bristle_friction;

  template <class V, class Z>
  KTE_INLINE constexpr auto rate(const V& v, const Z& z) const {
    using std::abs;
    using number = std::remove_cvref_t<decltype(v / p.stribeck_velocity)>;
    const auto g = detail::stribeck_force(v, p.coulomb, p.stiction, p.stribeck_velocity);  // (1)
    return v - number(abs(number(v))) * ((p.sigma0 / g) * z);                              // (2)
  }
};

}  // namespace core

/// LuGre friction on a coordinate; `bristles` is its internal state:
///
///   joint_lugre_gen(q, bristles, {.sigma0 = 1e5, .sigma1 = 316.0, .sigma2 = 0.4, .coulomb = 1.0, .stiction = 1.5,
///                                 .stribeck_velocity = 0.001})
template <class Q, class Z>
[[nodiscard]] constexpr auto joint_lugre_gen(const Q& coordinate, const Z& bristles, const lugre_parameters& p) {
  return connect(core::joint_lugre_gen(p), coordinate, bristles);
}

KTE_CALL(joint_lugre_gen, "(coordinate, bristles, parameters)")

}  // namespace kte
