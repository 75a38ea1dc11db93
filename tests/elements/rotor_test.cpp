#include <kte/dynamics.hpp>
#include <kte/elements/dry_revolute_joint.hpp>
#include <kte/elements/rotor.hpp>
#include <kte/static.hpp>

#include <cmath>

#include "catch.hpp"
#include "chain/registered.hpp"
#include "elements/laws.hpp"

// Rotors on moving housings, and bearings with friction by their load.

namespace rotor_test {

using namespace kte;
using namespace kte::test;

// clang-format off
inline constexpr struct q_      final : coord_key<"q">         {} q;
inline constexpr struct ground_ final : frame_3D_key<"ground"> {} ground;
inline constexpr struct arm_    final : frame_3D_key<"arm">    {} arm;
inline constexpr struct tip_    final : frame_3D_key<"tip">    {} tip;
inline constexpr struct wall_   final : frame_2D_key<"wall">   {} wall;
inline constexpr struct rod_    final : frame_2D_key<"rod">    {} rod;
inline constexpr struct end_    final : frame_2D_key<"end">    {} rod_end;
// clang-format on

constexpr double L = 0.5, smoothing = 1e-2, g = 9.81;

auto pendulum(double radius) {
  return chain(dry_revolute_joint_3D(q, ground, arm, axis::z, radius, smoothing), rigid_link_3D(arm, tip, along_x(L)),
               inertia_3D(tip, point_mass(2.0)))
      .gravity(along_y(-g));
}

/// The pendulum in the plane.
auto planar_pendulum(double radius) {
  return chain(dry_revolute_joint_2D(q, wall, rod, radius, smoothing), rigid_link_2D(rod, rod_end, along_x(L)),
               inertia_2D(rod_end, point_mass(2.0)))
      .gravity(along_y(-g));
}

template <class Chain>
void check_pendulum(const Chain& c, double R) {
  const runtime_chain r = models::registered(record_of(c));
  CHECK(record_of(r) == record_of(c));
  auto state = r.make_state();
  for (const double rate : {3.0, -1.0, 0.02, 0.0}) {
    const double angle = 0.4, s = rate / std::sqrt(rate * rate + smoothing * smoothing);
    const double A = -R * s * std::abs(g * std::sin(angle) - L * rate * rate) / std::sqrt(L * L - R * R * s * s);
    const double expected = (A - g * std::cos(angle)) / L;
    const Eigen::Matrix<double, 1, 1> q1(angle), v1(rate), none(0.0);
    CHECK(forward_dynamics(c, q1, v1, none)[0] == within(expected, 2e-14));
    CHECK(forward_dynamics(r, state, q1, v1, none)[0] == within(expected, 2e-14));
    const Eigen::VectorXd a = Eigen::VectorXd::Constant(1, expected);
    CHECK(inverse_dynamics(c, q1, v1, a)[0] == within(0, 2e-14));
    CHECK(inverse_dynamics(r, state, q1, v1, a)[0] == within(0, 2e-14));
  }
}

TEST_CASE("a rotor has its reflected inertia, and turns its housing back") {
  runtime_chain c;
  c << revolute_joint_3D("p", "ground", "table", axis::z)
    << inertia_3D("table", rigid_body{1.0, zero3{}, sym3{0.2, 0.0, 0.0, 0.2, 0.0, 0.3}}) << inertia_gen("q", 0.5)
    << rotor_3D("q", "table", axis::z, 20.0, 0.01);
  auto s = c.make_state();
  const Eigen::MatrixXd m = mass_matrix(c, s, Eigen::Vector2d(0.1, 0.2));
  const int p = s.coordinate("p").q == 0.1 ? 0 : 1, spin = 1 - p;
  CHECK(m(spin, spin) == within(0.5 + 400 * 0.01, 1e-15));
  CHECK(m(p, spin) == within(20 * 0.01, 1e-16));
  CHECK(m(p, p) == within(0.3 + 0.01, 1e-16));
  CHECK(record_of(models::registered(record_of(c))) == record_of(c));
  CHECK(complaint([] {
          (void)rotor_3D("q", "a", axis::z, 1.0, -1.0);
        }).find("inertia must be finite and not negative") != std::string::npos);
  CHECK(complaint([] {
          (void)rotor_3D("q", "a", vec3<>{2, 0, 0}, 1.0, 1.0);
        }).find("axis must have length 1") != std::string::npos);
}

TEST_CASE("a gyroscope on a turntable tilts") {
  // The table turns at W about z, a gimbal on it tilts about x, a rotor spins in it about y with momentum h: at no tilt
  // the gimbal feels the torque W h about x.
  runtime_chain c;
  const sym3 ball{0.2, 0.0, 0.0, 0.2, 0.0, 0.2};
  c << revolute_joint_3D("table angle", "ground", "table", axis::z)
    << inertia_3D("table", rigid_body{1.0, zero3{}, ball}) << revolute_joint_3D("tilt", "table", "gimbal", axis::x)
    << inertia_3D("gimbal", rigid_body{1.0, zero3{}, ball}) << inertia_gen("spin", 0.1)
    << rotor_3D("spin", "gimbal", axis::y, 10.0, 0.02);
  auto s = c.make_state();
  const double W = 3, rate = 40;
  s.coordinate("table angle").q_dot = W, s.coordinate("spin").q_dot = rate;
  s.coordinate("table angle").q = 0.7;
  const Eigen::VectorXd a = forward_dynamics(c, s);
  set_accelerations(s, a);
  CHECK(s.coordinate("tilt").q_ddot == within(W * 10 * 0.02 * rate / 0.2, 1e-13));
  CHECK(s.coordinate("table angle").q_ddot == within(0, 1e-14));
  CHECK(s.coordinate("spin").q_ddot == within(0, 1e-14));
}

TEST_CASE("a pendulum on a bearing with friction by its load") {
  // With A = L q'' + g cos q, B = g sin q - L q'^2 and s the sign of q' the bearing carries m (B, A), so that
  // L A = - R s sqrt(A^2 + B^2): A = - R s |B| / sqrt(L^2 - R^2 s^2), and no acceleration fits where R s > L.
  check_pendulum(pendulum(0.05), 0.05);
  check_pendulum(planar_pendulum(0.05), 0.05);
}

TEST_CASE("a wheel runs down on its bearing") {
  // Balanced, it loads the bearing by its weight: I q'' = - R m g q' / sqrt(q'^2 + v^2), whatever its angle.
  constexpr double m = 3.0, I = 0.2, R = 0.01;
  runtime_chain c;
  c.gravity(along_y(-g)) << dry_revolute_joint_2D("q", "wall", "rod", R, smoothing).at(vec2{0.3, 0.1}, rotation_by(0.7))
                         << inertia_2D("rod", planar_body(m, I));
  auto s = c.make_state();
  CHECK(record_of(models::registered(record_of(c))) == record_of(c));
  for (const double rate : {5.0, -0.03, 0.0}) {
    s.coordinate("q").q = 0.2, s.coordinate("q").q_dot = rate;
    const double expected = -R * m * g * rate / std::sqrt(rate * rate + smoothing * smoothing) / I;
    CHECK(forward_dynamics(c, s)[0] == within(expected, 1e-15));
  }
  CHECK(complaint([] { (void)dry_revolute_joint_2D("q", "a", "b", -0.25); }) ==
        "kte: dry_revolute_joint_2D (coordinate 'q', base 'a', end 'b'): friction_radius must be finite and not "
        "negative, got -0.25");
}

TEST_CASE("a bearing jams from where accelerations lose half their digits") {
  // They are as 1 / sqrt(1 - (R s / L)^2), and lose a share 1 / (1 - R s / L) of eps
  const double angle = 0.4, rate = 3.0, s = rate / std::sqrt(rate * rate + smoothing * smoothing);
  const Eigen::Matrix<double, 1, 1> q1(angle), v1(rate), none(0.0);
  for (const double beyond : {-1e-9, -1e-12, 0.0, 1e-12, 1e-9, 1e-3}) {
    const auto c = pendulum(L / s * (1 + beyond));
    const runtime_chain r = models::registered(record_of(c));
    auto state = r.make_state();
    CHECK_THROWS_MATCHES(forward_dynamics(c, q1, v1, none), no_solution, says("jams at 'q': "));
    CHECK_THROWS_MATCHES(forward_dynamics(r, state, q1, v1, none), no_solution, says("jams at 'q': "));
  }
  for (const double before : {1e-2, 1e-4}) {
    const double R = L / s * (1 - before);
    const double A = -R * s * std::abs(g * std::sin(angle) - L * rate * rate) / std::sqrt(L * L - R * R * s * s);
    const double a = forward_dynamics(pendulum(R), q1, v1, none)[0];
    CHECK(a == within_relative((A - g * std::cos(angle)) / L, 1e-14 / before));
  }
}

TEST_CASE("a bearing jams where it is larger than its arm") {
  const auto c = pendulum(0.6);
  const runtime_chain r = models::registered(record_of(c));
  auto state = r.make_state();
  const Eigen::Matrix<double, 1, 1> angle(0.4), rate(3.0), none(0.0);
  CHECK_THROWS_AS(forward_dynamics(c, angle, rate, none), no_solution);
  CHECK_THROWS_AS(forward_dynamics(r, state, angle, rate, none), no_solution);
  const Eigen::Matrix<double, 1, 1> at_rest(0.0);
  CHECK(forward_dynamics(r, state, angle, at_rest, none)[0] == within(-g * std::cos(0.4) / L, 2e-14));
  CHECK(complaint([] {
          (void)dry_revolute_joint_3D("q", "a", "b", axis::z, -0.1);
        }).find("friction_radius must be finite and not negative, got -0.1") != std::string::npos);
  CHECK(complaint([] {
          (void)dry_revolute_joint_3D("q", "a", "b", axis::z, 0.1, 0.0);
        }).find("smoothing must be finite and positive, got 0") != std::string::npos);
}

}  // namespace rotor_test
