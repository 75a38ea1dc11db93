#include <kte/dynamics.hpp>
#include <kte/elements/line_point_mindist.hpp>
#include <kte/elements/position_control.hpp>
#include <kte/elements/position_measure.hpp>
#include <kte/elements/spring.hpp>

#include "catch.hpp"

// Measures, frames that follow others, and bases whose motion is given block no algorithm of bodies on static chains:
// results are those of the chain without them.

namespace passed_over_test {

using namespace kte;

// clang-format off
inline constexpr struct q1_     final : coord_key<"q1">       {} q1;
inline constexpr struct q2_     final : coord_key<"q2">       {} q2;
inline constexpr struct ground_ final : frame_3D_key<"ground"> {} ground;
inline constexpr struct stand_  final : frame_3D_key<"stand">  {} stand;
inline constexpr struct a_      final : frame_3D_key<"a">     {} a;
inline constexpr struct b_      final : frame_3D_key<"b">     {} b;
inline constexpr struct foot_   final : frame_3D_key<"foot">  {} foot;
inline constexpr struct u_      final : vector_key<"u">       {} u;
inline constexpr struct v_      final : vector_key<"v">       {} v_key;
inline constexpr struct w_      final : vector_key<"w">       {} w;
inline constexpr struct x_      final : input_key<"x">        {} x;
inline constexpr struct y_      final : input_key<"y">        {} y;
inline constexpr struct z_      final : input_key<"z">        {} z;
inline constexpr struct seen_   final : vector_key<"seen">    {} seen;
// clang-format on

constexpr rigid_body body{1.5, vec3{0.02, -0.03, 0.1}, sym3{0.3, 0.01, -0.02, 0.25, 0.03, 0.2}};

template <class... E>
auto arm_with(const E&... more) {
  return chain(revolute_joint_3D(q1, ground, a, axis::y), inertia_3D(a, body), prismatic_joint_3D(q2, a, b, axis::x),
               inertia_3D(b, body), more...)
      .gravity(vec3{0.5, -0.25, -9.75});
}

/// All numbers of what algorithms of bodies give, one after another.
template <class Chain>
std::vector<double> of_bodies(const Chain& c) {
  std::vector<double> all;
  const auto add = [&all](const auto&... number) { (all.push_back(number), ...); };
  const auto add_vector = [&add](const vec3<>& v) { add(v.x, v.y, v.z); };
  const auto add_matrix = [&all](const auto& m) { all.insert(all.end(), m.data(), m.data() + m.size()); };
  const std::array q{0.25, -0.5}, v{1.0, -0.75}, acc{0.5, 2.0};
  add(kinetic_energy(c, q, v), energy(c, q, v).kinetic);
  add_vector(centre_of_mass(c, q).position), add_vector(centre_of_mass_velocity(c, q, v));
  add_vector(centroidal_momentum(c, q, v).angular), add_matrix(centroidal_momentum_matrix(c, q));
  add_vector(centroidal_momentum_rate(c, q, v, acc).angular), add_matrix(centre_of_mass_jacobian(c, q));
  add_vector(subtree_inertia(c, q, a).moment), add_matrix(torque_regressor(c, q, v, acc));
  add_matrix(gravity_forces(c, q)), add_matrix(coriolis_forces(c, q, v)), add_matrix(mass_matrix(c, q));
  return all;
}

constexpr auto nearest = line_point_mindist_3D(a, foot, axis::x, vec3{0.0, 1.0, 0.0});
constexpr std::array here{0.25, -0.5};

TEST_CASE("measures block no algorithm of static chains") {
  const auto plain = arm_with();
  const auto measured = arm_with(position_measure_3D(b, seen));
  CHECK(of_bodies(measured) == of_bodies(plain));
  CHECK(potential_energy(measured, here) == potential_energy(plain, here));
  CHECK(forward_dynamics(measured, here, here, here) == forward_dynamics(plain, here, here, here));
  CHECK(coriolis_matrix(measured, here, here) == coriolis_matrix(plain, here, here));
  const auto seen_there = arm_with(nearest, position_measure_3D(foot, seen));
  CHECK(of_bodies(seen_there) == of_bodies(plain));
  CHECK(forward_dynamics(seen_there, here, here, here) == forward_dynamics(plain, here, here, here));
}

TEST_CASE("frames that follow others block no algorithm of static chains") {
  const auto plain = arm_with();
  const auto sprung = arm_with(nearest, spring_3D(foot, ground, 0.125, 3.0));
  CHECK(of_bodies(sprung) == of_bodies(plain));
  const double length = 1, spring = 3 * (length - 0.125) * (length - 0.125) / 2;  // foot at (0, 1, 0)
  CHECK(potential_energy(sprung, here) == within(potential_energy(plain, here) + spring, 1e-14));
}

TEST_CASE("bases whose motion is given block no algorithm of static chains") {
  const auto plain = arm_with();
  const auto given = chain(position_control_3D(u, v_key, w, stand, ground), plain).gravity(vec3{0.5, -0.25, -9.75});
  CHECK(of_bodies(given) == of_bodies(plain));
  CHECK(potential_energy(given, here) == potential_energy(plain, here));
  CHECK(generalized_momenta(given, here, here) == generalized_momenta(plain, here, here));
}

TEST_CASE("coordinates whose motion is given have no row in the regressor of static chains") {
  const auto c = chain(position_control_gen(x, y, z, q1), arm_with()).gravity(vec3{0.5, -0.25, -9.75});
  const std::array q{-0.5}, v{-0.75}, acc{2.0};
  const auto tau = (torque_regressor(c, q, v, acc) * inertial_parameters(c)).eval();
  CHECK(tau.rows() == 1);
  CHECK(tau[0] == within(inverse_dynamics(c, q, v, acc)[0], 1e-14));
}

TEST_CASE("loads from outside are any vectors") {
  const auto c = arm_with();
  const vec3<> f{1, 0, 0}, t{0, 2, 0};
  CHECK(external_forces(c, here, wrench_on(b, along_x(1.0), along_y(2.0))) ==
        external_forces(c, here, wrench_on(b, f, t)));
  CHECK(external_forces(c, here, wrench_on(b, axis::x, {0, 2, 0})) == external_forces(c, here, wrench_on(b, f, t)));
  CHECK(external_forces(c, here, wrench_on(b, {1, 0, 0})) == external_forces(c, here, wrench_on(b, f)));
}

}  // namespace passed_over_test
