#pragma once

#include <kte/contract/transmission.hpp>
#include <kte/kernels/stribeck.hpp>

namespace kte {

/// The parameters of LuGre friction, of a force (N) along a length, or of a torque (Nm) about an angle.
struct lugre_parameters {
  double sigma0;             ///< stiffness of the bristles, N/m or Nm/rad; positive
  double sigma1;             ///< their damping, Ns/m or Nms/rad; not negative
  double sigma2;             ///< viscous friction, Ns/m or Nms/rad; not negative
  double coulomb;            ///< Fc, force of fast sliding, N or Nm; positive
  double stiction;           ///< Fs, force at which sliding begins, N or Nm; not below Fc
  double stribeck_velocity;  ///< vs, rate over which the force falls from Fs to Fc, m/s or rad/s; positive
};

namespace detail {
/// Of bristles of any model: those of `lugre_parameters`.
template <class P>
constexpr void check_bristles(const parameter_check& where, const P& p) {
  where.positive(p.sigma0, "sigma0 must be finite and positive");
  where.not_negative(p.sigma1, "sigma1 must be finite and not negative");
  where.not_negative(p.sigma2, "sigma2 must be finite and not negative");
  where.positive(p.coulomb, "coulomb must be finite and positive");
  where.finite(p.stiction, "stiction must be finite and not below coulomb");
  where.require(p.stiction >= p.coulomb, "stiction must be finite and not below coulomb", p.stiction);
  where.positive(p.stribeck_velocity, "stribeck_velocity must be finite and positive");
}
template <class P, class Visit>
constexpr void visit_bristles(P& p, const Visit& visit) {
  visit("sigma0", p.sigma0), visit("sigma1", p.sigma1), visit("sigma2", p.sigma2);
  visit("coulomb", p.coulomb), visit("stiction", p.stiction), visit("stribeck_velocity", p.stribeck_velocity);
}
}  // namespace detail

namespace core {

/// Friction of a joint that sticks, slips before it slides, and slides with less force than it needs to begin: bristles
/// deflected by z, the internal state of the element (m or rad), between the surfaces:
///
///   g(v) = Fc + (Fs - Fc) exp(-(v/vs)^2)          (1)
///   z_dot = v - sigma0 |v| z / g(v)               (2)
///   f -= sigma0 z + sigma1 z_dot + sigma2 v       (3)
///
/// At constant rate f -> -(g(v) sign(v) + sigma2 v); below stiction it is a spring of stiffness sigma0, so that a
/// resting load creeps back, not on. |z| stays within Fs / sigma0. The system is stiff: its fastest rates are about
/// sigma0 |v| / g and (sigma1 + sigma2) / mass. Where it turns round f is continuous, with a kink; no `switching`, as a
/// joint that sticks turns round ever again.
///
/// Canudas de Wit, Olsson, Astrom and Lischinsky, A new model for control of systems with friction, IEEE Trans.
/// Automatic Control 40 (1995), (1) to (4).
struct joint_lugre_gen {
  static constexpr type_name type{"joint_lugre", kind::gen};
  static constexpr std::array<port, 2> ports{
      {{kind::gen, access::on, "coordinate"}, {kind::internal, access::keep, "bristles"}}};

  lugre_parameters p;

  template <class C, class Z>
  KTE_INLINE constexpr auto z_dot(const C& c, const Z& z) const {
    return rate(c.q_dot, z);
  }
  template <class C, class Z>
  KTE_INLINE constexpr auto doForce(const C& c, const Z& z) const {
    return make_loads(-(p.sigma0 * z + p.sigma1 * rate(c.q_dot, z) + p.sigma2 * c.q_dot));  // (3)
  }
  constexpr void check(const parameter_check& where) const { detail::check_bristles(where, p); }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    detail::visit_bristles(self.p, visit);
  }

 private:
  template <class V, class Z>
  KTE_INLINE constexpr auto rate(const V& v, const Z& z) const {
    using std::abs;
    if constexpr (std::is_same_v<V, zero_t>) {
      return zero;
    } else {
      using number = std::remove_cvref_t<decltype(v / p.stribeck_velocity)>;
      const auto g = detail::stribeck_force(v, p.coulomb, p.stiction, p.stribeck_velocity);  // (1)
      return v - number(abs(number(v))) * ((p.sigma0 / g) * z);                              // (2)
    }
  }
};

}  // namespace core

/// LuGre friction on a coordinate, with an internal state of the given name:
///
///   joint_lugre_gen(q, bristles, {.sigma0 = 1e5, .sigma1 = 316.0, .sigma2 = 0.4, .coulomb = 1.0, .stiction = 1.5,
///                                 .stribeck_velocity = 0.001})
template <class Q, class Z>
constexpr auto joint_lugre_gen(const Q& coordinate, const Z& bristles, const lugre_parameters& p) {
  return connect(core::joint_lugre_gen{p}, coordinate, bristles);
}

KTE_CALL(joint_lugre_gen, "(coordinate, bristles, parameters)")

namespace detail {
/// How model files make them.
struct joint_lugre_family {
  template <class Add>
  static void add_to(const Add& add) {
    add(
        "joint_lugre_gen",
        [](const auto& x) {
          return joint_lugre_gen(x.name("coordinate"), x.name("bristles"),
                                 {x.number("sigma0"), x.number("sigma1"), x.number("sigma2"), x.number("coulomb"),
                                  x.number("stiction"), x.number("stribeck_velocity")});
        },
        "{sigma0, sigma1, sigma2, coulomb, stiction, stribeck_velocity}");
  }
};
}  // namespace detail

}  // namespace kte
