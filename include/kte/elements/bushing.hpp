#pragma once

#include <kte/kernels/midway.hpp>

namespace kte {

/// A symmetric 6x6 matrix in blocks: `linear` for displacements, `angular` for rotation vectors, `coupling` with one
/// row per displacement and one column per rotation. As a stiffness in N/m, Nm/rad, N/rad; as a damping in these units
/// times s.
struct bushing_matrix {
  sym3<> linear{};
  sym3<> angular{};
  mat3<> coupling{};

  constexpr bushing_matrix() = default;
  /// A matrix from its blocks: `bushing_matrix(kte::diagonal(1e6, 1e6, 2e5), kte::diagonal(40.0, 40.0, 10.0))`.
  template <class... L, class... A, class... C>
  constexpr bushing_matrix(const sym3<L...>& on_displacement, const sym3<A...>& on_rotation, const mat3<C...>& between)
      : linear(as<double>(on_displacement)), angular(as<double>(on_rotation)), coupling(as<double>(between)) {}
  template <class... L, class... A>
  constexpr bushing_matrix(const sym3<L...>& on_displacement, const sym3<A...>& on_rotation)
      : linear(as<double>(on_displacement)), angular(as<double>(on_rotation)) {}
};
/// An isotropic matrix: k in all directions, k_t about all axes.
[[nodiscard]] constexpr bushing_matrix isotropic_bushing(double k, double k_t) {
  return {diagonal(k, k, k), diagonal(k_t, k_t, k_t)};
}

namespace detail {
/// Whether x . K x is never negative, to rounding: no pivot of the elimination is below -1e-9 times its diagonal entry.
/// A vanishing pivot is skipped.
constexpr bool never_negative(const bushing_matrix& k) {
  const auto& l = k.linear;
  const auto& a = k.angular;
  const auto& c = k.coupling;
  double m[6][6] = {{l.xx, l.xy, l.xz, c.x.x, c.x.y, c.x.z}, {l.xy, l.yy, l.yz, c.y.x, c.y.y, c.y.z},
                    {l.xz, l.yz, l.zz, c.z.x, c.z.y, c.z.z}, {c.x.x, c.y.x, c.z.x, a.xx, a.xy, a.xz},
                    {c.x.y, c.y.y, c.z.y, a.xy, a.yy, a.yz}, {c.x.z, c.y.z, c.z.z, a.xz, a.yz, a.zz}};
  const double whole[6] = {l.xx, l.yy, l.zz, a.xx, a.yy, a.zz};
  for (std::size_t i = 0; i < 6; ++i) {
    if (!(m[i][i] >= -1e-9 * whole[i])) return false;
    const bool vanishes = m[i][i] <= 1e-9 * whole[i];
    for (std::size_t r = i + 1; r < 6; ++r) {
      if (vanishes && m[r][i] * m[r][i] > 1e-9 * whole[i] * whole[r]) return false;
      if (!vanishes)
        for (std::size_t j = r; j < 6; ++j) m[j][r] -= m[r][i] / m[i][i] * m[j][i];
    }
  }
  return true;
}
}  // namespace detail

namespace core {

/// A bushing between two frames, of stiffness K and damping C: symmetric 6x6 matrices in axes of the frame halfway
/// between the two (kernels/midway.hpp), which prefers neither. In these axes frame 2 is displaced by d and rotated by
/// the rotation vector r; at rest d = d_0, r = 0:
///
///   V = (d - d_0, r) . K (d - d_0, r) / 2                    (1)
///   (g, h) = K (d - d_0, r) + C (d', r')                     (2)
///
/// The loads (g, h) resist d and r. Forces and moments balance, the loads of K derive from V, and those of C never do
/// positive work. At half a turn between the frames r jumps to the opposite rotation vector.
struct bushing_3D {
  static constexpr type_name type{"bushing", kind::frame_3D};
  static constexpr std::array<port, 2> ports{
      {{kind::frame_3D, access::on, "anchor1"}, {kind::frame_3D, access::on, "anchor2"}}};
  static constexpr const char* arguments =
      "{stiffness, angular_stiffness, stiffness_coupling}, {damping, angular_damping, damping_coupling}, rest_position";
  static constexpr bool reads_positions = true;

  bushing_matrix stiffness;
  bushing_matrix damping;
  vec3<> rest_position;

  template <class A, class B>
  KTE_INLINE constexpr auto doForce(const A& a, const B& b) const {
    const auto m = detail::midway_between<kind::frame_3D>(a, b);
    const auto rates = detail::midway_rates_of(m, a, b);
    const auto u = m.d - rest_position;
    const auto g = stiffness.linear * u + stiffness.coupling * m.r;
    const auto h = transpose(stiffness.coupling) * u + stiffness.angular * m.r;
    return detail::midway_loads(m, g + (damping.linear * rates.d + damping.coupling * rates.r),
                                h + (transpose(damping.coupling) * rates.d + damping.angular * rates.r));  // (2)
  }
  /// J
  template <class A, class B>
  KTE_INLINE constexpr auto potential_energy(const A& a, const B& b) const {
    const auto m = detail::midway_between<kind::frame_3D>(a, b);
    const auto u = m.d - rest_position;
    const auto half = dot(u, stiffness.linear * u) + dot(m.r, stiffness.angular * m.r);
    using S = std::remove_const_t<decltype(half)>;
    return S(S(0.5) * half + dot(u, stiffness.coupling * m.r));  // (1)
  }
  constexpr void check(const parameter_check& where) const {
    finite(where, stiffness, "stiffness must be finite");
    finite(where, damping, "damping must be finite");
    where.finite(rest_position, "rest position must be finite");
    if (where.broken.rule) return;
    where.require(detail::never_negative(stiffness), "stiffness must have no negative eigenvalue", -1);
    where.require(detail::never_negative(damping), "damping must have no negative eigenvalue", -1);
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("stiffness", self.stiffness.linear), visit("angular_stiffness", self.stiffness.angular);
    visit("stiffness_coupling", self.stiffness.coupling);
    visit("damping", self.damping.linear), visit("angular_damping", self.damping.angular);
    visit("damping_coupling", self.damping.coupling);
    visit("rest_position", self.rest_position);
  }

 private:
  static constexpr void finite(const parameter_check& where, const bushing_matrix& k, const char* rule) {
    where.finite(k.linear, rule), where.finite(k.angular, rule);
    where.finite(k.coupling.x, rule), where.finite(k.coupling.y, rule), where.finite(k.coupling.z, rule);
  }
};

}  // namespace core

/// A bushing between two frames: stiffness, optionally damping and the position of the second frame in the first at
/// rest, m, all in axes halfway between them.
///
///   bushing_3D(chassis, engine, {diagonal(1e6, 1e6, 2e5), diagonal(40.0, 40.0, 10.0)}, isotropic_bushing(300, 0.1))
template <class F1, class F2, class X = double, class Y = X, class Z = Y>
[[nodiscard]] constexpr auto bushing_3D(const F1& anchor1, const F2& anchor2, const bushing_matrix& stiffness,
                                        const bushing_matrix& damping = {}, const vec3<X, Y, Z>& rest_position = {}) {
  return connect(core::bushing_3D{stiffness, damping, as<double>(rest_position)}, anchor1, anchor2);
}

KTE_CALL(bushing_3D, "(anchor1, anchor2, stiffness[, damping[, rest_position]]); both are a kte::bushing_matrix")

}  // namespace kte
