#include "dynamics/floating_bodies.hpp"

// Bodies that float and ball joints, in closed form and by other joints.

namespace floating_body_test {

using namespace kte;
using namespace kte::test::floating_bodies;
using models::element_by_element;

TEST_CASE("a free body: free fall, Euler's equations, forces in its axes") {
  random_numbers random(1);
  const auto runtime = element_by_element(lone);
  auto r = runtime.make_state();
  const double m = 2.5;
  const auto c = eigen(brick.com);
  const auto inertia = eigen(brick.inertia);
  const auto check = [&](const auto& x, const auto& y) { CHECK(gap(x, y) <= 40 * eps * 100); };  // numbers up to 100
  for (int round = 0; round < 100; ++round) {
    const auto q = random_configuration(lone, random);
    const auto v = random_vector<double, 6>(random, 3), tau = random_vector<double, 6>(random, 8);
    const Eigen::Matrix3d R = eigen(matrix(unit_quaternion<>{q[3], q[4], q[5], q[6]}));
    const Eigen::Vector3d g = R.transpose() * eigen(weight), w = v.tail(3), u = v.head(3), F = tau.head(3),
                          T = tau.tail(3);
    // Newton and Euler about the centre of mass, in axes of the body: m a_c = F + m g, I al + w x I w = T - c x F.
    const Eigen::Vector3d al = inertia.inverse() * (T - c.cross(F) - w.cross(inertia * w));
    const Eigen::Vector3d a_c = F / m + g;
    joint_vector<double, 6> a;  // a + w x v is the acceleration of the origin
    a << a_c - al.cross(c) - w.cross(w.cross(c)) - w.cross(u), al;
    check(forward_dynamics(lone, q, v, tau), a);
    check(forward_dynamics(runtime, r, q, v, tau), a);
    check(inverse_dynamics(lone, q, v, a), tau);
    check(inverse_dynamics(runtime, r, q, v, a), tau);
    Eigen::Matrix3d cross;
    cross << 0, -c[2], c[1], c[2], 0, -c[0], -c[1], c[0], 0;
    joint_matrix<double, 6> M;
    M << m * Eigen::Matrix3d::Identity(), -m * cross, m * cross, inertia - m * cross * cross;
    check(mass_matrix(lone, q), M);
    check(mass_matrix(runtime, r, q), M);
  }
}

TEST_CASE("a unit mass") {
  constexpr auto unit =
      chain(free_joint_3D(trunk, ground, body), inertia_3D(body, rigid_body{1.0, zero3{}, diagonal(1.0, 1.0, 1.0)}))
          .gravity(along_z(-9.5));
  CHECK(mass_matrix(unit, std::array{1.0, 2.0, 3.0, 0.6, 0.0, 0.8, 0.0}) == joint_matrix<double, 6>::Identity());
  // Half a turn about x: down is up. Falling, v turns in the axes of the body.
  const std::array q{1.0, 2.0, 3.0, 0.0, 1.0, 0.0, 0.0};
  const std::array v{0.0, 4.0, 0.0, 0.0, 0.0, 2.0};
  const std::array still{0.0, 0.0, 0.0, 0.0, 0.0, 0.0}, push{1.0, 0.0, 0.0, 0.0, 3.0, 0.0};
  const auto a = forward_dynamics(unit, q, v, push);
  CHECK(a == (joint_vector<double, 6>() << 1.0 + 8.0, 0.0, 9.5, 0.0, 3.0, 0.0).finished());
  CHECK(forward_dynamics(unit, q, still, still)[2] == 9.5);
  CHECK(inverse_dynamics(unit, q, still, still)[2] == -9.5);
  // In the state, gravity is an acceleration of the base, so a falling body has none.
  auto s = make_state(unit);
  set_positions(s, q), set_velocities(s, v);
  set_accelerations(s, forward_dynamics(unit, s));
  unit.doMotion(s);
  CHECK(s[body].acceleration == vec3{0.0, 0.0, 0.0});
}

TEST_CASE("a ball joint is three revolute joints") {
  constexpr auto spherical = chain(spherical_joint_3D(ball, ground, hand), inertia_3D(hand, stick),
                                   rigid_link_3D(hand, tip, vec3{0.1, -0.2, -0.7}))
                                 .gravity(weight);
  constexpr auto revolute =
      chain(revolute_joint_3D(q1, ground, gimbal, axis::x), revolute_joint_3D(q2, gimbal, ring, axis::y),
            revolute_joint_3D(q3, ring, hand, axis::z), inertia_3D(hand, stick),
            rigid_link_3D(hand, tip, vec3{0.1, -0.2, -0.7}))
          .gravity(weight);
  random_numbers random(2);
  auto s = make_state(spherical);
  auto t = make_state(revolute);
  for (int round = 0; round < 50; ++round) {
    auto angles = random_vector<double, 3>(random, 3);
    angles[1] /= 3;  // away from the singular positions at a quarter turn: condition of M below 20
    const auto rates = random_vector<double, 3>(random, 2);
    set_positions(t, angles), set_velocities(t, rates);
    set_accelerations(t, forward_dynamics(revolute, t));
    revolute.doMotion(t);
    s[ball].rotation = to_quaternion(t[hand].rotation);
    s[ball].ang_velocity = t[hand].ang_velocity;
    set_accelerations(s, forward_dynamics(spherical, s));
    spherical.doMotion(s);
    CHECK(gap(eigen(s[tip].position), eigen(t[tip].position)) <= 20 * eps);
    CHECK(gap(eigen(s[tip].velocity), eigen(t[tip].velocity)) <= 20 * eps * 5);
    CHECK(gap(eigen(s[tip].acceleration), eigen(t[tip].acceleration)) <= 20 * eps * 20 * 100);
    CHECK(gap(eigen(s[tip].ang_acceleration), eigen(t[tip].ang_acceleration)) <= 20 * eps * 20 * 100);
  }
}

TEST_CASE("a spherical pendulum swings like one on two revolute joints") {
  // The spin about the rod does not matter where the rod has no inertia about itself, nor where it does not spin.
  constexpr rigid_body rod{1.5, along_z(-0.8), diagonal(0.02, 0.02, 0.0)};
  constexpr rigid_body plate{1.5, along_z(-0.8), diagonal(0.02, 0.02, 0.04)};
  constexpr auto spherical =
      chain(spherical_joint_3D(ball, ground, hand), inertia_3D(hand, plate), rigid_link_3D(hand, tip, along_z(-0.8)))
          .gravity(weight);
  constexpr auto universal =
      chain(revolute_joint_3D(q1, ground, gimbal, axis::x), revolute_joint_3D(q2, gimbal, hand, axis::y),
            inertia_3D(hand, rod), rigid_link_3D(hand, tip, along_z(-0.8)))
          .gravity(weight);
  random_numbers random(3);
  auto s = make_state(spherical);
  auto t = make_state(universal);
  for (int round = 0; round < 50; ++round) {
    t[q1].q = random(3), t[q2].q = random(1.2), t[q1].q_dot = random(2), t[q2].q_dot = random(2);
    set_accelerations(t, forward_dynamics(universal, t));
    universal.doMotion(t);
    s[ball].rotation = to_quaternion(t[hand].rotation);
    s[ball].ang_velocity = {t[hand].ang_velocity.x, t[hand].ang_velocity.y, 0.0};
    set_accelerations(s, forward_dynamics(spherical, s));
    CHECK(std::abs(s[ball].ang_acceleration.z) <= 20 * eps * 10);  // it never spins
    spherical.doMotion(s);
    CHECK(gap(eigen(s[tip].velocity), eigen(t[tip].velocity)) <= 20 * eps * 5);
    // condition of M: 1/cos^2 1.2 = 8
    CHECK(gap(eigen(s[tip].acceleration), eigen(t[tip].acceleration)) <= 20 * eps * 8 * 50);
  }
}

TEST_CASE("a free joint in the plane is two slides and a revolute joint") {
  constexpr auto disc_body = planar_body(1.5, 0.2, vec3{0.1, -0.3, zero});
  constexpr auto free = chain(free_joint_2D(puck, table, disc), inertia_2D(disc, disc_body)).gravity(along_y(-9.81));
  constexpr auto joints =
      chain(prismatic_joint_2D(q1, table, rail, axis::x), prismatic_joint_2D(q2, rail, cart, axis::y),
            revolute_joint_2D(q3, cart, disc), inertia_2D(disc, disc_body))
          .gravity(along_y(-9.81));
  random_numbers random(4);
  const auto runtime = element_by_element(free);
  auto r = runtime.make_state();
  auto s = make_state(free);
  auto t = make_state(joints);
  for (int round = 0; round < 100; ++round) {
    const auto q = random_vector<double, 3>(random, 3), rates = random_vector<double, 3>(random, 3),
               tau = random_vector<double, 3>(random, 9);
    const double c = std::cos(q[2]), sn = std::sin(q[2]);
    Eigen::Matrix3d turn;  // to axes of the disc
    turn << c, sn, 0, -sn, c, 0, 0, 0, 1;
    const Eigen::Vector3d v = turn * rates, f = turn * tau;
    const Eigen::Vector3d a = forward_dynamics(free, q, v, f), b = forward_dynamics(joints, q, rates, tau);
    set_all(s, q, v, a), set_all(t, q, rates, b);
    free.doMotion(s), joints.doMotion(t);
    const Eigen::Vector3d across(-v[1], v[0], 0), turned = turn * b;  // a = R^T p'' - w x v
    CHECK(gap(a, turned - v[2] * across) <= 30 * eps * 300);
    const auto close = [](const auto& x, const auto& y) { CHECK(gap(x, y) <= 30 * eps * 300); };  // al up to 300
    close(Eigen::Vector2d(s[disc].position.x, s[disc].position.y),
          Eigen::Vector2d(t[disc].position.x, t[disc].position.y));
    close(Eigen::Vector3d(s[disc].velocity.x, s[disc].velocity.y, s[disc].ang_velocity),
          Eigen::Vector3d(t[disc].velocity.x, t[disc].velocity.y, t[disc].ang_velocity));
    close(Eigen::Vector3d(s[disc].acceleration.x, s[disc].acceleration.y, s[disc].ang_acceleration),
          Eigen::Vector3d(t[disc].acceleration.x, t[disc].acceleration.y, t[disc].ang_acceleration));
    close(inverse_dynamics(free, q, v, a), f);
    close(mass_matrix(free, q), (turn * mass_matrix(joints, q) * turn.transpose()).eval());
    close(forward_dynamics(runtime, r, q, v, f), a);
    close(inverse_dynamics(runtime, r, q, v, a), f);
    close(mass_matrix(runtime, r, q), mass_matrix(free, q));
    CHECK(forward_kinematics(runtime, r, q, "disc").position.x ==
          within_relative(forward_kinematics(free, q, disc).position.x, 4 * eps));
  }
}

TEST_CASE("the momentum of what floats changes by its weight alone") {
  random_numbers random(5);
  auto s = make_state(pair_of_bodies);
  for (int round = 0; round < 100; ++round) {
    const auto q = random_configuration(pair_of_bodies, random);
    const auto v = random_vector<double, 10>(random, 2);
    joint_vector<double, 10> tau = random_vector<double, 10>(random, 5);
    tau.head(6).setZero();  // forces inside, none on the trunk
    set_all(s, q, v, forward_dynamics(pair_of_bodies, q, v, tau));
    pair_of_bodies.doMotion(s);
    // Accelerations in the state are those against free fall: sum m a_c = 0, sum c x m a_c + I al + w x I w = 0.
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), torque = force;
    double size = 0;
    const auto add = [&](const auto& frame, double m, const Eigen::Vector3d& c, const Eigen::Matrix3d& inertia) {
      const Eigen::Matrix3d R = eigen(frame.rotation);
      const auto w = eigen(frame.ang_velocity), al = eigen(frame.ang_acceleration);
      const Eigen::Vector3d f = m * (eigen(frame.acceleration) + al.cross(c) + w.cross(w.cross(c)));
      force += R * f;
      torque += (eigen(frame.position) + R * c).cross(R * f) + R * (inertia * al + w.cross(inertia * w));
      size = std::max({size, f.norm(), (inertia * al).norm()});
    };
    add(s[body], 2.5, eigen(brick.com), eigen(brick.inertia));
    add(s[hand], 1.2, eigen(stick.com), eigen(stick.inertia));
    add(s[tip], 0.4, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero());
    // Accelerations have the condition of M, 100, in their errors; arms of 3 m.
    CHECK(force.norm() <= 20 * eps * 100 * std::max(1.0, size));
    CHECK(torque.norm() <= 20 * eps * 100 * 3 * std::max(1.0, size));
  }
}

}  // namespace floating_body_test
