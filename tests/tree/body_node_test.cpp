#include <kte/dynamics/derivatives.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/frame_motion.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/jacobian.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/dynamics/mass_matrix_inverse.hpp>
#include <kte/dynamics/regressor.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include "catch.hpp"
#include "chain/models.hpp"
#include "math/gap.hpp"
#include "random.hpp"

// Joints and bodies of users' own, as runtime chains take them: by numbers alone (tree/build.hpp). Against static
// chains, which compute with their types.

namespace body_node_test {

using namespace kte;
using kte::test::contains_text, kte::test::within;

using three = std::array<port, 3>;
constexpr three on_number{{{kind::gen, access::angle, "coordinate"},
                           {kind::frame_3D, access::in, "base"},
                           {kind::frame_3D, access::out, "end"}}};

struct without_parameters {
  constexpr void check(const parameter_check&) const {}
  template <class Self, class Visit>
  static constexpr void parameters(Self&, Visit&&) {}
};

/// Turns about z by q, slides along z by q / 4, with its axis 0.5 beside the end; and half as much.
struct screw : transmission<screw>, without_parameters {
  static constexpr type_name type{"screw", kind::frame_3D};
  static constexpr auto& ports = on_number;
  template <class C>
  constexpr auto relative(const C& c) const {
    constexpr auto beside = along_x(0.5);
    const auto moved = [](const auto& rate) { return vec3{zero, rate * 0.5, rate * 0.25}; };
    const mat3 r{vec3{c.cos, -c.sin, zero}, vec3{c.sin, c.cos, zero}, vec3{zero, zero, one}};
    const auto w = vec3{zero, zero, c.q_dot};
    return motion{r * beside + along_z(0.25) * c.q, r, moved(c.q_dot), w, moved(c.q_ddot) + cross(w, moved(c.q_dot)),
                  vec3{zero, zero, c.q_ddot}};
  }
};
/// A rack: slides by 0.125 a unit of its coordinate, along an axis that is no axis of the frame.
struct rack : transmission<rack>, without_parameters {
  static constexpr type_name type{"rack", kind::frame_3D};
  static constexpr auto& ports = on_number;
  template <class C>
  constexpr auto relative(const C& c) const {
    constexpr vec3 along{0.075, 0.0, 0.1};
    return motion{along * c.q, no_rotation{}, along * c.q_dot, zero3{}, along * c.q_ddot, zero3{}};
  }
};
/// A ball whose end stands beside its centre.
struct ball_beside : transmission<ball_beside>, without_parameters {
  static constexpr type_name type{"ball_beside", kind::frame_3D};
  static constexpr three ports{{{kind::rotation_3D, access::angle, "coordinate"},
                                {kind::frame_3D, access::in, "base"},
                                {kind::frame_3D, access::out, "end"}}};
  template <class X>
  constexpr auto relative(const X& c) const {
    const auto ball = motion{zero3{}, c.rotation, zero3{}, c.ang_velocity, zero3{}, c.ang_acceleration};
    return compose(ball, at_rest(quarter_turn_x, vec3{0.25, -0.5, 0.125}));
  }
};
/// Turns by q + q^3: not along an axis at a constant rate.
struct uneven : transmission<uneven>, without_parameters {
  static constexpr type_name type{"uneven", kind::frame_3D};
  static constexpr auto& ports = on_number;
  template <class C>
  constexpr auto relative(const C& c) const {
    using std::cos;
    using std::sin;
    const auto a = c.q + c.q * c.q * c.q;
    const auto rate = [&c](const auto& r) { return (one + constant<3>{} * c.q * c.q) * r; };
    const mat3 r{vec3{one, zero, zero}, vec3{zero, cos(a), -sin(a)}, vec3{zero, sin(a), cos(a)}};
    return motion{zero3{}, r, zero3{}, vec3{rate(c.q_dot), zero, zero}, zero3{}, vec3{rate(c.q_ddot), zero, zero}};
  }
};
/// A mass that is dragged, too: no rigid body.
struct dragged : without_parameters {
  static constexpr type_name type{"dragged", kind::frame_3D};
  static constexpr std::array<port, 1> ports{{{kind::frame_3D, access::in, "frame"}}};
  template <class Frame>
  constexpr auto doForce(const Frame& x) const {
    return make_loads(wrench{-2.0 * x.acceleration, -0.5 * x.ang_velocity});
  }
  template <class S>
  constexpr auto mass() const {
    return composite{2.0, zero3{}, sym3<zero_t>{}};
  }
};
/// Needs a position, and does not say so as static chains want it.
struct buoyancy : without_parameters {
  static constexpr type_name type{"buoyancy", kind::frame_3D};
  static constexpr std::array<port, 1> ports{{{kind::frame_3D, access::on, "frame"}}};
  template <class Frame>
  constexpr auto doForce(const Frame& x) const {
    return make_loads(wrench{transpose(matrix(x.rotation)) * (along_z(-3.0) * x.position.z), zero3{}});
  }
};

// clang-format off
constexpr struct q1_   final : coord_key<"q1">         {} q1;
constexpr struct q2_   final : coord_key<"q2">         {} q2;
constexpr struct ball_ final : rotation_3D_key<"ball"> {} ball;
constexpr struct base_ final : frame_3D_key<"base">    {} base;
constexpr struct a_    final : frame_3D_key<"a">       {} a;
constexpr struct b_    final : frame_3D_key<"b">       {} b;
constexpr struct c_    final : frame_3D_key<"c">       {} c;
constexpr struct d_    final : frame_3D_key<"d">       {} d;
// clang-format on

constexpr rigid_body body{1.5, vec3{0.1, -0.2, 0.25}, sym3{0.2, 0.01, -0.02, 0.25, 0.03, 0.3}};
constexpr auto own_joints =
    chain(connect(screw{}, q1, base, a), inertia_3D(a, body),
          rigid_link_3D(a, b, vec3{0.5, 0.25, -0.125}, quarter_turn_y), connect(ball_beside{}, ball, b, c),
          inertia_3D(c, body), connect(rack{}, q2, c, d), inertia_3D(d, body))
        .gravity(vec3{0.5, -1.0, -9.81});

/// The largest difference of entries, relative to the largest of `size`.
template <class X, class Y, class Size>
double gap(const X& x, const Y& y, const Size& size) {
  return (x - y).cwiseAbs().template maxCoeff<Eigen::PropagateNaN>() / size.cwiseAbs().maxCoeff();
}
template <class X, class Y>
double gap(const X& x, const Y& y) {
  return gap(x, y, y);
}
/// Both compute with another order of sums. Out and back through three joints, the products and sums of six rotations
/// and shifts are some 50 roundings of u = 2^-53, in either: a random walk of sqrt(100) u of the size of the terms.
/// Measured in 4000 states, by two compilers, with and without FMA: 9 u at most.
constexpr double rounding = 1.1e-15;
/// Of regressors and derivatives, sums of terms that are larger than the largest entry: 15 u and 27 u in those states.
constexpr double rounding_of_regressor = 2.2e-15, rounding_of_derivatives = 4e-15;

TEST_CASE("joints of users' own move along and about z of their nodes") {
  const runtime_chain run = models::by_own_elements(own_joints);
  auto s = run.make_state();
  random_numbers random(1);
  for (int round = 0; round < 100; ++round) {
    std::array<double, 6> q;
    std::array<double, 5> v, x;
    for (auto* numbers : {v.data(), x.data()})
      for (int i = 0; i < 5; ++i) numbers[i] = random();
    for (auto& number : q) number = random();
    const std::array<double, 5> none{};
    const Eigen::Map<const Eigen::Matrix<double, 5, 1>> given(x.data());
    const auto mass = mass_matrix(own_joints, q), inverse = mass_matrix_inverse(own_joints, q);
    const auto bias = inverse_dynamics(own_joints, q, v, none), forces = inverse_dynamics(own_joints, q, v, x);
    CHECK(gap(mass_matrix(run, s, q), mass) < rounding);
    CHECK(gap(mass_matrix_inverse(run, s, q), inverse) < rounding);
    const auto terms = (mass.cwiseAbs() * given.cwiseAbs() + bias.cwiseAbs()).eval();
    CHECK(gap(inverse_dynamics(run, s, q, v, x), forces, terms) < rounding);
    const auto terms_of_accelerations = (inverse.cwiseAbs() * (given.cwiseAbs() + bias.cwiseAbs())).eval();
    CHECK(gap(forward_dynamics(run, s, q, v, x), forward_dynamics(own_joints, q, v, x), terms_of_accelerations) <
          rounding);
    CHECK(gap(jacobian(run, s, q, "d"), jacobian(own_joints, q, d)) < rounding);
    const Eigen::MatrixXd y = torque_regressor(run, s, q, v, x);
    CHECK(gap(y, torque_regressor(own_joints, q, v, x)) < rounding_of_regressor);
    CHECK(gap(y * inertial_parameters(run), inverse_dynamics(run, s), terms) < rounding);
    const auto of_forces = inverse_dynamics_derivatives(own_joints, q, v, x);
    const auto& derivatives = inverse_dynamics_derivatives(run, s, q, v, x);
    CHECK(gap(derivatives.by_q, of_forces.by_q) < rounding_of_derivatives);
    CHECK(gap(derivatives.by_v, of_forces.by_v) < rounding_of_derivatives);
    const auto p = forward_kinematics(run, s, q, "d").position, exact = forward_kinematics(own_joints, q, d).position;
    CHECK(p.x == within(exact.x, rounding));
    CHECK(p.y == within(exact.y, rounding));
    CHECK(p.z == within(exact.z, rounding));
  }
}

TEST_CASE("a joint without constant axes is known to the passes alone") {
  runtime_chain run;
  run << connect(uneven{}, "q1", "base", "a") << inertia_3D("a", body);
  run.gravity(along_z(-9.81));
  auto s = run.make_state();
  const std::array q{0.5}, v{0.25}, x{-1.5};
  const double tau = inverse_dynamics(run, s, q, v, x)[0];
  run.doMotion(s), run.clearForce(s), run.doForce(s);
  CHECK(tau == within(-s.coordinate("q1").f, 1e-15));
  CHECK_THROWS_WITH(
      mass_matrix(run, s, q),
      contains_text("uneven_3D (coordinate 'q1', base 'base', end 'a') moves along axes that are not constant"));
  CHECK_THROWS_AS(forward_dynamics(run, s, q, v, x), bad_argument);
  CHECK_THROWS_AS(mass_matrix_inverse(run, s, q), bad_argument);
  CHECK_THROWS_AS(jacobian(run, s, q, "a"), bad_argument);
  CHECK_THROWS_WITH(
      torque_regressor(run, s, q, v, x),
      contains_text("uneven_3D (coordinate 'q1', base 'base', end 'a') moves along axes that are not constant"));
  CHECK_NOTHROW(forward_kinematics(run, s, q, "a"));
}

TEST_CASE("a mass that is no rigid body has the law it says") {
  runtime_chain run;
  run << revolute_joint_3D("q1", "base", "a", axis::x) << rigid_link_3D("a", "b", along_y(0.5))
      << connect(dragged{}, "b");
  run.gravity(along_z(-9.81));
  auto s = run.make_state();
  // On a circle of 0.5 m: 2 * 0.25 kg m^2, drag 0.5 q_dot, weight 2 * 9.81 at 0.5 cos q.
  const std::array q{0.5}, v{2.0}, x{-1.5};
  const double needed = 0.5 * x[0] + 0.5 * v[0] + 9.81 * std::cos(q[0]);
  CHECK(inverse_dynamics(run, s, q, v, x)[0] == within(needed, 2e-15));  // an ulp of 8.9
  CHECK(mass_matrix(run, s, q)(0, 0) == within(0.5, 1e-16));
  const std::array tau{needed};
  CHECK(forward_dynamics(run, s, q, v, tau)[0] == within(x[0], 4e-15));  // two roundings of 8.9, divided by 0.5
  const auto& derived = inverse_dynamics_derivatives(run, s, q, v, x);
  CHECK(derived.by_q(0, 0) == within(-9.81 * std::sin(q[0]), 4e-15));
  CHECK(derived.by_v(0, 0) == within(0.5, 1e-15));
  CHECK(derived.by_a(0, 0) == within(0.5, 1e-16));
  CHECK(torque_regressor(run, s, q, v, x).cols() == 0);  // its parameters, if any, are not those of a body
  CHECK(inertial_parameters(run).size() == 0);
}

TEST_CASE("forces in runtime chains see positions without a word") {
  runtime_chain run;
  run << prismatic_joint_3D("q1", "base", "a", axis::z) << inertia_3D("a", point_mass(1.5)) << connect(buoyancy{}, "a");
  auto s = run.make_state();
  const std::array q{0.5}, v{0.0}, x{2.0};
  CHECK(inverse_dynamics(run, s, q, v, x)[0] == within(3.0 + 1.5, 1e-15));
  const std::array tau{0.0};
  CHECK(forward_dynamics(run, s, q, v, tau)[0] == within(-1.0, 1e-15));
}

TEST_CASE("a coordinate that moves nothing, or too much, is named") {
  runtime_chain run;
  run << revolute_joint_3D("q1", "base", "a", axis::x) << inertia_3D("a", body)
      << revolute_joint_3D("q2", "a", "b", axis::y);
  auto s = run.make_state();
  const std::array x{0.5, 0.25};
  CHECK_THROWS_WITH(forward_dynamics(run, s, x, x, x), contains_text("singular: 'q2'"));
  CHECK_THROWS_WITH(mass_matrix_inverse(run, s, x), contains_text("singular: 'q2'"));
  runtime_chain far;
  far << revolute_joint_3D("q1", "base", "a", axis::x) << rigid_link_3D("a", "b", along_y(1e155))
      << inertia_3D("b", body);
  auto f = far.make_state();
  const std::array y{0.5};
  CHECK_THROWS_WITH(mass_matrix(far, f, y), contains_text("'q1'") && !contains_text("singular"));
  CHECK_THROWS_WITH(forward_dynamics(far, f, y, y, y), contains_text("'q1'") && !contains_text("singular"));
}

TEST_CASE("a result of a state may be an argument of the next call with it") {
  runtime_chain run;
  run << revolute_joint_3D("q1", "base", "a", axis::x) << inertia_3D("a", body)
      << revolute_joint_3D("q2", "a", "b", axis::y) << inertia_3D("b", body) << damper_gen("q1", "q2", 2.0);
  auto s = run.make_state();
  const std::array q{0.5, 0.25}, v{1.0, -2.0}, a{0.75, 1.5};
  const auto& result = forward_dynamics(run, s, q, v, inverse_dynamics(run, s, q, v, a));
  CHECK(result[0] == within(a[0], 1e-15));
  CHECK(result[1] == within(a[1], 1e-15));
}

}  // namespace body_node_test
