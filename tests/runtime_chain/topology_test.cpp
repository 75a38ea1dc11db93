#include <kte/dynamics.hpp>
#include <kte/elements/closures.hpp>
#include <kte/io/model_file.hpp>
#include <kte/io/recorder.hpp>
#include <kte/models/runtime_models.hpp>
#include <kte/runtime_chain/check_chain.hpp>
#include <kte/runtime_chain/from_record.hpp>
#include <kte/runtime_chain/topology.hpp>

#include "catch.hpp"
#include "chain/registered.hpp"

// Names of coordinates and signals, and names of frames, live apart: robots have joints and links of one name.

namespace topology_test {

using namespace kte;
using kte::test::says;

// clang-format off
inline constexpr struct elbow_  final : coord_key<"elbow">       {} elbow;
inline constexpr struct arm_    final : frame_3D_key<"elbow">    {} arm;    // a frame of the joint's name
inline constexpr struct body_   final : pose_3D_key<"body">      {} body;
inline constexpr struct trunk_  final : frame_3D_key<"body">     {} trunk;  // and of a pose's
inline constexpr struct tool_   final : frame_3D_key<"tool">     {} tool;
inline constexpr struct motor_  final : input_key<"tool">        {} motor;  // and of an input's
inline constexpr struct ground_ final : frame_3D_key<"ground">   {} ground;
// clang-format on

constexpr rigid_body brick{2.5, vec3{0.1, -0.2, 0.15}, sym3{0.3, 0.02, -0.03, 0.4, 0.05, 0.35}};

/// A mechanism with separate names, and with shared names.
template <class Elbow, class Arm, class Body, class Trunk, class Tool, class Motor, class Ground>
constexpr auto mechanism(const Elbow& q, const Arm& a, const Body& b, const Trunk& t, const Tool& x, const Motor& m,
                         const Ground& g) {
  return boost::hana::make_tuple(free_joint_3D(b, g, t), inertia_3D(t, brick), revolute_joint_3D(q, t, a, axis::y),
                                 inertia_3D(a, brick), rigid_link_3D(a, x, along_z(0.5)), driving_actuator_gen(q, m));
}
constexpr auto with_shared = boost::hana::unpack(mechanism(elbow, arm, body, trunk, tool, motor, ground),
                                                 [](const auto&... e) { return chain(e...).gravity(along_z(-9.81)); });
runtime_chain runtime(const std::string& q, const std::string& a, const std::string& b, const std::string& t,
                      const std::string& x, const std::string& m) {
  runtime_chain c;
  c.gravity(along_z(-9.81));
  boost::hana::for_each(mechanism(q, a, b, t, x, m, std::string("ground")), [&c](const auto& e) { c << e; });
  return c;
}
const runtime_chain of_texts = runtime("elbow", "elbow", "body", "body", "tool", "tool");
const std::array q{0.1, -0.2, 0.3, 0.5, 0.5, -0.5, 0.5, 0.7};
const std::array v{0.1, 0.2, -0.3, 0.4, 0.5, -0.6, 0.7}, a{1.0, 2.0, -3.0, 4.0, 5.0, -6.0, 7.0};

TEST_CASE("a joint and a link of one name are two things") {
  const auto apart = runtime("q", "arm", "X", "trunk", "tip", "u");
  const auto& together = of_texts;
  auto s = apart.make_state();
  auto t = together.make_state();
  s.input("u") = t.input("tool") = 2.5;
  CHECK(inverse_dynamics(apart, s, q, v, a) == inverse_dynamics(together, t, q, v, a));
  CHECK(forward_dynamics(apart, s, q, v, a) == forward_dynamics(together, t, q, v, a));
  CHECK(mass_matrix(apart, s) == mass_matrix(together, t));
  CHECK(jacobian(apart, s, "tip") == jacobian(together, t, "tool"));
  together.doMotion(t), apart.doMotion(s);
  CHECK(t.coordinate("elbow").q == 0.7);
  CHECK(t.frame_3D("elbow").position == s.frame_3D("arm").position);
  CHECK(t.pose_3D("body").position == t.frame_3D("body").position);
  CHECK(together.dofs() == 7);
  const std::vector<std::string_view> known{"elbow"};
  CHECK(hybrid_dynamics(together, t, q, v, a, known).a[6] == 7.0);
  const manipulator_kinematics_model poses(together, {"elbow", "body"});
  CHECK(poses.getDependentPoses(q)[1].position == vec3{0.1, -0.2, 0.3});
}

TEST_CASE("shared names in static chains, runtime chains and files") {
  auto s = of_texts.make_state();
  auto t = make_state(with_shared);
  s.input("tool") = t[motor] = 2.5;
  set_positions(t, q), set_velocities(t, v), set_accelerations(t, a);
  with_shared.doMotion(t), with_shared.clearForce(t), with_shared.doForce(t);
  set_positions(s, q), set_velocities(s, v), set_accelerations(s, a);
  of_texts.doMotion(s), of_texts.clearForce(s), of_texts.doForce(s);
  CHECK(s.coordinate("elbow").f == t[elbow].f);
  CHECK(s.frame_3D("elbow").position == t[arm].position);
  CHECK(s.frame_3D("body").force == t[trunk].force);
  CHECK(s.pose_3D("body").force == t[body].force);
  const auto r = record_of(with_shared);
  CHECK(r == record_of(of_texts));
  CHECK(from_json(to_json(r)) == r);
  CHECK(from_xml(to_xml(r)) == r);
  CHECK(record_of(models::registered(r)) == r);
  CHECK(record_of(from_record(with_shared, r)) == r);
  runtime_chain c;
  c << with_shared << revolute_joint_3D("wrist", "tool", "wrist");
  CHECK(record_of(c).elements.size() == 7);
  auto u = c.make_state();
  CHECK(inverse_dynamics(c, u, std::array{0.1, -0.2, 0.3, 0.5, 0.5, -0.5, 0.5, 0.7, 0.0},
                         std::array{0.1, 0.2, -0.3, 0.4, 0.5, -0.6, 0.7, 0.0},
                         std::array{1.0, 2.0, -3.0, 4.0, 5.0, -6.0, 7.0, 0.0})[7] == 0);
}

TEST_CASE("what is requested by a shared name") {
  const auto& c = of_texts;
  CHECK(c.frame("elbow").what() == kind::frame_3D);
  CHECK(c.coordinate("elbow").what() == kind::gen);
  CHECK(c.input("tool").what() == kind::input);
  CHECK(c.frame("tool").what() == kind::frame_3D);
  CHECK_THROWS_MATCHES(c.coordinate("tool"), unknown_name, says("kte: 'tool' is an input, not a coordinate"));
  CHECK_THROWS_MATCHES(c.coordinate("ground"), unknown_name, says("kte: 'ground' is a 3D frame, not a coordinate"));
  auto s = c.make_state();
  CHECK_THROWS_MATCHES(s.frame_2D("elbow"), unknown_name, says("kte: 'elbow' is a 3D frame, not a 2D frame"));
  CHECK_THROWS_MATCHES(s.rotation_3D("elbow"), unknown_name, says("kte: 'elbow' is a coordinate, not a rotation"));
  CHECK_THROWS_MATCHES(s.frame_3D("shoulder"), unknown_name,
                       says("kte: this chain has no 3D frame 'shoulder' (there are "
                            "'ground', 'body', 'elbow', 'tool')"));
  CHECK_THROWS_MATCHES(s.frame_3D("toll"), unknown_name, says("no 3D frame 'toll', did you mean 'tool'? (there are"));
  // Without a kind it must be one thing.
  const auto& t = c.wiring();
  CHECK(t.kind_of("ground") == kind::frame_3D);
  CHECK(t.kind_of("elbow", true) == kind::frame_3D);
  CHECK(t.kind_of("elbow", false) == kind::gen);
  CHECK_THROWS_MATCHES(t.kind_of("elbow"), unknown_name,
                       says("kte: 'elbow' is a coordinate and a 3D frame: which of them is meant?"));
  CHECK_THROWS_MATCHES(t.kind_of("shoulder"), unknown_name, says("kte: this chain has nothing named 'shoulder'"));
}

TEST_CASE("frames in the plane by shared names") {
  runtime_chain c;
  c << revolute_joint_2D("arm", "ground", "arm").at(along_x(0.5)) << inertia_2D("arm", point_mass(1.0, along_x(0.5)));
  auto s = c.make_state();
  CHECK(forward_kinematics(c, s, std::array{0.3}, "arm").position.x == 0.5);
  CHECK(jacobian(c, s, "arm")(5, 0) == 1.0);
  CHECK(c.frame("arm").what() == kind::frame_2D);
}

TEST_CASE("names of one family are still of one thing") {
  auto c = of_texts;
  const auto fails = [&c](const auto& e, const std::string& why) {
    CHECK_THROWS_MATCHES(c << e, bad_wiring, says(why));
  };
  fails(driving_actuator_gen("elbow", "elbow"), "'elbow' is a coordinate, not an input");
  fails(free_joint_3D("elbow", "tool", "x"), "'elbow' is a coordinate, not a 3D pose");
  fails(revolute_joint_2D("q", "elbow", "x"), "'elbow' is a 3D frame, not a 2D frame");
  fails(rigid_link_3D("tool", "elbow", along_x(1.0)), "it writes 'elbow', which is then written twice");
  fails(rigid_link_3D("tool", "ground", along_x(1.0)),
        "kte: free_joint_3D (coordinate 'body', base 'ground', end 'body'): it reads 'ground' before it is written, by "
        "rigid_link_3D (base 'tool', end 'ground'): append it behind that");
  fails(rigid_link_gen("q", "elbow", 1.0),
        "kte: revolute_joint_3D (coordinate 'elbow', base 'body', end 'elbow'): it reads 'elbow' before it is written");
  CHECK_NOTHROW(c << spring_gen("elbow", "ground", 0.0, 1.0));  // a coordinate of the base's name, which moves nothing
  CHECK_THROWS_MATCHES(c.make_state(), bad_wiring,
                       says("kte: spring_gen (anchor1 'elbow', anchor2 'ground'): nothing moves by 'ground': is it "
                            "misspelt?"));
}

TEST_CASE("shared names in recordings") {
  const auto columns = [](const auto& c, const std::vector<std::string>& names) {
    return recorder(c, names).contents().names;
  };
  using names = std::vector<std::string>;
  const auto check = [&](const auto& c) {
    CHECK(columns(c, {"elbow/position/x", "tool/velocity/z"}) ==
          names{"t", "frame:elbow/position/x", "frame:tool/velocity/z"});
    CHECK(columns(c, {"coordinate:elbow", "coordinate:elbow/v", "signal:tool", "ground/position/x"}) ==
          names{"t", "coordinate:elbow", "coordinate:elbow/v", "signal:tool", "ground/position/x"});
    CHECK(columns(c, {"frame:body/position/y", "coordinate:body/position/y"}) ==
          names{"t", "frame:body/position/y", "coordinate:body/position/y"});
    CHECK(columns(c, {"frame:ground/position/x"}) == names{"t", "ground/position/x"});
    const auto all = columns(c, {});
    CHECK(std::count(all.begin(), all.end(), "coordinate:body/position/x") == 1);
    CHECK(std::count(all.begin(), all.end(), "frame:body/position/x") == 1);
    CHECK_THROWS_MATCHES(columns(c, {"elbow"}), unknown_name,
                         says("kte: cannot record 'elbow', which is ambiguous: ask for 'coordinate:elbow' or "
                              "'frame:elbow'"));
    CHECK_THROWS_MATCHES(columns(c, {"body/velocity/x"}), unknown_name,
                         says("ask for 'frame:body/velocity/x' or 'coordinate:body/velocity/x'"));
    CHECK_THROWS_MATCHES(columns(c, {"elbow/colour"}), unknown_name,
                         says("kte: cannot record 'elbow/colour': the coordinate 'elbow' has "));
    CHECK_THROWS_MATCHES(columns(c, {"coordinate:ground"}), unknown_name, says("cannot record 'coordinate:ground'"));
  };
  check(with_shared);
  check(of_texts);
}

TEST_CASE("names that were misspelt are found by those that are there") {
  runtime_chain c;
  c << revolute_joint_3D("q1", "ground", "arm", axis::y) << inertia_3D("arm", brick);
  const auto fails = [](runtime_chain with, const auto& e, const std::string& why) {
    CHECK_THROWS_MATCHES((with << e, with.make_state()), bad_wiring, says("kte: " + why));
  };
  fails(c, joint_friction_gen("q_1", {.viscous = 1}),
        "joint_friction_gen (coordinate 'q_1'): nothing moves by 'q_1', did you mean 'q1'?");
  fails(c, position_measure_gen("q11", "y"),
        "position_measure_gen (coordinate 'q11', output 'y'): nothing moves by 'q11', did you mean 'q1'?");
  fails(c, inertia_3D("amr", brick),
        "inertia_3D (frame 'amr'): it reads 'amr', which no element before it writes, did you mean 'arm'? (there are "
        "'ground', 'arm'; a further base is declared by base_2D or base_3D)");
  // an inertia before its joint is taken for the base, and reported itself
  runtime_chain early;
  early << inertia_3D("arm", brick);
  fails(early, revolute_joint_3D("q", "ground", "arm", axis::y),
        "inertia_3D (frame 'arm'): it reads 'arm' before it is written, by revolute_joint_3D (coordinate 'q', base "
        "'ground', end 'arm'): append it behind that");
  CHECK(record_of(early).elements.size() == 1);
}

TEST_CASE("what is odd about a chain is found, and may be meant") {
  runtime_chain c;
  c << revolute_joint_3D("q1", "ground", "arm", axis::y) << inertia_3D("arm", brick) << inertia_gen("q1", 0.1)
    << inertia_gen("mass", 1.0) << base_gen("wall") << spring_gen("wall", "mass", 0.0, 1.0);
  CHECK(check_chain(c).empty());
  c << inertia_gen("q_1", 0.1) << joint_damping_gen("q_1", 1.0) << inertia_gen("alone", 0.1)
    << prismatic_joint_3D("q1", "arm", "tool", axis::x);
  CHECK(check_chain(c) ==
        std::vector<std::string>{
            "'q1' moves 2 joints: revolute_joint_3D (coordinate 'q1', base 'ground', end 'arm'), prismatic_joint_3D "
            "(coordinate 'q1', base 'arm', end 'tool')",
            "inertia_gen (coordinate 'q_1') is moved by a separate degree of freedom, 'q_1', by which no joint moves, "
            "did you "
            "mean 'q1'?",
            "inertia_gen (coordinate 'alone') is moved by a separate degree of freedom, 'alone', by which no joint "
            "moves"});
  CHECK(check_chain(with_shared).empty());
}

TEST_CASE("misspelt coordinates of followers are found") {
  runtime_chain c;
  c << mimic_gen("hub", "left", 1.0) << mimic_gen("hub", "right", -1.0)
    << revolute_joint_3D("left", "ground", "a", axis::y) << revolute_joint_3D("right", "ground", "b", axis::y)
    << revolute_joint_3D("crank", "ground", "arm", axis::y);
  CHECK(check_chain(c).empty());
  c << mimic_gen("cranck", "rocker", 2.0) << revolute_joint_3D("rocker", "ground", "r", axis::y)
    << mimic_gen("crank", "cuopler", -1.0) << revolute_joint_3D("coupler", "arm", "k", axis::y);
  CHECK(check_chain(c) ==
        std::vector<std::string>{
            "mimic_gen (base 'cranck', end 'rocker') follows a separate degree of freedom, 'cranck', by which no joint "
            "moves, did you mean 'crank'?",
            "mimic_gen (base 'crank', end 'cuopler') writes 'cuopler', which nothing reads, did you mean 'coupler'?"});
}

TEST_CASE("a misspelt frame is found where the base of the chain is declared") {
  const auto found = [](const auto& e) {
    runtime_chain c;
    c << base_2D("g") << revolute_joint_2D("q", "g", "tip") << inertia_2D("tip", point_mass(1.0)) << e;
    (void)c.make_state();
    return check_chain(c);
  };
  using list = std::vector<std::string>;
  CHECK(found(spring_2D("g", "tipp", 0.1, 10.0)) ==
        list{"spring_2D (anchor1 'g', anchor2 'tipp') reads 'tipp', which no element writes or declares: it is a "
             "further base, did you mean 'tip'?"});
  CHECK(found(revolute_joint_2D("p", "tipp", "hand")) ==
        list{"revolute_joint_2D (coordinate 'p', base 'tipp', end 'hand') reads 'tipp', which no element writes or "
             "declares: it is a further base, did you mean 'tip'?"});
  CHECK(found(spring_2D("tip", "wall", 0.1, 10.0)) ==
        list{"spring_2D (anchor1 'tip', anchor2 'wall') reads 'wall', which no element writes or declares: it is a "
             "further base (if it is meant, base_2D declares it)"});
  CHECK(found(revolute_joint_2D("p", "wall", "hand")).empty());  // a joint stands on it
  CHECK(found(spring_2D("g", "tip", 0.1, 10.0)).empty());

  runtime_chain numbered;  // the frame that is similar comes later
  numbered << revolute_joint_2D("q", "link0", "link1") << base_2D("wall") << spring_2D("wall", "link1", 0.1, 10.0);
  CHECK(check_chain(numbered).empty());
}

TEST_CASE("names of a closure in another order are found") {
  runtime_chain c;
  c << base_3D("g") << revolute_joint_3D("q", "g", "pin one", axis::y)
    << revolute_joint_3D("p", "g", "pin two", axis::y) << coincident_points_3D("pin one", "pin two", "pin");
  CHECK(check_chain(c) ==
        std::vector<std::string>{
            "coincident_points_3D (frame1 'pin two', frame2 'pin', loop 'pin one') reads 'pin', which no element "
            "writes or declares: it is a further base, and 'pin one' is a frame: are the names in another order?"});
}

TEST_CASE("names of many findings are not all compared with all others") {
  runtime_chain c;
  c << revolute_joint_2D("q", "base", "arm");
  for (int i = 0; i < 300; ++i) c << inertia_gen("w" + std::to_string(i), 1.0);
  const auto found = check_chain(c);
  REQUIRE(found.size() == 301);
  CHECK(found[299] ==
        "inertia_gen (coordinate 'w299') is moved by a separate degree of freedom, 'w299', by which no joint moves");
  CHECK(found[300] ==
        "the names of 100 further coordinates are not compared with those of joints, which takes too long: they may be "
        "misspelt");
}

}  // namespace topology_test
