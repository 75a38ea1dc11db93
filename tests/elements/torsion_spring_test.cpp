#include <kte/elements/torsion_spring.hpp>
#include <kte/math/axis_angle.hpp>

#include "catch.hpp"
#include "chain/registered.hpp"
#include "elements/laws.hpp"

namespace torsion_spring_test {

using namespace kte;
using namespace kte::test;

template <class S>
void check_laws() {
  random_numbers draw(1);
  const S k = S(50) / 3, rest = S(11) / 7, most = S(15);
  const auto check = [&](const auto& spring, bool smooth) {
    CHECK(testing::loads_are_opposite<S>(spring, draw) <= rounding<S>);
    CHECK(change_when_moved<S>(spring, draw) <= rounding<S>);
    // By differences in double some tries would reach across the kink of saturation, or across half a turn.
    random_numbers tries(1);
    if (smooth || !std::is_same_v<S, double>)
      CHECK(testing::force_is_gradient<S>(spring, tries, energy_of(spring)) <= k * by_differences<S>);
  };
  check(torsion_spring_2D("a", "b", k), true);
  check(torsion_spring_2D("a", "b", k, zero, rest), true);
  check(torsion_spring_2D("a", "b", k, most), false);
  check(torsion_spring_3D("a", "b", k), true);
  check(torsion_spring_3D("a", "b", k, most), false);
  check(torsion_spring_3D("a", "b", k, zero, quarter_turn_x), true);
  CHECK(planar_difference<S>(torsion_spring_2D("a", "b", k), torsion_spring_3D("a", "b", k), draw) <= rounding<S>);
  CHECK(planar_difference<S>(torsion_spring_2D("a", "b", k, most), torsion_spring_3D("a", "b", k, most), draw) <=
        rounding<S>);
}

/// The torque on the first of two frames at the given angles.
template <class S = double, class... Numbers>
S torque(const S& angle1, const S& angle2, Numbers... numbers) {
  auto x = trial_of<S>(torsion_spring_2D("a", "b", numbers...), 1);
  x.template at<0>().rotation = rotation_by(angle1);
  x.template at<1>().rotation = rotation_by(angle2);
  x.doForce();
  CHECK(x.template at<1>().torque == -x.template at<0>().torque);
  CHECK(x.template at<0>().force == vec2<S>{});
  return x.template at<0>().torque;
}
/// The torque on the first of two frames, the second turned by a rotation in it.
template <class S, class... Numbers>
vec3<S> torque_of_turn(const mat3<vec3<S>>& turn, Numbers... numbers) {
  auto x = trial_of<S>(torsion_spring_3D("a", "b", numbers...), 1);
  x.template at<1>().rotation = x.template at<0>().rotation * turn;
  x.doForce();
  CHECK(x.template at<1>().torque == -x.template at<0>().torque);
  CHECK(x.template at<0>().force == vec3<S>{});
  return x.template at<0>().torque;
}
template <class S>
const S pi = acos(S(-1));

/// Angles from parts of the last digit to parts of it from half a turn, about many axes, at stiffness 1. Rotations err
/// by some 8 roundings of their entries, so the angle does, by no more, and the axis, times the angle.
template <class S>
void check_all_angles() {
  random_numbers draw(2);
  const S tiny = eps<S>;
  for (const S& angle : {S(tiny / 8), S(sqrt(tiny) / 3), S(sqrt(tiny)), S(1e-3), S(0.5), S(1.5), S(pi<S> / 2), S(2.0),
                         S(3.0), S(pi<S> - S(1e-3)), S(pi<S> - sqrt(tiny)), S(pi<S> - 32 * tiny)})
    for (int i = 0; i < 20; ++i) {
      const vec3<S> v{S(draw()), S(draw()), S(draw())};
      const vec3<S> r = S(angle / sqrt(dot(v, v))) * v;
      CHECK(near(torque_of_turn<S>(matrix(r), 1), r, rounding<S>));
    }
  for (const auto& axis : {as<S>(axis::x), as<S>(axis::y), as<S>(axis::z), as<S>(axis::minus_y)})
    for (const S& angle : {S(1e-3), S(1), S(3)})
      CHECK(near(torque_of_turn<S>(matrix(angle * axis), 1), angle * axis, rounding<S>));
}

TEST_CASE("torsion springs obey the laws") {
  check_laws<double>();
  check_laws<digits50>();
}

TEST_CASE("a torsion spring in the plane") {
  const auto close = [](double x, double y) { return std::abs(x - y) <= 8 * 4 * eps<double>; };  // 8 Nm/rad, up to pi
  CHECK(torque(0.0, 0.0, 8.0) == 0.0);
  CHECK(close(torque(0.25, 1.0, 8.0), 6.0));
  CHECK(close(torque(1.0, 0.25, 8.0), -6.0));
  CHECK(close(torque(3.0, -3.0, 8.0), 8 * (2 * pi<double> - 6)));  // the shortest way leads across pi
  CHECK(close(torque(0.0, 9.0, 8.0), 8 * (9 - 2 * pi<double>)));   // whole turns do not count
  CHECK(close(torque(0.25, 1.0, 8.0, zero, 0.5), 2.0));
  CHECK(close(torque(0.25, 1.0, 8.0, zero, 0.75), 0.0));
  CHECK(close(torque(0.0, -3.0, 8.0, 0.0, 3.0), 8 * (2 * pi<double> - 6)));
  CHECK(close(torque(0.0, 1.0, 8.0, zero, one), 0.0));
  CHECK(close(torque(0.0, 3.125, 8.0), 25.0));  // the jump at half a turn
  CHECK(close(torque(0.0, 3.1875, 8.0), 8 * (3.1875 - 2 * pi<double>)));
}

TEST_CASE("a torsion spring in space may rest at any rotation") {
  const vec3 turn{0.5, 0.75, 1.5};
  const auto rest = matrix(vec3{-0.3, 1.1, 0.4});
  auto x = trial_of(torsion_spring_3D("a", "b", 4.0, zero, rest), 1);
  const auto torques = [&](const mat3<vec3<>>& between) {
    x.at<0>().torque = x.at<1>().torque = {};
    x.at<1>().rotation = x.at<0>().rotation * between;
    x.doForce();
    return std::pair{x.at<0>().torque, x.at<1>().torque};
  };
  CHECK(near(torques(rest).first, vec3<>{}, 4 * rounding<double>));
  const auto [first, second] = torques(matrix(turn) * rest);
  CHECK(near(first, 4.0 * turn, 4 * rounding<double>));
  CHECK(near(rest * second, -4.0 * turn, 4 * rounding<double>));
  // About z it is the one in the plane; a quaternion will do.
  random_numbers draw(3);
  CHECK(planar_difference<double>(torsion_spring_2D("a", "b", 4.0, zero, 0.5),
                                  torsion_spring_3D("a", "b", 4.0, zero, to_quaternion(vec3{0.0, 0.0, 0.5})),
                                  draw) <= 4 * rounding<double>);
  CHECK(complaint([&] {
          (void)torsion_spring_3D("a", "b", 4.0, zero, 2.0 * rest);
        }).find("rest rotation must be a rotation") != std::string::npos);
}

TEST_CASE("files of torsion springs have a rest rotation if there is one") {
  runtime_chain c;
  c << base_3D("a") << base_3D("b") << torsion_spring_3D("a", "b", 4.0)
    << torsion_spring_3D("a", "b", 4.0, 2.0, as<double>(quarter_turn_z));
  const auto r = record_of(c);
  CHECK(r.elements[2].parameters.size() == 2);
  CHECK(r.elements[3].parameters.size() == 3);
  CHECK(record_of(models::registered(r)) == r);
}

TEST_CASE("a torsion spring keeps NaN") {
  auto flat = trial_of(torsion_spring_2D("a", "b", 8.0, 3.0), 1);
  flat.at<1>().rotation.cos = not_a_number;
  flat.doForce();
  CHECK(std::isnan(flat.at<0>().torque));
  auto solid = trial_of(torsion_spring_3D("a", "b", 8.0, 3.0), 1);
  for (double* x : {&solid.at<1>().rotation.x.x, &solid.at<1>().rotation.z.y}) {
    const double before = *x;
    *x = not_a_number;
    solid.doForce();
    CHECK(std::isnan(solid.at<0>().torque.x));
    CHECK(std::isnan(solid.at<1>().torque.z));
    *x = before;
    solid.at<0>().torque = {}, solid.at<1>().torque = {};
  }
}

TEST_CASE("a rest angle has all digits") {
  CHECK(abs(torque(digits50(0), digits50(1), 1, zero, 0.75) - digits50(0.25)) <= 4 * eps<digits50>);
}

TEST_CASE("a torsion spring saturates") {
  const auto close = [](double x, double y) { return std::abs(x - y) <= 16 * eps<double>; };
  CHECK(close(torque(0.0, 1.0, 8.0, 3.0), 3.0));
  CHECK(close(torque(0.0, -1.0, 8.0, 3.0), -3.0));
  CHECK(close(torque(0.0, 0.25, 8.0, 3.0), 2.0));
  CHECK(close(torque(0.0, 1.0, 8.0, 0.0), 8.0));  // no saturation
  CHECK(close(torque(0.0, 1.0, 8.0, 3.0, 0.75), 2.0));
  const auto turn = matrix(vec3{0.5, 0.75, 1.5});  // by 1.75 rad
  CHECK(near(torque_of_turn(turn, 4.0, 3.5), vec3{1.0, 1.5, 3.0}, rounding<double>));
  CHECK(near(torque_of_turn(turn, 4.0, 8.0), vec3{2.0, 3.0, 6.0}, rounding<double>));
}

TEST_CASE("the energy of a torsion spring") {
  const auto close = [](double x, double y) { return std::abs(x - y) <= 16 * eps<double>; };
  const auto energy = [](const auto& spring, const vec3<>& turn) {
    return energy_of(spring)(frame_3D<>{}, frame_3D<>{.rotation = matrix(turn)});
  };
  CHECK(close(energy(torsion_spring_3D("a", "b", 4.0), {0.5, 0.75, 1.5}), 6.125));
  CHECK(close(energy(torsion_spring_3D("a", "b", 4.0, 2.0), {0.5, 0.75, 1.5}), 3.0));  // 2 Nm by 1.5 rad
  CHECK(energy(torsion_spring_3D("a", "b", 4.0, 2.0), {}) == 0.0);
  const auto planar = [](const auto& spring, double angle) {
    return energy_of(spring)(frame_2D<>{}, frame_2D<>{.rotation = rotation_by(angle)});
  };
  CHECK(close(planar(torsion_spring_2D("a", "b", 4.0, zero, 0.5), 2.0), 4.5));
  CHECK(close(planar(torsion_spring_2D("a", "b", 4.0, 2.0, 0.5), 2.25), 3.0));
}

TEST_CASE("a torsion spring in space keeps all digits at all angles") {
  check_all_angles<double>();
  check_all_angles<digits50>();
  for (const auto& turn : {as<double>(half_turn_x), as<double>(half_turn_y), as<double>(half_turn_z)}) {
    const auto t = detail::turn_of(turn);  // one of the two axes
    CHECK(sqrt(dot(t, t)) == pi<double>);
  }
  CHECK(detail::turn_of(half_turn_y) == detail::turn_of(as<double>(half_turn_y)));
  CHECK(detail::turn_of(matrix(no_rotation{})) == vec3<>{});
}

TEST_CASE("a torsion spring has derivatives, at rest too") {
  const auto slope = [](const auto& spring, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    frame_3D<sloped> a, b;
    b.rotation = as<sloped>(matrix(rotation_2D{sloped(c, -s), sloped(s, c)}));
    return nth<0>(spring.core.doForce(a, b)).torque.z.slope;
  };
  for (const double angle : {0.0, 1e-200, 1e-20, 1e-8, 1e-3, 1.0, 3.0, -3.0}) {
    CHECK(std::abs(slope(torsion_spring_3D("a", "b", 4.0), angle) - 4.0) <= 4 * rounding<double>);
    if (std::abs(angle) < 1)
      CHECK(std::abs(slope(torsion_spring_3D("a", "b", 4.0, 3.0), angle) - 4.0) <= 4 * rounding<double>);
    if (std::abs(angle) > 1)
      CHECK(std::abs(slope(torsion_spring_3D("a", "b", 4.0, 3.0), angle)) <= 4 * rounding<double>);
  }
}

TEST_CASE("a torsion spring wants finite numbers") {
  const std::string where = "kte: torsion_spring_2D (anchor1 'hip', anchor2 'knee'): ";
  const auto what = [](auto... numbers) {
    return complaint([&] { (void)torsion_spring_2D("hip", "knee", numbers...); });
  };
  CHECK(what(-1.0) == where + "stiffness must be finite and not negative, got -1");
  CHECK(what(not_a_number) == where + "stiffness must be finite and not negative, got nan");
  CHECK(what(1.0, -2.0) == where + "saturation must be finite and not negative, got -2");
  CHECK(what(1.0, zero, infinity) == where + "rest angle must be finite, got inf");
  CHECK(what(1, 0, -7) == "");
  CHECK(complaint([] { (void)torsion_spring_3D("hip", "knee", -1); }) ==
        "kte: torsion_spring_3D (anchor1 'hip', anchor2 'knee'): stiffness must be finite and not negative, got -1");
}

}  // namespace torsion_spring_test
