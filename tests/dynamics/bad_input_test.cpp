#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/derivatives.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/frame_motion.hpp>
#include <kte/dynamics/hybrid_dynamics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/jacobian.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/dynamics/mass_matrix_inverse.hpp>
#include <kte/dynamics/regressor.hpp>
#include <kte/elements/position_control.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include <limits>

#include "catch.hpp"
#include "chain/models.hpp"
#include "robots/iiwa14.hpp"

// A call without a result throws; it never returns NaN.

namespace bad_input_test {

inline constexpr struct ball_ final : kte::rotation_3D_key<"ball"> {
} ball;

using models::element_by_element, models::ground, models::hip, models::knee, models::left, models::thigh, models::trunk;

TEST_CASE("a coordinate that moves no mass") {
  using namespace kte;
  // A point mass on the axis of its joint.
  constexpr auto c = chain(revolute_joint_3D(hip, ground, trunk, axis::x), rigid_link_3D(trunk, left, along_y(0.5)),
                           revolute_joint_3D(knee, left, thigh, axis::z), inertia_3D(thigh, point_mass(1.0)));
  const std::array two{0.1, 0.2};
  const std::string singular = "kte: the mass matrix is singular: '";
  CHECK_THROWS_MATCHES(forward_dynamics(c, two, two, two), singular_mass_matrix,
                       test::says(singular + "knee' moves no mass independently of the others"));
  const auto model = element_by_element(c);
  auto s = model.make_state();
  CHECK_THROWS_AS(forward_dynamics(model, s, two, two, two), singular_mass_matrix);
  CHECK_NOTHROW(inverse_dynamics(c, two, two, two));
  constexpr auto none = chain(revolute_joint_3D(hip, ground, trunk, axis::x));
  CHECK_THROWS_WITH(forward_dynamics(none, std::array{0.1}, std::array{0.1}, std::array{0.1}),
                    test::contains_text(singular + "hip'"));
  // Three coordinates of one joint, and a coordinate with its own mass that is nothing.
  constexpr auto turning = chain(spherical_joint_3D(ball, ground, trunk), inertia_3D(trunk, point_mass(1.0)));
  CHECK_THROWS_WITH(mass_matrix_inverse(turning, std::array{1.0, 0.0, 0.0, 0.0}),
                    test::contains_text(singular + "ball'"));
  // A coordinate that another follows.
  constexpr auto following = chain(rigid_link_gen(hip, knee, 0.5), revolute_joint_3D(knee, ground, trunk),
                                   revolute_joint_3D(models::slide, trunk, left),
                                   inertia_3D(left, rigid_body{1.0, zero3{}, diagonal(1.0, 1.0, 1.0)}));
  CHECK_THROWS_WITH(forward_dynamics(following, two, two, two), test::contains_text(singular + "slide'"));
  CHECK_THROWS_WITH(mass_matrix_inverse(following, two), test::contains_text(singular + "slide'"));
}

TEST_CASE("arguments that are not finite") {
  const auto model = element_by_element(robots::iiwa14);
  auto s = model.make_state();
  const std::array<double, 7> good{0.1, -0.2, 0.3, 0.4, -0.5, 0.6, 0.7};
  const auto& c = robots::iiwa14;
  const auto& tool = robots::iiwa14_names::tool;
  CHECK_NOTHROW(kte::forward_dynamics(c, good, good, good));
  for (const double x : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -HUGE_VAL})
    for (std::size_t i = 0; i < 7; ++i) {
      auto bad = good;
      bad[i] = x;
      CHECK_THROWS_AS(kte::inverse_dynamics(c, good, bad, good), kte::bad_argument);
      CHECK_THROWS_AS(kte::inverse_dynamics(c, good, good, bad), kte::bad_argument);
      CHECK_THROWS_AS(kte::mass_matrix(c, bad), kte::bad_argument);
      CHECK_THROWS_AS(kte::forward_kinematics(c, bad, tool), kte::bad_argument);
      CHECK_THROWS_MATCHES(kte::forward_dynamics(c, bad, good, good), kte::bad_argument, kte::test::says("not finite"));
      CHECK_THROWS_MATCHES(kte::forward_dynamics(c, good, bad, good), kte::bad_argument, kte::test::says("not finite"));
      CHECK_THROWS_MATCHES(kte::forward_dynamics(c, good, good, bad), kte::bad_argument, kte::test::says("not finite"));
      CHECK_THROWS_AS(kte::inverse_dynamics(model, s, good, bad, good), kte::bad_argument);
      CHECK_THROWS_AS(kte::mass_matrix(model, s, bad), kte::bad_argument);
      CHECK_THROWS_AS(kte::forward_kinematics(model, s, bad, "tool"), kte::bad_argument);
      CHECK_THROWS_MATCHES(kte::forward_dynamics(model, s, good, good, bad), kte::bad_argument,
                           kte::test::says("not finite"));
      CHECK_THROWS_MATCHES(kte::forward_dynamics(model, s, good, bad, good), kte::bad_argument,
                           kte::test::says("not finite"));
      if (i > 0) CHECK_THROWS_AS(kte::inverse_dynamics(c, bad, good, good), kte::bad_argument);
    }
}

