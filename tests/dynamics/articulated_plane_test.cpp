#include "dynamics/tree_motion.hpp"

// Forward dynamics by articulated bodies in the plane, in the plane and space at once, and through a joint of a user.

namespace articulated_plane_test {

using namespace kte;
using namespace kte::test::trees;

/// A nut on a screw of pitch h a radian about an axis n, in no library: p = h q n.
template <class Axis>
struct screw : transmission<screw<Axis>> {
  static constexpr type_name type{"screw_joint", kind::frame_3D};
  static constexpr std::array<port, 3> ports{{{kind::gen, access::angle, "coordinate"},
                                              {kind::frame_3D, access::in, "base"},
                                              {kind::frame_3D, access::out, "end"}}};
  double pitch;
  Axis axis;
  constexpr screw(double m_per_rad, const Axis& direction) : pitch(m_per_rad), axis(direction) {}

  template <class C>
  KTE_INLINE constexpr auto relative(const C& x) const {
    const auto along = [this](const auto& rate) { return (pitch * rate) * axis; };
    return motion{along(x.q),     rotation_about(axis, x.cos, x.sin), along(x.q_dot), axis * x.q_dot, along(x.q_ddot),
                  axis * x.q_ddot};
  }
  constexpr void check(const parameter_check& where) const {
    where.finite(pitch, "pitch must be finite"), where.unit(axis, "axis must have length 1");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("pitch", self.pitch), visit("axis", self.axis);
  }
};
template <class Q, class B, class E, class Axis>
constexpr auto screw_joint_3D(const Q& coordinate, const B& from, const E& end, double pitch, const Axis& direction) {
  return connect(screw<Axis>(pitch, direction), coordinate, from, end);
}
constexpr auto screws =
    chain(screw_joint_3D(q1, base, a, 0.25, axis::z), inertia_3D(a, body),
          rigid_link_3D(a, b, vec3{0.25, 0.5, -0.375}, quarter_turn_x), screw_joint_3D(q2, b, c, -0.5, oblique),
          inertia_3D(c, body), screw_joint_3D(q3, c, d, 1.0, axis::x), inertia_3D(d, light))
        .gravity(fall);

TEST_CASE("a tree in the plane") {
  STATIC_REQUIRE(by_articulated_bodies<decltype(tree_2D)>);
  check(tree_2D, 3, usual, floor_2D, wall, motor);
}

TEST_CASE("the plane and space in one chain") {
  STATIC_REQUIRE(by_articulated_bodies<decltype(both)>);
  check(both, 4, usual, base, wall);
}

TEST_CASE("a joint made by a user") {
  STATIC_REQUIRE(by_articulated_bodies<decltype(screws)>);
  check(screws, models::by_own_elements(screws), 5, usual, base);
  // A body of mass m and inertia J about a screw along z, both through its centre of mass, falls by
  // (J + m h^2) q_ddot = - m g h.
  constexpr auto nut = chain(screw_joint_3D(q1, base, a, 0.5, axis::z),
                             inertia_3D(a, rigid_body{2.0, zero3{}, diagonal(1.0, 1.0, 0.75)}))
                           .gravity(along_z(-10.0));
  const std::array one_number{0.3}, none{0.0};
  CHECK(mass_matrix(nut, one_number)(0, 0) == 1.25);
  CHECK(forward_dynamics(nut, one_number, one_number, none)[0] == -8.0);
  CHECK(inverse_dynamics(nut, one_number, one_number, none)[0] == 10.0);
  const auto model = models::by_own_elements(nut);
  auto s = model.make_state();
  CHECK(mass_matrix(model, s, one_number)(0, 0) == 1.25);
  CHECK(forward_dynamics(model, s, one_number, one_number, none)[0] == -8.0);
  CHECK(inverse_dynamics(model, s, one_number, one_number, none)[0] == 10.0);
}

}  // namespace articulated_plane_test
