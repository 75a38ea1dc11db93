#include <kte/elements/screw_joint.hpp>
#include <kte/io/model_file.hpp>
#include <kte/runtime_chain/from_record.hpp>

#include "chain/gear.hpp"
#include "elements/laws.hpp"
#include "elements/mechanism_results.hpp"

namespace screw_joint_test {

using namespace kte;
using namespace kte::test;

// clang-format off
inline constexpr struct q_      final : coord_key<"q">         {} q;
inline constexpr struct p_      final : coord_key<"p">         {} p;
inline constexpr struct ground_ final : frame_3D_key<"ground"> {} ground;
inline constexpr struct nut_    final : frame_3D_key<"nut">    {} nut;
inline constexpr struct hand_   final : frame_3D_key<"hand">   {} hand;
// clang-format on

constexpr rigid_body brick{2.5, vec3{0.1, -0.2, 0.15}, sym3{0.3, 0.02, -0.03, 0.4, 0.05, 0.35}};
constexpr vec3 weight{0.5, -1.5, -9.81};
/// Sums of some hundred products along two bodies, relative to the largest.
constexpr double few_ulps = 1e-14;

template <class S>
void check_laws() {
  random_numbers draw(1);
  const auto check = [&](const auto& joint) {
    CHECK(testing::motion_is_derivative<S>(joint, draw) <= by_differences<S>);
    CHECK(testing::power_is_kept<S>(joint, draw) <= rounding<S>);
  };
  check(screw_joint_3D("q", "base", "end", axis::x, S(1) / 3));
  check(screw_joint_3D("q", "base", "end", axis::minus_z, S(-1) / 7));
  check(screw_joint_3D("q", "base", "end", vec3{S(2) / 7, S(3) / 7, S(6) / 7}, S(2) / 3));
  check(screw_joint_3D("q", "base", "end", axis::y, zero));
}
template <class Axis>
auto arm(const Axis& n, double pitch) {
  return chain(screw_joint_3D(q, ground, nut, n, pitch), inertia_3D(nut, brick),
               revolute_joint_3D(p, nut, hand, axis::y), inertia_3D(hand, brick))
      .gravity(weight);
}
/// A turning joint, and a sliding one whose coordinate follows.
runtime_chain geared_arm(const vec3<>& n, double pitch) {
  runtime_chain c;
  c.gravity(weight) << revolute_joint_3D("q", "ground", "turned", n) << connect(gear{pitch}, "q", "s")
                    << prismatic_joint_3D("s", "turned", "nut", n) << inertia_3D("nut", brick)
                    << revolute_joint_3D("p", "nut", "hand", axis::y) << inertia_3D("hand", brick);
  return c;
}

TEST_CASE("screw joints obey the laws") {
  check_laws<double>();
  check_laws<digits50>();
}

TEST_CASE("a screw joint is a turning and a sliding joint that follows") {
  unsigned seed = 0;
  const auto check = [&](const auto& n, double pitch) {
    const auto screw = arm(n, pitch);
    const auto runtime = models::registered(record_of(screw));
    CHECK(difference(screw, runtime, hand, ++seed) < few_ulps);
    CHECK(difference(runtime, geared_arm(as<double>(n), pitch), hand, seed) < few_ulps);
  };
  check(axis::z, 0.25);
  check(vec3{2.0 / 3, -1.0 / 3, 2.0 / 3}, -0.7);
}

TEST_CASE("a turn of a screw") {
  auto x = trial_of(screw_joint_3D("q", "base", "end", axis::x, 0.25), 1);
  x.at<1>() = {};
  x.at<0>() = {.q = 2.0, .q_dot = 3.0, .q_ddot = -4.0};
  x.doMotion();
  CHECK(x.output().position == vec3{0.5, 0.0, 0.0});
  CHECK(x.output().velocity == vec3{0.75, 0.0, 0.0});
  CHECK(x.output().ang_velocity == vec3{3.0, 0.0, 0.0});
  CHECK(x.output().acceleration == vec3{-1.0, 0.0, 0.0});
  CHECK(x.output().ang_acceleration == vec3{-4.0, 0.0, 0.0});
  CHECK(x.output().rotation.y.y == within(std::cos(2.0), 2e-16));
  x.output().force = {8.0, 1.0, 2.0}, x.output().torque = {5.0, 3.0, 4.0};
  x.doForce();
  CHECK(x.at<0>().f == 8.0 * 0.25 + 5.0);  // h F + T along the axis
}

TEST_CASE("screws of tiny, huge, no and negative pitch") {
  // A body of mass m and moment I about the axis, which goes through its centre: a = (u - m g h) / (I + m h^2).
  const auto check = [](double pitch, double inertia) {
    const auto c = chain(screw_joint_3D(q, ground, nut, axis::z, pitch),
                         inertia_3D(nut, rigid_body{2.0, along_z(inertia), diagonal(inertia, inertia, inertia)}))
                       .gravity(along_z(-8.0));
    const auto runtime = models::registered(record_of(c));
    auto s = runtime.make_state();
    const double mass = inertia + 2.0 * pitch * pitch;
    for (const double angle : {0.0, 0.7, 1e6}) {
      INFO(pitch << ' ' << inertia << ' ' << angle);
      const std::array at{angle}, v{0.5}, u{3.0};
      CHECK(mass_matrix(c, at)(0, 0) == within_relative(mass, few_ulps));
      CHECK(mass_matrix(runtime, s, at)(0, 0) == within_relative(mass, few_ulps));
      const double a = (3.0 - 16.0 * pitch) / mass;
      CHECK(forward_dynamics(c, at, v, u)[0] == within_relative(a, few_ulps));
      CHECK(forward_dynamics(runtime, s, at, v, u)[0] == within_relative(a, few_ulps));
      const double tau = mass * 1.5 + 16.0 * pitch;
      CHECK(inverse_dynamics(c, at, v, std::array{1.5})[0] == within_relative(tau, few_ulps));
      CHECK(inverse_dynamics(runtime, s, at, v, std::array{1.5})[0] == within_relative(tau, few_ulps));
      CHECK(forward_kinematics(c, at, nut).position.z == pitch * angle);
      CHECK(forward_kinematics(runtime, s, "nut").position.z == pitch * angle);
    }
  };
  for (const double inertia : {0.5, 0.0})
    for (const double pitch : {1e-100, 1e-9, -1e-3, 1e3, -1e9, 1e100}) check(pitch, inertia);
  check(0.0, 0.5);
  check(1e-300, 0.5);
  // A point on the axis that the tiniest pitch alone lets go, and far from the frame: next to what rounding leaves.
  const auto c = chain(screw_joint_3D(q, ground, nut, axis::z, 1e-9), inertia_3D(nut, point_mass(2.0, along_z(0.3))));
  CHECK_THROWS_AS(forward_dynamics(c, std::array{0.0}, std::array{0.5}, std::array{3.0}), singular_mass_matrix);
}

TEST_CASE("screw joints in files") {
  const auto check = [](const auto& c) {
    const auto r = record_of(c);
    CHECK(from_json(to_json(r)) == r);
    CHECK(from_xml(to_xml(r)) == r);
    CHECK(record_of(models::registered(r)) == r);
    CHECK(record_of(from_record(c, r)) == r);
    CHECK(r.elements[0].type == "screw_joint_3D");
    CHECK(r.elements[0].parameters[1].name == "pitch");
    CHECK(r.elements[0].parameters[1].values == std::vector{0.25});
  };
  check(chain(screw_joint_3D(q, ground, nut, axis::x, 0.25)));
  check(chain(screw_joint_3D(q, ground, nut, vec3{0.6, 0.0, 0.8}, 0.25)));
  check(chain(screw_joint_3D(q, ground, nut, axis::y, 0.25).at(along_z(0.5), quarter_turn_x)));
}

TEST_CASE("a screw joint keeps NaN") {
  auto x = trial_of(screw_joint_3D("q", "base", "end", axis::z, 0.25), 3);
  x.at<0>().q = not_a_number;
  x.doMotion();
  CHECK(std::isnan(x.output().rotation.x.x));
  CHECK(std::isnan(x.output().position.z));
}

TEST_CASE("a screw joint wants an axis of length 1 and a finite pitch") {
  const auto what = [](const vec3<>& n, double pitch) {
    return complaint([&] { (void)screw_joint_3D("turn", "bolt", "nut", n, pitch); });
  };
  const std::string where = "kte: screw_joint_3D (coordinate 'turn', base 'bolt', end 'nut'): ";
  CHECK(what({0, 0, 2}, 0.1) == where + "axis must have length 1, got 2");
  CHECK(what({0, not_a_number, 1}, 0.1) == where + "axis must have length 1, got nan");
  CHECK(what({0, 0, 1}, infinity) == where + "pitch must be finite, got inf");
  CHECK(what({0, 0, 1}, not_a_number) == where + "pitch must be finite, got nan");
  CHECK(what({0, 0, 1}, -0.1) == "");
}

}  // namespace screw_joint_test