/// A slide along x with friction: its force on the coordinate is not that of virtual power alone.
struct frictional_joint : kte::transmission<frictional_joint> {
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
  template <class Self, class Visit>
  static constexpr void parameters(Self&, Visit&&) {}
};

TEST_CASE("a joint with its own force") {
  using namespace kte;
  const auto slide = chain(connect(frictional_joint{}, hip, ground, trunk), inertia_3D(trunk, point_mass(2.0)));
  const std::array q{0.1}, v{0.5}, a{3.0};
  CHECK(inverse_dynamics(slide, q, v, a)[0] == 6.25);  // m a + c v; what is beyond that does not compile
  for (const bool nested : {false, true}) {
    runtime_chain model;
    if (nested)
      model << slide;
    else
      model << connect(frictional_joint{}, "hip", "ground", "trunk") << inertia_3D("trunk", point_mass(2.0));
    auto s = model.make_state();
    CHECK(inverse_dynamics(model, s, q, v, a)[0] == 6.25);
    model.doMotion(s), model.clearForce(s), model.doForce(s);
    CHECK(s.coordinate("hip").f == -6.25);
    const auto refused =
        test::contains_text("frictional_joint_3D (coordinate 'hip', base 'ground', end 'trunk') has its own `doForce`");
    CHECK_THROWS_WITH(forward_dynamics(model, s), refused);
    CHECK_THROWS_WITH(mass_matrix(model, s), refused);
    CHECK_THROWS_WITH(mass_matrix_inverse(model, s), refused);
    CHECK_THROWS_WITH(inverse_dynamics_derivatives(model, s), refused);
    CHECK_THROWS_WITH(forward_dynamics_derivatives(model, s), refused);
    CHECK_THROWS_WITH(hybrid_dynamics(model, s, q, v, a, {}), refused);
    CHECK_THROWS_WITH(gravity_forces(model, s), refused);
    CHECK_THROWS_WITH(coriolis_forces(model, s), refused);
    CHECK_THROWS_WITH(torque_regressor(model, s), refused);
    CHECK_THROWS_WITH(torque_regressor(model, s, q, v, a), refused);
  }
}

