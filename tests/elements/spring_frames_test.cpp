#include <kte/runtime_chain/from_record.hpp>
#include <kte/static.hpp>

#include "catch.hpp"
#include "chain/registered.hpp"
#include "elements/laws.hpp"

// Springs between frames.

namespace spring_frames_test {

using namespace kte;
using namespace kte::test;

/// Moved by one more motion, positions are up to 5, with some 8 roundings each, and forces up to 3 k: relative to the
/// force twice the usual.
template <class S>
S along_a_line() {
  return 2 * rounding<S>;
}
/// The sixth derivative of the square of a distance less its rest length grows with the fifth power of the inverse
/// distance, above 1e3 in tries with distances below 0.3.
template <class S>
S by_differences_of_lengths() {
  return 20 * by_differences<S>;
}

template <class S>
void check_laws() {
  random_numbers draw(1);
  const S k = S(50) / 3, rest = S(1) / 7, most = S(5);
  const auto check = [&](const auto& spring, bool smooth) {
    CHECK(testing::loads_are_opposite<S>(spring, draw) <= rounding<S>);
    CHECK(change_when_moved<S>(spring, draw) <= along_a_line<S>());
    // By differences in double some tries would reach across the kink of saturation.
    if (smooth || !std::is_same_v<S, double>)
      CHECK(testing::force_is_gradient<S>(spring, draw, energy_of(spring)) <= k * by_differences_of_lengths<S>());
  };
  const auto check_both = [&](bool smooth, const auto&... numbers) {
    const auto flat = spring_2D("a", "b", numbers...);
    const auto solid = spring_3D("a", "b", numbers...);
    check(flat, smooth), check(solid, smooth);
    CHECK(planar_difference<S>(flat, solid, draw) <= along_a_line<S>());
  };
  check_both(true, rest, k);
  check_both(true, zero, k);
  check_both(false, rest, k, most);
  check_both(false, zero, k, most);
}

/// A spring from (1, 1) to (4, 5), 5 m away along (0.6, 0.8), with a quarter turn of the second frame.
template <class... Numbers>
auto pulled(Numbers... numbers) {
  auto x = trial_of(spring_2D("a", "b", numbers...), 1);
  x.template at<0>() = {.position = {1.0, 1.0}};
  x.template at<1>() = {.position = {4.0, 5.0}, .rotation = {0.0, 1.0}};
  x.doForce();
  CHECK(x.template at<0>().torque == 0.0);
  CHECK(x.template at<1>().torque == 0.0);
  return x;
}
/// Relative to the force, some four roundings: of the inverse of the distance, the direction, the products.
bool pulls_by(double force, const auto& x) {
  const double tolerance = 4 * eps<double> * std::abs(force);
  const auto is = [&](const vec2<>& v, double a, double b) {
    return std::abs(v.x - a) <= tolerance && std::abs(v.y - b) <= tolerance;
  };
  auto y = x;
  return is(y.template at<0>().force, 0.6 * force, 0.8 * force) &&
         is(y.template at<1>().force, -0.8 * force, 0.6 * force);
}
template <class... Numbers>
double energy(double distance, Numbers... numbers) {
  return energy_of(spring_3D("a", "b", numbers...))(frame_3D<>{}, frame_3D<>{.position = {0.0, distance, 0.0}});
}

TEST_CASE("springs between frames obey the laws") {
  check_laws<double>();
  check_laws<digits50>();
}

TEST_CASE("a spring pulls frames together beyond its rest length, and pushes them apart below") {
  CHECK(pulls_by(30.0, pulled(2.0, 10.0)));
  CHECK(pulls_by(-20.0, pulled(7.0, 10.0)));
  CHECK(pulls_by(0.0, pulled(5.0, 10.0)));
  CHECK(pulls_by(50.0, pulled(zero, 10.0)));
  CHECK(pulls_by(50.0, pulled(0.0, 10.0)));
  CHECK(pulls_by(3.0, pulled(2, one)));
  CHECK(pulls_by(0.0, pulled(2.0, zero)));
}

TEST_CASE("a spring between frames saturates") {
  CHECK(pulls_by(12.0, pulled(2.0, 10.0, 12.0)));
  CHECK(pulls_by(-12.0, pulled(7.0, 10.0, 12.0)));
  CHECK(pulls_by(30.0, pulled(2.0, 10.0, 31.0)));
  CHECK(pulls_by(30.0, pulled(2.0, 10.0, 0.0)));  // no saturation
  CHECK(pulls_by(12.0, pulled(zero, 10.0, 12.0)));
  CHECK(pulls_by(50.0, pulled(zero, 10.0, 51.0)));
  CHECK(pulls_by(50.0, pulled(zero, 10.0, 0.0)));
  CHECK(pulls_by(1.0, pulled(zero, 10.0, one)));
}

TEST_CASE("where a spring between frames saturates is an event") {
  const auto below = [](double distance, auto... numbers) {
    const auto at = vec3{0.0, distance, 0.0};
    const double solid = spring_3D("a", "b", numbers...).core.switching(frame_3D<>{}, frame_3D<>{.position = at});
    CHECK(spring_2D("a", "b", numbers...)
              .core.switching(spatial(frame_2D<>{}), spatial(frame_2D<>{.position = {0.0, distance}})) == solid);
    return solid;
  };
  CHECK(below(1.0, 0.5, 8.0, 4.0) == 0.0);  // stretched by 0.5 m to 4 N
  CHECK(below(0.0, 0.5, 8.0, 4.0) == 0.0);
  CHECK(below(0.75, 0.5, 8.0, 4.0) == 2.0);
  CHECK(below(1.25, 0.5, 8.0, 4.0) == -2.0);
  CHECK(below(0.5, zero, 8.0, 4.0) == 0.0);
  CHECK(below(9.0, 0.5, 8.0, 0.0) == 1.0);  // no saturation
}

TEST_CASE("the energy of a spring between frames") {
  CHECK(energy(5.0, 2.0, 10.0) == 45.0);
  CHECK(energy(5.0, zero, 10.0) == 125.0);
  CHECK(energy(5.0, 2.0, 10.0, 0.0) == 45.0);
  CHECK(energy(5.0, 3.0, 8.0, 4.0) == 7.0);  // 4 N along 2 m, but for half of the first 0.5 m
  CHECK(energy(5.0, zero, 8.0, 4.0) == 19.0);
  CHECK(energy(5.0, 3.0, 8.0, 100.0) == 16.0);
  CHECK(energy(0.0, 3.0, 8.0) == 36.0);
  CHECK(energy(5.0, 3.0, 0.0, 4.0) == 0.0);
}

TEST_CASE("a spring whose ends coincide gives no force, and no NaN") {
  const auto none = [](const auto& spring) {
    auto x = trial_of(spring, 1);
    x.template at<0>().position = x.template at<1>().position;
    x.doForce();
    return x.template at<0>().force == vec3<>{} && x.template at<1>().force == vec3<>{};
  };
  CHECK(none(spring_3D("a", "b", 0.5, 10.0)));
  CHECK(none(spring_3D("a", "b", 0.5, 10.0, 2.0)));
  CHECK(none(spring_3D("a", "b", zero, 10.0)));
  CHECK(none(spring_3D("a", "b", zero, 10.0, 2.0)));
}

TEST_CASE("nor are derivatives NaN where the ends of a spring coincide") {
  const auto force = [](const auto& spring, double length) {
    frame_3D<sloped> a, b;
    b.position.x = sloped(length, 1);
    const auto f = nth<0>(spring.core.doForce(a, b)).force.x;
    return std::pair{f.value, f.slope};
  };
  const auto energy = [](const auto& spring) {
    frame_3D<sloped> a, b;
    b.position.x = sloped(0, 1);
    return spring.core.potential_energy(a, b).slope;
  };
  CHECK(force(spring_3D("a", "b", 0.5, 8.0), 2.0) == std::pair{12.0, 8.0});
  CHECK(force(spring_3D("a", "b", 0.5, 8.0, 3.0), 2.0) == std::pair{3.0, 0.0});
  CHECK(std::isfinite(force(spring_3D("a", "b", 0.5, 8.0), 0.0).second));
  CHECK(std::isfinite(force(spring_3D("a", "b", 0.5, 8.0, 3.0), 0.0).second));
  CHECK(force(spring_3D("a", "b", zero, 8.0), 0.0) == std::pair{0.0, 8.0});
  CHECK(force(spring_3D("a", "b", zero, 8.0, 3.0), 0.0) == std::pair{0.0, 8.0});
  CHECK(std::isfinite(energy(spring_3D("a", "b", 0.5, 8.0))));
  CHECK(energy(spring_3D("a", "b", zero, 8.0, 3.0)) == 0.0);
}

TEST_CASE("a spring between frames keeps NaN") {
  const auto kept = [](const auto& spring) {
    auto x = trial_of(spring, 1);
    x.template at<0>().position.y = not_a_number;
    x.doForce();
    return std::isnan(x.template at<0>().force.y) && std::isnan(x.template at<1>().force.y);
  };
  CHECK(kept(spring_3D("a", "b", 0.5, 10.0)));
  CHECK(kept(spring_3D("a", "b", 0.5, 10.0, 2.0)));
  CHECK(kept(spring_3D("a", "b", zero, 10.0)));
  CHECK(kept(spring_3D("a", "b", zero, 10.0, 2.0)));
}

TEST_CASE("springs and dampers between frames of any size") {
  // From the origin to 3 m along x and 4 m along y, times what squares of double cannot hold.
  for (const double size : {1e-200, 1e-155, 1e155, 1e200, 1e300}) {
    CAPTURE(size);
    const auto pull = [&](const auto& element) {
      auto x = trial_of(element, 1);
      x.template at<0>() = {.velocity = {-1.0, 0.0, 0.0}};
      x.template at<1>() = {.position = {3 * size, 4 * size, 0.0}};
      x.doForce();
      return x.template at<0>().force;
    };
    const double k = 5 / (5 * size), eps = 8 * 0x1p-52;
    CHECK(near(pull(spring_3D("a", "b", 0.0, k)), vec3{3.0, 4.0, 0.0}, 5 * eps));
    CHECK(near(pull(spring_3D("a", "b", zero, k, 2.5)), vec3{1.5, 2.0, 0.0}, 5 * eps));
    CHECK(near(pull(spring_3D("a", "b", 0.0, k, 2.5)), vec3{1.5, 2.0, 0.0}, 5 * eps));
    CHECK(near(pull(damper_3D("a", "b", 5.0)), vec3{1.8, 2.4, 0.0}, 5 * eps));
  }
}

TEST_CASE("stiff springs saturate") {
  for (const double k : {1e155, 1e200, 1e300}) {
    CAPTURE(k);
    const auto check = [&](const auto& spring, double most) {
      auto x = trial_of(spring, 1);
      x.template at<0>() = {};
      x.template at<1>() = {.position = {3e5, 4e5, 0.0}};
      x.doForce();
      CHECK(x.template at<0>().force.x / most == within(0.6, 1e-15));
      CHECK(x.template at<0>().force.y / most == within(0.8, 1e-15));
      CHECK(energy_of(spring)(x.template at<0>(), x.template at<1>()) / most == within_relative(5e5, 1e-15));
    };
    check(spring_3D("a", "b", zero, k, 7.0), 7);
    check(spring_3D("a", "b", 0.0, k, 7.0), 7);
    check(spring_3D("a", "b", zero, k, 1e120), 1e120);
    if (k == 1e300) check(spring_3D("a", "b", zero, k, 1e200), 1e200);
    auto x = trial_of(torsion_spring_3D("a", "b", k, 7.0), 1);
    x.at<0>() = {};
    x.at<1>() = {.rotation = {{0.0, 0.0, 1.0}, {0.0, 1.0, 0.0}, {-1.0, 0.0, 0.0}}};  // a quarter turn
    x.doForce();
    CHECK(x.at<0>().torque.y == within(7, 1e-14));
  }
}

TEST_CASE("a spring between frames wants finite numbers, and none negative") {
  const std::string where = "kte: spring_3D (anchor1 'wall', anchor2 'hand'): ";
  const auto what = [](auto... numbers) { return complaint([&] { (void)spring_3D("wall", "hand", numbers...); }); };
  CHECK(what(not_a_number, 1.0) == where + "rest length must be finite and not negative, got nan");
  CHECK(what(-0.5, 1.0) == where + "rest length must be finite and not negative, got -0.5");
  CHECK(what(0.1, -2.0) == where + "stiffness must be finite and not negative, got -2");
  CHECK(what(0.1, infinity) == where + "stiffness must be finite and not negative, got inf");
  CHECK(what(0.1, 1.0, -3.0) == where + "saturation must be finite and not negative, got -3");
  CHECK(what(0.1, 0.0, 0.0) == "");
  CHECK(what(zero, 1) == "");
  CHECK(complaint([] { (void)spring_2D("wall", "hand", -1, 1.0); }) ==
        "kte: spring_2D (anchor1 'wall', anchor2 'hand'): rest length must be finite and not negative, got -1");
}

// clang-format off
inline constexpr struct q1_     final : coord_key<"q1">        {} q1;
inline constexpr struct q2_     final : coord_key<"q2">        {} q2;
inline constexpr struct base_   final : frame_3D_key<"base">   {} base;
inline constexpr struct hook_   final : frame_3D_key<"hook">   {} hook;
inline constexpr struct upper_  final : frame_3D_key<"upper">  {} upper;
inline constexpr struct elbow_  final : frame_3D_key<"elbow">  {} elbow;
inline constexpr struct lower_  final : frame_3D_key<"lower">  {} lower;
inline constexpr struct hand_   final : frame_3D_key<"hand">   {} hand;
// clang-format on

/// An arm of two joints with something between its hand and a hook on the wall, and between its hand and upper arm.
template <class E1, class E2>
constexpr auto arm_with(const E1& e1, const E2& e2) {
  return chain(rigid_link_3D(base, hook, vec3{0.25, 0.5, 1.0}, quarter_turn_x), revolute_joint_3D(q1, base, upper),
               rigid_link_3D(upper, elbow, along_x(0.5), quarter_turn_y), revolute_joint_3D(q2, elbow, lower, axis::x),
               rigid_link_3D(lower, hand, vec3{0.125, 0.25, -0.5}), e1, e2);
}

/// The torques that hold an arm against its springs are the gradient of their energy. By five points, h = 1e-10:
/// rounding 1e-50/h and h^4 of the fifth derivative.
template <class E1, class E2>
void check_gradient(const E1& e1, const E2& e2) {
  const auto arm = arm_with(e1, e2);
  using V = joint_vector<digits50, 2>;
  const auto energy = [&](const V& q) {
    auto s = make_state<digits50>(arm);
    s[q1].q = q[0], s[q2].q = q[1];
    arm.doMotion(s);
    return digits50(e1.core.potential_energy(s[hook], s[hand]) + e2.core.potential_energy(s[hand], s[upper]));
  };
  random_numbers draw(1);
  const digits50 h = 1e-10;
  for (int i = 0; i < 5; ++i) {
    const V q(digits50(draw(3)), digits50(draw(3)));
    const V tau = inverse_dynamics(arm, q, V(V::Zero()), V(V::Zero()));
    CHECK(tau.norm() > 0.1);
    for (int j = 0; j < 2; ++j) {
      const V u = V::Unit(j) * h;
      const digits50 slope = (8 * (energy(q + u) - energy(q - u)) - (energy(q + 2 * u) - energy(q - 2 * u))) / (12 * h);
      CHECK(abs(slope - tau[j]) < 1e-34);
    }
    auto s = make_state<digits50>(arm);
    s[q1].q = q[0], s[q2].q = q[1];
    arm.doMotion(s), arm.clearForce(s), arm.doForce(s);
    CHECK(abs(s[q1].f + tau[0]) < 1e-46);
    CHECK(abs(s[q2].f + tau[1]) < 1e-46);
  }
}

TEST_CASE("an arm is held against springs by the gradient of their energy") {
  check_gradient(spring_3D(hook, hand, 0.25, 8.0), spring_3D(hand, upper, 0.375, 4.0));
  check_gradient(spring_3D(hook, hand, zero, 8.0), spring_3D(hand, upper, 0.25, 16.0, 1.0));
  check_gradient(torsion_spring_3D(hook, hand, 8.0), spring_3D(hand, upper, zero, 16.0, 1.0));
}

TEST_CASE("what springs and dampers do not read is not computed, what they read is") {
  // Both frames at rest on the base: positions and rotations are typed.
  constexpr auto c = chain(revolute_joint_3D(q1, base, upper), rigid_link_3D(base, hook, along_z(1)),
                           inertia_3D(upper, point_mass(1.0, along_x(1))), spring_3D(base, hook, 0.5, 8.0),
                           damper_3D(base, hook, 1.0), torsion_spring_3D(base, hook, 8.0),
                           torsion_damper_3D(base, hook, 1.0), spring_3D(base, hook, zero, 8.0, 1.0));
  CHECK(inverse_dynamics(c, std::array{0.5}, std::array{2.0}, std::array{3.0})[0] == 3.0);
}

TEST_CASE("elements between frames in files") {
  runtime_chain c;
  c << base_2D("a") << base_2D("b") << base_3D("x") << base_3D("y") << spring_2D("a", "b", 0.5, 8.0, 1.0)
    << spring_3D("x", "y", zero, 8.0) << damper_2D("a", "b", 0.5) << damper_3D("x", "y", 0.25)
    << torsion_spring_2D("a", "b", 8.0, 1.0, -0.5) << torsion_spring_3D("x", "y", 8.0, 2.0)
    << torsion_damper_2D("a", "b", 0.125) << torsion_damper_3D("x", "y", 2.0);
  const auto record = record_of(c);
  CHECK(record.elements.size() == 12);
  CHECK(record_of(models::registered(record)) == record);
  const auto arm = arm_with(spring_3D(hook, hand, zero, 8.0), torsion_spring_3D(hand, upper, 0.25));
  CHECK(record_of(from_record(arm, record_of(arm))) == record_of(arm));
}

}  // namespace spring_frames_test
