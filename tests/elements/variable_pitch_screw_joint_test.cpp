#include <kte/elements/law_follower.hpp>
#include <kte/elements/variable_pitch_screw_joint.hpp>
#include <kte/io/model_file.hpp>
#include <kte/runtime_chain/from_record.hpp>

#include "elements/laws.hpp"
#include "elements/mechanism_results.hpp"

namespace variable_pitch_screw_joint_test {

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
  check(variable_pitch_screw_joint_3D("q", "base", "end", axis::x, S(1) / 3, S(-1) / 5));
  check(variable_pitch_screw_joint_3D("q", "base", "end", vec3{S(2) / 7, S(3) / 7, S(6) / 7}, S(2) / 3, S(1) / 2));
}
template <class Axis>
auto arm(const Axis& n, double pitch, double change) {
  return chain(variable_pitch_screw_joint_3D(q, ground, nut, n, pitch, change).at(vec3{0.2, 0.1, -0.3}, quarter_turn_x),
               inertia_gen(q, 0.05), inertia_3D(nut, brick), revolute_joint_3D(p, nut, hand, axis::y),
               inertia_3D(hand, brick))
      .gravity(weight);
}
/// A turning joint, and a sliding one whose coordinate follows.
runtime_chain following_arm(const vec3<>& n, double pitch, double change) {
  runtime_chain c;
  c.gravity(weight) << revolute_joint_3D("q", "ground", "turned", n).at(vec3{0.2, 0.1, -0.3}, quarter_turn_x)
                    << law_follower_gen([=](const auto& x) { return (pitch + change / 2 * x) * x; }, "q", "s")
                    << prismatic_joint_3D("s", "turned", "nut", n) << inertia_gen("q", 0.05) << inertia_3D("nut", brick)
                    << revolute_joint_3D("p", "nut", "hand", axis::y) << inertia_3D("hand", brick);
  return c;
}

TEST_CASE("screw joints of variable pitch obey the laws") {
  check_laws<double>();
  check_laws<digits50>();
}

TEST_CASE("a screw joint of variable pitch is a turning and a sliding joint that follows") {
  unsigned seed = 0;
  const auto check = [&](const auto& n, double pitch, double change) {
    const auto screw = arm(n, pitch, change);
    const auto runtime = models::registered(record_of(screw));
    CHECK(difference(screw, runtime, hand, ++seed) < few_ulps);
    CHECK(difference(runtime, following_arm(as<double>(n), pitch, change), hand, seed) < few_ulps);
  };
  check(axis::z, 0.25, 0.1);
  check(vec3{2.0 / 3, -1.0 / 3, 2.0 / 3}, -0.7, 0.4);
  check(axis::x, 0.0, -0.3);
}

TEST_CASE("without a change of pitch it is a screw joint") {
  runtime_chain screw;
  screw.gravity(weight) << screw_joint_3D("q", "ground", "nut", axis::z, 0.25) << inertia_3D("nut", brick);
  runtime_chain same;
  same.gravity(weight) << variable_pitch_screw_joint_3D("q", "ground", "nut", axis::z, 0.25, 0.0)
                       << inertia_3D("nut", brick);
  CHECK(difference(same, screw, nut, 7) < few_ulps);
}

TEST_CASE("a nut on a screw of variable pitch goes on as its energy says") {
  // (I + m d'^2) q'^2 / 2 + m g d is constant: at q'' = -(m d' k q'^2 + m g d') / (I + m d'^2).
  const double m = 2.0, inertia = 0.5, h = 0.3, k = -0.2, g = 8.0;
  const auto c = chain(variable_pitch_screw_joint_3D(q, ground, nut, axis::z, h, k),
                       inertia_3D(nut, rigid_body{m, along_z(0.1), diagonal(inertia, inertia, inertia)}))
                     .gravity(along_z(-g));
  const auto runtime = models::registered(record_of(c));
  auto s = runtime.make_state();
  for (const double angle : {0.0, 0.7, 1.5, -40.0}) {  // at 1.5 the pitch is nothing
    INFO(angle);
    const double rate = 0.9, d = h + k * angle;
    const double a = -(m * d * k * rate * rate + m * g * d) / (inertia + m * d * d);
    CHECK(forward_dynamics(c, std::array{angle}, std::array{rate}, std::array{0.0})[0] == within(a, few_ulps * 20));
    CHECK(forward_dynamics(runtime, s, std::array{angle}, std::array{rate}, std::array{0.0})[0] ==
          within(a, few_ulps * 20));
  }
}

TEST_CASE("screw joints of variable pitch in files") {
  const auto check = [](const auto& c) {
    const auto r = record_of(c);
    CHECK(from_json(to_json(r)) == r);
    CHECK(from_xml(to_xml(r)) == r);
    CHECK(record_of(models::registered(r)) == r);
    CHECK(record_of(from_record(c, r)) == r);
    CHECK(r.elements[0].type == "variable_pitch_screw_joint_3D");
    CHECK(r.elements[0].parameters[2].name == "pitch_change");
  };
  check(chain(variable_pitch_screw_joint_3D(q, ground, nut, axis::x, 0.25, 0.5)));
  check(chain(variable_pitch_screw_joint_3D(q, ground, nut, vec3{0.6, 0.0, 0.8}, 0.25, 0.5)));
  check(chain(variable_pitch_screw_joint_3D(q, ground, nut, axis::y, 0.25, 0.5).at(along_z(0.5), quarter_turn_x)));
}

TEST_CASE("states in other scalars refuse a joint with varying axes by name") {
  runtime_chain c;
  c << variable_pitch_screw_joint_3D("q", "ground", "nut", axis::z, 0.25, 0.5) << inertia_3D("nut", brick);
  CHECK(complaint([&] { (void)c.make_state<float>(); }) ==
        "kte: states of runtime chains in scalars other than double and packs support joints, links and bodies "
        "only; "
        "variable_pitch_screw_joint_3D (coordinate 'q', base 'ground', end 'nut') has axes that depend on its "
        "coordinates");
}

TEST_CASE("a screw joint of variable pitch wants an axis of length 1 and finite numbers") {
  const auto what = [](const vec3<>& n, double pitch, double change) {
    return complaint([&] { (void)variable_pitch_screw_joint_3D("turn", "bolt", "nut", n, pitch, change); });
  };
  const std::string where = "kte: variable_pitch_screw_joint_3D (coordinate 'turn', base 'bolt', end 'nut'): ";
  CHECK(what({0, 0, 2}, 0.1, 0.1) == where + "axis must have length 1, got 2");
  CHECK(what({0, 0, 1}, infinity, 0.1) == where + "pitch must be finite, got inf");
  CHECK(what({0, 0, 1}, 0.1, not_a_number) == where + "pitch_change must be finite, got nan");
  CHECK(what({0, 0, 1}, -0.1, 0.1) == "");
}

}  // namespace variable_pitch_screw_joint_test