TEST_CASE("the argument at fault is named") {
  using namespace kte;
  using kte::test::contains_text;
  const auto model = element_by_element(robots::iiwa14);
  auto s = model.make_state();
  const std::array<double, 7> good{0.1, -0.2, 0.3, 0.4, -0.5, 0.6, 0.7};
  auto large = good, none = good;
  large[2] = 1e160, none[3] = std::numeric_limits<double>::infinity();
  const auto& c = robots::iiwa14;
  const std::string force = "kte: a force is not finite: ", third(robots::iiwa14_names::q3.name);
  const auto too_large = force + "v[2] of '" + third + "' is " + detail::number(1e160) + ", too large";
  CHECK_THROWS_WITH(inverse_dynamics(c, good, large, good), too_large);
  CHECK_THROWS_WITH(inverse_dynamics(model, s, good, large, good), too_large);
  CHECK_THROWS_WITH(inverse_dynamics(c, good, good, none), contains_text(force + "a[3] of") && contains_text("is inf"));
  const std::string acceleration = "kte: an acceleration is not finite: ";
  CHECK_THROWS_WITH(forward_dynamics(c, good, good, none), contains_text(acceleration + "tau[3] of"));
  CHECK_THROWS_WITH(forward_dynamics(model, s, good, good, none),
                    contains_text("kte: a force is not finite: tau[3] of"));
  CHECK_THROWS_WITH(forward_dynamics(c, good, large, good), contains_text(acceleration + "v[2] of"));

  // A link whose squared length overflows.
  constexpr auto arm = chain(revolute_joint_3D(hip, ground, trunk, axis::z), rigid_link_3D(trunk, left, along_x(1e155)),
                             inertia_3D(left, point_mass(1.0)));
  const auto long_arm = element_by_element(arm);
  auto l = long_arm.make_state();
  const std::array one{0.1};
  const std::string
      mass = "kte: a mass is not finite: ",
      far = "the bodies moved by 'hip' are too heavy, too far away, or infinitely fast (a loop at its dead centre)";
  CHECK_THROWS_WITH(mass_matrix(arm, one), mass + far);
  CHECK_THROWS_WITH(mass_matrix(long_arm, l, one), contains_text(mass));
  CHECK_THROWS_MATCHES(forward_dynamics(arm, one, one, one), bad_argument, test::says(mass + far));
  CHECK_THROWS_WITH(mass_matrix_inverse(arm, one), mass + far);
  // Moments of inertia that are good, and products that overflow where they are turned.
  constexpr auto skew =
      chain(revolute_joint_3D(hip, ground, trunk, axis::z), revolute_joint_3D(knee, trunk, left, axis::x),
            inertia_3D(left, rigid_body{1.0, zero3{}, sym3{1.0, 1.5e308, 1.5e308, 1.0, 0.0, 1.0}}.as_published()));
  CHECK_THROWS_WITH(mass_matrix(skew, std::array{0.5, 0.75}), contains_text(mass));
}

TEST_CASE("the velocity or configuration at fault is named") {
  using namespace kte;
  constexpr auto c =
      chain(revolute_joint_3D(hip, ground, trunk, axis::x), inertia_3D(trunk, point_mass(1.0, along_y(0.5))));
  const std::array good{0.5}, nan{std::numeric_limits<double>::quiet_NaN()}, large{1e200};
  const std::string velocity = "kte: a velocity is not finite: v[0] of 'hip' is nan";
  CHECK_THROWS_WITH(kinetic_energy(c, good, nan), velocity);
  CHECK_THROWS_WITH(energy(c, good, nan), velocity);
  CHECK_THROWS_WITH(centre_of_mass_velocity(c, good, nan), velocity);
  CHECK_THROWS_WITH(centroidal_momentum(c, good, nan), velocity);
  CHECK_THROWS_WITH(frame_velocity(c, good, nan, trunk), velocity);
  CHECK_THROWS_WITH(frame_acceleration(c, good, good, nan, trunk),
                    "kte: an acceleration is not finite: a[0] of 'hip' is nan");
  const std::string coordinate = "kte: a coordinate is not finite: ";
  CHECK_THROWS_WITH(energy(c, nan, good), coordinate + "q[0] of 'hip' is nan");
  CHECK_THROWS_WITH(jacobian(c, nan, trunk), coordinate + "q[0] of 'hip' is nan");
  CHECK_THROWS_WITH(centre_of_mass(c, nan), coordinate + "q[0] of 'hip' is nan");
  CHECK_THROWS_WITH(integrate(c, good, nan, 0.1), coordinate + "v[0] of 'hip' is nan");
  CHECK_THROWS_WITH(integrate(c, nan, good, 0.1), coordinate + "q[0] of 'hip' is nan");
  CHECK_THROWS_WITH(difference(c, good, nan), coordinate + "to[0] of 'hip' is nan");
  CHECK_THROWS_WITH(configuration_rate(c, good, nan), "kte: a rate is not finite: v[0] of 'hip' is nan");
  const auto too_large = "v[0] of 'hip' is " + detail::number(1e200) + ", too large";
  CHECK_THROWS_WITH(kinetic_energy(c, good, large), "kte: an energy is not finite: " + too_large);
}

