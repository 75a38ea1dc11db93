// Joints that rub, in the algorithms that would lose their friction; compilers say it once of each type of joint.
// clang-format off
// mistakes: 6
// expect: error: .*kte: this algorithm takes the loads of joints and links from `relative` alone, and this element has its own `doForce`
// expect: frictional_joint<0>, false>
// expect: frictional_joint<1>, false>
// expect: frictional_joint<2>, false>
// expect: frictional_joint<3>, false>
// expect: frictional_joint<4>, false>
// expect: frictional_joint<5>, false>
// clang-format on
#include <kte/contract/checks.hpp>
#include <kte/dynamics/bias_forces.hpp>
#include <kte/dynamics/derivatives.hpp>
#include <kte/dynamics/hybrid_dynamics.hpp>
#include <kte/dynamics/mass_matrix_inverse.hpp>
#include <kte/elements/inertia.hpp>

// clang-format off
inline constexpr struct q_     final : kte::coord_key<"q">         {} q;
inline constexpr struct base_  final : kte::frame_3D_key<"base">   {} base;
inline constexpr struct elbow_ final : kte::frame_3D_key<"elbow">  {} elbow;
// clang-format on

namespace core {
template <int N>
struct frictional_joint : kte::transmission<frictional_joint<N>> {
  static constexpr kte::type_name type{"frictional_joint", kte::kind::frame_3D};
  static constexpr std::array<kte::port, 3> ports{{{kte::kind::gen, kte::access::in, "coordinate"},
                                                   {kte::kind::frame_3D, kte::access::in, "base"},
                                                   {kte::kind::frame_3D, kte::access::out, "end"}}};
  template <class C>
  constexpr auto relative(const C& c) const {
    using namespace kte;
    return motion{axis::x * c.q, no_rotation{}, axis::x * c.q_dot, zero3{}, axis::x * c.q_ddot, zero3{}};
  }
  template <class C, class Base, class Wrench>
  constexpr auto doForce(const C& c, const Base&, const Wrench& end) const {
    return kte::make_loads(end.force.x - 0.5 * c.q_dot, end);
  }
  constexpr void check(const kte::parameter_check&) const {}
};
}  // namespace core
template <int N>
constexpr auto slide = kte::chain(kte::connect(core::frictional_joint<N>{}, q, base, elbow),
                                  kte::inertia_3D(elbow, kte::point_mass(1.0)));
using x = std::array<double, 1>;
auto fine(const x& q) { return kte::inverse_dynamics(slide<-1>, q, q, q); }
auto f0(const x& q) { return kte::forward_dynamics(slide<0>, q, q, q); }
auto f1(const x& q) { return kte::mass_matrix(slide<1>, q); }
auto f2(const x& q) { return kte::mass_matrix_inverse(slide<2>, q); }
auto f3(const x& q) { return kte::inverse_dynamics_derivatives(slide<3>, q, q, q); }
auto f4(const x& q) { return kte::hybrid_dynamics(slide<4>, q, q, q, kte::prescribed(::q)); }
auto f5(const x& q) { return kte::gravity_forces(slide<5>, q); }
