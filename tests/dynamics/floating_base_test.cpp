#include "dynamics/floating_bodies.hpp"

// Bodies that float on bases that move, share rotations, are parts of other chains, and are NaN.

namespace floating_base_test {

using namespace kte;
using namespace kte::test::floating_bodies;
using models::element_by_element;

TEST_CASE("forward dynamics of a state is that of its numbers without tau, floating") {
  random_numbers random(9);
  const auto& c = pair_of_bodies;
  const auto q = random_configuration(c, random);
  const auto v = random_vector<double, 10>(random, 2);
  const joint_vector<double, 10> none = joint_vector<double, 10>::Zero();
  auto s = make_state(c);
  set_positions(s, q), set_velocities(s, v);
  const auto a = forward_dynamics(c, s);
  CHECK(gap(a, forward_dynamics(c, q, v, none)) <= 1e-14 * a.norm());
  const auto model = element_by_element(c);
  auto r = model.make_state();
  set_positions(r, q), set_velocities(r, v);
  CHECK(gap(forward_dynamics(model, r), a) <= 1e-14 * a.norm());
}

TEST_CASE("a free joint on a base that moves") {
  const auto runtime = element_by_element(hanging), free_runtime = element_by_element(pair_of_bodies);
  random_numbers random(13);
  const auto vector = [&random](double size) -> vec3<> { return {random(size), random(size), random(size)}; };
  const auto move = [&](auto& base) {
    base.position = vector(2), base.rotation = matrix(to_quaternion(vector(1.5)));
    base.velocity = vector(2), base.ang_velocity = vector(2);
    base.ang_acceleration = vector(3);
    base.acceleration = as<double>(transpose(base.rotation) * (vector(4) - weight));  // R^T (a - g)
  };
  const auto check = [&](const auto& c, const runtime_chain& m, const auto& after) {
    auto s = make_state(c);
    auto r = m.make_state();
    constexpr int n = std::remove_cvref_t<decltype(c)>::dofs;
    for (int round = 0; round < 20; ++round) {
      const auto q = random_configuration(c, random);
      const auto v = random_vector<double, n>(random, 2), a = random_vector<double, n>(random, 5);
      move(s[ground]);
      r.frame_3D("ground") = s[ground];
      set_all(s, q, v, a), set_all(r, q, v, a);
      const auto close = [](const auto& x, const auto& y, double bound) {
        CHECK(gap(x, y) <= bound * y.cwiseAbs().maxCoeff());
      };
      const auto tau = inverse_dynamics(c, s);
      close(inverse_dynamics(m, r), tau, 20 * eps);
      c.doMotion(s), c.clearForce(s), c.doForce(s);
      close((-forces(s)).eval(), tau, 20 * eps);
      close(eigen(forward_kinematics(m, r, "hand").position), eigen(forward_kinematics(c, s, hand).position), 10 * eps);
      close(eigen(forward_kinematics(c, s, hand).position), eigen(s[hand].position), 10 * eps);
      close(mass_matrix(m, r), mass_matrix(c, s), 20 * eps);
      const auto x = forward_dynamics(c, s);
      close(forward_dynamics(m, r), x, 1000 * eps);  // condition of M: 100
      set_accelerations(s, x);
      c.doMotion(s), c.clearForce(s), c.doForce(s);
      CHECK(forces(s).norm() <= 1000 * eps * tau.norm());  // what happens by itself needs no force
      after(s);
    }
  };
  check(hanging, runtime, [](const auto&) {});
  // What floats freely does not feel how the base moves: its centre of mass falls.
  check(pair_of_bodies, free_runtime, [](const auto& s) {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    double size = 0;
    const auto add = [&](const auto& frame, double m, const Eigen::Vector3d& c) {
      const auto w = eigen(frame.ang_velocity), al = eigen(frame.ang_acceleration);
      const Eigen::Vector3d f = m * (eigen(frame.acceleration) + al.cross(c) + w.cross(w.cross(c)));
      force += eigen(frame.rotation) * f;
      size = std::max(size, f.norm());
    };
    add(s[body], 2.5, eigen(brick.com)), add(s[hand], 1.2, eigen(stick.com)), add(s[tip], 0.4, Eigen::Vector3d::Zero());
    CHECK(force.norm() <= 2000 * eps * std::max(50.0, size));
  });
}

TEST_CASE("a static chain that floats, as one element of a runtime chain") {
  runtime_chain c;
  c.gravity(weight) << pair_of_bodies;
  auto r = c.make_state();
  random_numbers random(17);
  const auto q = random_configuration(pair_of_bodies, random);
  const auto v = random_vector<double, 10>(random, 2), a = random_vector<double, 10>(random, 5);
  const auto tau = inverse_dynamics(pair_of_bodies, q, v, a);
  set_all(r, q, v, a);
  c.doMotion(r), c.clearForce(r), c.doForce(r);
  CHECK(gap((-forces(r)).eval(), tau) <= 20 * eps * tau.cwiseAbs().maxCoeff());
  CHECK(gap(inverse_dynamics(c, r, q, v, a), tau) <= 20 * eps * tau.cwiseAbs().maxCoeff());
  CHECK(gap(mass_matrix(c, r, q), mass_matrix(pair_of_bodies, q)) <= 20 * eps * 10);
  CHECK(gap(forward_dynamics(c, r, q, v, tau), a) <= 1000 * eps * a.norm());  // condition of M: 100
}

TEST_CASE("two joints that share a rotation") {
  constexpr auto c = chain(spherical_joint_3D(ball, ground, body), inertia_3D(body, brick),
                           revolute_joint_3D(q1, body, socket, axis::x), inertia_3D(socket, stick),
                           spherical_joint_3D(ball, socket, hand), inertia_3D(hand, stick))
                         .gravity(weight);
  STATIC_REQUIRE(decltype(c)::dofs == 4);
  using V = joint_vector<double, 4>;
  const auto runtime = element_by_element(c);
  auto r = runtime.make_state();
  random_numbers random(18);
  const auto q = random_configuration(c, random);
  const V v = random_vector<double, 4>(random, 2), a = random_vector<double, 4>(random, 5);
  const V rest = inverse_dynamics(c, q, v, V(V::Zero())), tau = inverse_dynamics(c, q, v, a);
  Eigen::Matrix4d M;
  for (int j = 0; j < 4; ++j) M.col(j) = inverse_dynamics(c, q, v, V(V::Unit(j))) - rest;
  const double bound = 20 * eps * std::max(rest.norm(), tau.norm());
  CHECK(gap(inverse_dynamics(runtime, r, q, v, a), tau) <= bound);
  CHECK(gap(mass_matrix(runtime, r, q), M) <= bound);
  CHECK(gap(forward_dynamics(runtime, r, q, v, tau), a) <= 100 * bound);  // condition of M
  CHECK(gap(mass_matrix(c, q), M) <= bound);
  CHECK(gap(forward_dynamics(c, q, v, tau), a) <= 100 * bound);
}

TEST_CASE("NaN and quaternions of length 0 are errors, floating") {
  const auto runtime = element_by_element(pair_of_bodies);
  auto r = runtime.make_state();
  random_numbers random(16);
  const auto& c = pair_of_bodies;
  const auto good = random_configuration(c, random);
  const auto v = random_vector<double, 10>(random, 1);
  const std::string no_number = "kte: a coordinate is not finite: q[", no_force = "kte: a force is not finite: ";
  using kte::test::contains_text;
  const auto check_configuration = [&](const joint_vector<double, 12>& q, const std::string& what,
                                       const std::string& of_forces) {
    CHECK_THROWS_AS(mass_matrix(c, q), bad_argument);
    CHECK_THROWS_WITH(mass_matrix(c, q), contains_text(what));
    CHECK_THROWS_WITH(forward_kinematics(c, q, tip), contains_text(what));
    CHECK_THROWS_WITH(forward_dynamics(c, q, v, v), contains_text(what));
    CHECK_THROWS_AS(mass_matrix(runtime, r, q), bad_argument);
    CHECK_THROWS_WITH(mass_matrix(runtime, r, q), contains_text(what));
    CHECK_THROWS_WITH(forward_kinematics(runtime, r, q, "tip"), contains_text(what));
    CHECK_THROWS_WITH(forward_dynamics(runtime, r, q, v, v), contains_text(what));
    CHECK_THROWS_WITH(inverse_dynamics(runtime, r, q, v, v), contains_text(what));
    if (of_forces.empty()) return;
    CHECK_THROWS_WITH(inverse_dynamics(c, q, v, v), contains_text(of_forces));
  };
  for (const double x : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (int i = 0; i < 12; ++i) {
      auto q = good;
      q[i] = x;
      check_configuration(q, no_number + std::to_string(i), i >= 3 ? no_force + "q[" + std::to_string(i) : "");
    }
  for (const int i : {3, 7}) {
    auto q = good;
    q.segment(i, 4).setZero();
    const std::string no_rotation = std::string("kte: quaternion '") + (i == 3 ? "trunk" : "ball") + "' has length 0";
    check_configuration(q, no_rotation, no_rotation);
  }
  for (int i = 0; i < 10; ++i) {
    auto bad = v;
    bad[i] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(inverse_dynamics(c, good, v, bad), bad_argument);
    CHECK_THROWS_WITH(inverse_dynamics(c, good, v, bad), contains_text(no_force + "a[" + std::to_string(i)));
    CHECK_THROWS_WITH(inverse_dynamics(c, good, bad, v), contains_text(no_force + "v[" + std::to_string(i)));
    CHECK_THROWS_WITH(inverse_dynamics(runtime, r, good, v, bad),
                      contains_text("kte: an acceleration is not finite: a[" + std::to_string(i)));
    CHECK_THROWS_WITH(inverse_dynamics(runtime, r, good, bad, v),
                      contains_text("kte: a velocity is not finite: v[" + std::to_string(i)));
    CHECK_THROWS_MATCHES(forward_dynamics(c, good, bad, v), bad_argument, kte::test::says("not finite"));
    CHECK_THROWS_MATCHES(forward_dynamics(c, good, v, bad), bad_argument, kte::test::says("not finite"));
    CHECK_THROWS_MATCHES(forward_dynamics(runtime, r, good, bad, v), bad_argument, kte::test::says("not finite"));
    CHECK_THROWS_MATCHES(forward_dynamics(runtime, r, good, v, bad), bad_argument, kte::test::says("not finite"));
  }
  // Sizes.
  const Eigen::VectorXd twelve = good, ten = v;
  CHECK_THROWS_WITH(mass_matrix(c, ten), "kte: q has 10 numbers, the chain has 12 numbers of a configuration");
  CHECK_THROWS_WITH(mass_matrix(runtime, r, v), "kte: q has 10 numbers, the chain has 12 numbers of a configuration");
  CHECK_THROWS_WITH(forward_dynamics(c, twelve, ten, twelve),
                    "kte: tau has 12 numbers, the chain has 10 degrees of freedom");
  CHECK_THROWS_WITH(inverse_dynamics(c, twelve, twelve, ten),
                    "kte: v has 12 numbers, the chain has 10 degrees of freedom");
}

TEST_CASE("a body without inertia about an axis cannot be moved freely") {
  constexpr auto c = chain(free_joint_3D(trunk, ground, body), inertia_3D(body, point_mass(1.0)));
  const auto runtime = element_by_element(c);
  auto r = runtime.make_state();
  const auto q = neutral_configuration(c);
  const std::array<double, 6> v{};
  CHECK_THROWS_AS(forward_dynamics(c, q, v, v), singular_mass_matrix);
  CHECK_THROWS_AS(forward_dynamics(runtime, r, q, v, v), singular_mass_matrix);
  CHECK_NOTHROW(inverse_dynamics(c, q, v, v));
}

}  // namespace floating_base_test