TEST_CASE("quaternions of any length but 0") {
  using namespace kte;
  constexpr auto c = chain(spherical_joint_3D(ball, ground, trunk),
                           inertia_3D(trunk, rigid_body{1.0, along_x(0.5), diagonal(1.0, 1.5, 2.0)}));
  const auto model = element_by_element(c);
  auto s = model.make_state();
  const auto of_length = [](double size) { return std::array{size, -0.5 * size, 0.25 * size, 0.75 * size}; };
  const std::array v{1.0, 2.0, 3.0};
  const Eigen::Vector3d tau = inverse_dynamics(c, of_length(1), v, v);
  for (const double size : {1e-300, 1e-200, 1e-160, 1e-130, 1e130, 1e160, 1e300}) {
    CAPTURE(size);
    CHECK((inverse_dynamics(c, of_length(size), v, v) - tau).norm() <= 1e-15 * tau.norm());
    CHECK((inverse_dynamics(model, s, of_length(size), v, v) - tau).norm() <= 1e-15 * tau.norm());
    CHECK_NOTHROW(mass_matrix(model, s, of_length(size)));
  }
  CHECK_THROWS_WITH(mass_matrix(c, of_length(0)), "kte: quaternion 'ball' has length 0");
  CHECK_THROWS_WITH(mass_matrix(model, s, of_length(0)), "kte: quaternion 'ball' has length 0");
}

TEST_CASE("a call that throws leaves the state unchanged") {
  using limits = std::numeric_limits<double>;
  using vector = std::vector<double>;
  auto c = element_by_element(models::pendulum);
  const auto smaller = c;
  c << kte::inertia_2D("tip", kte::point_mass(1.0));
  auto s = c.make_state(), foreign = smaller.make_state();
  const vector old{0.25}, one{0.5}, two{0.5, 0.5}, nan{limits::quiet_NaN()}, inf{limits::infinity()};
  for (auto* x : {&s, &foreign}) set_positions(*x, old), set_velocities(*x, old), set_accelerations(*x, old);
  const auto refused = [&](kte::runtime_state& x, const auto& call) {
    CHECK_THROWS_AS(call(), kte::error);
    CHECK(positions(x)[0] == 0.25);
    CHECK(velocities(x)[0] == 0.25);
    CHECK(accelerations(x)[0] == 0.25);
  };
  const auto of_q = [&](kte::runtime_state& x, const vector& q) {
    refused(x, [&] { (void)mass_matrix(c, x, q); });
    refused(x, [&] { (void)mass_matrix_inverse(c, x, q); });
    refused(x, [&] { (void)forward_kinematics(c, x, q); });
    refused(x, [&] { (void)forward_kinematics(c, x, q, "tip"); });
    refused(x, [&] { (void)jacobian(c, x, q, "tip"); });
    refused(x, [&] { (void)static_forces(c, x, q); });
    refused(x, [&] { (void)centroidal_momentum_matrix(c, x, q); });
  };
  const auto of_v = [&](kte::runtime_state& x, const vector& q, const vector& v) {
    refused(x, [&] { (void)nonlinear_effects(c, x, q, v); });
    refused(x, [&] { (void)energy(c, x, q, v); });
    refused(x, [&] { (void)centroidal_momentum(c, x, q, v); });
    refused(x, [&] { (void)frame_velocity(c, x, q, v, "tip"); });
  };
  const auto of_all = [&](kte::runtime_state& x, const vector& q, const vector& v, const vector& a) {
    refused(x, [&] { (void)inverse_dynamics(c, x, q, v, a); });
    refused(x, [&] { (void)inverse_dynamics_derivatives(c, x, q, v, a); });
    refused(x, [&] { (void)forward_dynamics(c, x, q, v, a); });
    refused(x, [&] { (void)forward_dynamics_derivatives(c, x, q, v, a); });
    refused(x, [&] { (void)hybrid_dynamics(c, x, q, v, a, {"q"}); });
    refused(x, [&] { (void)hybrid_dynamics(c, x, q, v, a, {}); });
    refused(x, [&] { (void)frame_acceleration(c, x, q, v, a, "tip"); });
  };
  for (const auto* bad : {&two, &nan, &inf}) {
    of_q(s, *bad);
    of_v(s, *bad, one), of_v(s, one, *bad);
    of_all(s, *bad, one, one), of_all(s, one, *bad, one), of_all(s, one, one, *bad);
  }
  of_q(foreign, one), of_v(foreign, one, one), of_all(foreign, one, one, one);
  refused(s, [&] { (void)forward_kinematics(c, s, one, "tpi"); });
  refused(s, [&] { (void)jacobian(c, s, one, "tpi"); });
  refused(s, [&] { (void)frame_velocity(c, s, one, one, "tpi"); });
  refused(s, [&] { (void)frame_acceleration(c, s, one, one, one, "tpi"); });
  refused(s, [&] { (void)hybrid_dynamics(c, s, one, one, one, {"tpi"}); });
  CHECK(forward_dynamics(c, s, one, one, one)[0] == 1.0);  // and it goes on: 0.5 Nm on 0.5 kg m^2
}

inline constexpr struct place_ final : kte::vector_key<"place"> {
} place;
inline constexpr struct speed_ final : kte::vector_key<"speed"> {
} speed;

TEST_CASE("signals that are not finite are named, and frames never stand nowhere") {
  using namespace kte;
  constexpr auto c = chain(position_control_3D(place, speed, speed, ground, trunk), revolute_joint_3D(hip, trunk, left),
                           inertia_3D(left, rigid_body{1.0, along_x(0.5), diagonal(1.0, 1.0, 1.0)}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::array one{1.0};
  auto s = make_state(c);
  s[place].y = nan;
  CHECK_THROWS_MATCHES(forward_kinematics(c, s, left), bad_argument,
                       test::says("where a frame stands is not finite: y of input 'place' is nan"));
  s[place].y = 0, s[speed].z = nan;
  CHECK_NOTHROW(forward_kinematics(c, s, left));
  CHECK_THROWS_MATCHES(inverse_dynamics(c, s), bad_argument,
                       test::says("a force is not finite: z of input 'speed' is nan"));
  CHECK_THROWS_MATCHES(forward_dynamics(c, s), bad_argument,
                       test::says("an acceleration is not finite: z of input 'speed' is nan"));

  const auto model = element_by_element(c);
  auto r = model.make_state();
  r.vector("place").y = nan;
  CHECK_THROWS_MATCHES(forward_kinematics(model, r), bad_argument,
                       test::says("where frame 'trunk' stands is not finite: y of input 'place' is nan"));
  CHECK_THROWS_AS(forward_kinematics(model, r, one), bad_argument);
  CHECK_THROWS_AS(forward_kinematics(model, r, "left"), bad_argument);
  r.vector("place").y = 0, r.vector("speed").z = nan;
  CHECK_THROWS_MATCHES(forward_dynamics(model, r), bad_argument,
                       test::says("an acceleration is not finite: z of input 'speed' is nan"));
}

TEST_CASE("large angles keep their digits") {
  // 1e5 is the largest angle of the vector sine, beyond it libm takes over: both sides of the limit.
  const auto shifted = [](double turns) {
    std::array<double, 7> q{};
    for (std::size_t i = 0; i < 7; ++i) q[i] = turns + 0.1 * static_cast<double>(i);
    return q;
  };
  for (const double size : {9.9e4, 1.1e5, 1e9}) {
    const auto M = kte::mass_matrix(robots::iiwa14, shifted(size));
    std::array<long double, 7> exact{};
    for (std::size_t i = 0; i < 7; ++i) exact[i] = shifted(size)[i];
    const auto L = kte::mass_matrix(robots::iiwa14, exact);
    CHECK((M - L.cast<double>()).cwiseAbs().maxCoeff() < 1e-14);
  }
}

}  // namespace bad_input_test
