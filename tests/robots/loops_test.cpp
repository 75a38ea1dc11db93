#include <kte/dynamics/frame_motion.hpp>
#include <kte/loops.hpp>
#include <kte/robots/check_robot.hpp>
#include <kte/robots/describe.hpp>
#include <kte/robots/load_robot.hpp>
#include <kte/robots/mjcf_writer.hpp>
#include <kte/robots/urdf_writer.hpp>

#include "catch.hpp"
#include "robots/files.hpp"
#include "robots/mjcf_texts.hpp"
#include "robots/sdf_texts.hpp"

// Closed loops of robots from files.

namespace loops_test {

using namespace kte;
using kte::test::robot_file, kte::test::within, kte::test::says;
using closing = robot_closure::kind;

TEST_CASE("a four-bar is the same mechanism in URDF, MJCF and SDF") {
  const Eigen::Vector3d q = Eigen::Vector3d::Zero(), guess(2, 0, 0), tau(0.3, 0, 0);
  Eigen::VectorXd expected;
  for (const char* file : {"four_bar.urdf", "four_bar.xml", "four_bar.sdf"}) {
    INFO(file);
    const auto r = load_robot(robot_file(file), {.gravity = vec3<>{0, 0, -9.8}});
    CHECK(r.loops == std::vector<std::string>{"pin"});
    auto s = make_state(r.chain);
    const auto report = loops(r.chain, s, q);
    CHECK((report.rank == 2 && report.mobility == 1 && report.gap < 1e-15));
    CHECK(static_cast<int>(report.dependent.size()) == report.rows - 2);
    const Eigen::VectorXd v = consistent_velocities(r.chain, s, q, guess);
    const auto at = constrained_dynamics(r.chain, s, q, v, tau);
    // the rates of a four-bar with its crank and rocker upright: 0.4 w1 = 0.8 w3, and the coupler does not turn
    CHECK(v[2] == within(v[0] / 2, 1e-14));
    CHECK(v[1] == within(-v[0], 1e-14));
    if (expected.size() == 0) expected = at.a;
    CHECK((at.a - expected).cwiseAbs().maxCoeff() < 1e-12);
  }
}

using namespace kte::test::mjcf_texts;

/// Two links on turns about y at (0, 0, 0) and (1, 0, 0), and a loop between them.
robot_description two_arms(const std::string& loop) {
  const std::string turn = "<axis xyz='0 1 0'/><origin xyz='";
  return from_urdf(test::urdf("<link name='g'/>" + test::heavy("a") + test::heavy("b") +
                              test::joint_text("qa", "continuous", "g", "a", turn + "0 0 0'/>") +
                              test::joint_text("qb", "continuous", "g", "b", turn + "1 0 0'/>") + loop));
}
std::string loop_text(const std::string& type, const std::string& more) {
  return "<kte:loop name='l' type='" + type + "'" + more;
}
std::string between(const std::string& rest = "") {
  return "><link1 link='a' xyz='0 0 1'/><link2 link='b' xyz='0 0 1'/>" + rest + "</kte:loop>";
}
/// The type of the last element of the chain.
std::string last_type(const robot& r) { return record_of(r.chain).elements.back().type; }

std::string arms(const std::string& equality, const std::string& rest = "", const std::string& sites = "") {
  return mjcf("<body name='a'><joint name='qa' axis='0 1 0' ref='10'/>" + heavy + sites +
                  "</body><body name='b' pos='1 0 0'><joint name='qb' axis='0 1 0'/>" + heavy +
                  "<site name='tip' pos='0 0 1'/></body>" +
                  "<body name='c' pos='2 0 0'><joint name='qc' type='slide' axis='0 0 1'/>" + heavy + "</body>",
              "<equality>" + equality + "</equality>" + rest);
}

TEST_CASE("<kte:loop> in a URDF closes loops by every closure") {
  const auto is = [](const std::string& type, const std::string& more, const std::string& element) {
    const auto d = two_arms(loop_text(type, more));
    REQUIRE(d.closures.size() == 1);
    const auto r = to_robot(d);
    INFO(type);
    CHECK(last_type(r) == element);
    CHECK((r.loops == std::vector<std::string>{"l"} && r.warnings.empty()));
    // and back
    std::vector<robot_note> notes;
    const auto again = to_robot(from_urdf(to_urdf(r, {.not_written = &notes})));
    CHECK(record_of(again.chain).elements == record_of(r.chain).elements);
    CHECK((notes.size() == 1 && notes[0].text.find("<kte:loop>, which other readers") != std::string::npos));
  };
  const std::string y = "<axis xyz='0 1 0'/>";
  is("hinge", between(y), "hinge_3D"), is("revolute", between(y), "hinge_3D");
  is("ball", between(), "coincident_points_3D"), is("fixed", between(), "coincident_frames_3D");
  is("universal", between(y + "<axis2 xyz='0 0 1'/>"), "universal_3D");
  is("cylindrical", between(y), "cylindrical_3D"), is("sliding", between(y), "sliding_3D");
  is("line", between(y), "point_on_line_3D"), is("plane", between(y), "point_on_plane_3D");
  is("distance", " length='1.5'" + between(), "distance_3D");
  is("joints", " polynomial='0.5 -2'><joint1 joint='qa'/><joint2 joint='qb'/></kte:loop>", "coupled_by_polynomial");

  const auto refused = [](const std::string& loop, const std::string& why) {
    CHECK_THROWS_MATCHES(to_robot(two_arms(loop)), bad_file, says(why));
  };
  refused(loop_text("hook", between()), "loop 'l': type 'hook' is none of hinge, revolute,");
  refused(loop_text("hinge", "><link1 link='a'/></kte:loop>"), "kte:loop 'l': has no <link2>");
  refused(loop_text("ball", "><link1 link='a'/><link2 link='z'/></kte:loop>"), "closure 'l': 'z' is not a link");
  refused(loop_text("ball", "><link1 link='a'/><link2 link='a'/></kte:loop>"), "both its ends are the same link 'a'");
  refused(loop_text("distance", " length='0'" + between()), "length must be greater than 0, got 0");
  refused(loop_text("joints", " polynomial='1 2 3 4 5 6'><joint1 joint='qa'/><joint2 joint='qb'/></kte:loop>"),
          "polynomial has at most five numbers, got 6");
  refused(loop_text("ball", between()) + loop_text("ball", between()), "closure 'l': it comes a second time");
  const auto open = to_robot(two_arms(loop_text("ball", between())), {.closures = false});
  CHECK((open.loops.empty() && open.warnings.size() == 1 && open.warnings[0].changes_motion));
}

TEST_CASE("<connect> and <weld> of MJCF hold where the file puts the bodies") {
  const auto reference = [](const robot& r) {
    REQUIRE(!r.configurations.empty());
    CHECK(r.configurations[0].name == "reference");
    return r.configurations[0].q;
  };
  for (const std::string e : {"<connect body1='a' body2='b' anchor='0 0 1'/>", "<connect body1='b' anchor='0 0 1'/>",
                              "<weld body1='a' body2='b'/>", "<weld body1='b' body2='c' relpose='1 0 0 1 0 0 0'/>",
                              "<weld body1='a' body2='b' relpose='5 5 5 0 0 0 0' anchor='0 0 1'/>"}) {
    INFO(e);
    const auto r = robot_of(arms(e));
    CHECK(r.warnings.empty());
    auto s = make_state(r.chain);
    CHECK(loops(r.chain, s, reference(r)).gap < 1e-15);
    CHECK(loops(r.chain, s, reference(r)).rows == (e.starts_with("<weld") ? 6 : 3));
  }
  const auto by_sites =
      robot_of(arms("<connect name='k' site1='top' site2='tip'/>", "", "<site name='top' pos='1 0 1'/>"));
  auto s = make_state(by_sites.chain);
  CHECK(loops(by_sites.chain, s, reference(by_sites)).gap < 1e-15);
  CHECK(by_sites.loops == std::vector<std::string>{"k"});

  const auto soft =
      robot_of(arms("<connect name='k' body1='a' body2='b' anchor='0 0 1' solref='1 1' solimp='0 1 1'/>"));
  CHECK(texts(soft.warnings) == "connect 'k': its solref, solimp not read: the constraint is exact here, not soft\n");
  CHECK(robot_of(arms("<connect body1='a' body2='b' anchor='0 0 1' active='false'/>")).loops.empty());
  // a free body stands where the file puts it
  const auto free = robot_of(mjcf("<body name='a' pos='1 2 3'><freejoint name='f'/>" + heavy + "</body>",
                                  "<equality><connect body1='a' anchor='0 0 1'/></equality>"));
  auto t = make_state(free.chain);
  CHECK(loops(free.chain, t, reference(free)).gap < 1e-15);
  const auto refused = [](const std::string& e, const std::string& why) {
    CHECK_THROWS_MATCHES(robot_of(arms(e)), bad_file, says(why));
  };
  refused("<connect anchor='0 0 1'/>", "<connect>: has no body1");
  refused("<connect body1='z' anchor='0 0 1'/>", "body1 'z' is not a body");
  refused("<connect body1='a' body2='a' anchor='0 0 1'/>", "body1 and body2 are the same body 'a'");
  refused("<connect site1='tip' site2='z'/>", "site2 'z' is not a site");
  refused("<joint joint1='qa' joint2='qz'/>", "joint2 'qz' is not a hinge or slide");
  refused("<joint joint1='qa' joint2='qa'/>", "joint1 and joint2 are the same joint 'qa'");
  refused("<joint joint1='qa' joint2='qb' polycoef='1 2 3 4 5 6'/>", "polycoef has at most five numbers, got 6");
}

TEST_CASE("<joint> of MJCF couples joints by polynomials, about the reference of each") {
  const double ref = 10 * std::numbers::pi / 180;
  const auto motion = [](const robot& r, double x, const std::string& free) {  // qa, of the free coordinate
    auto s = make_state(r.chain);
    s.coordinate(free).q = x;
    Eigen::VectorXd q = neutral_configuration(r.chain);
    for (const auto& e : layout(r.chain))
      if (e.name == free) q[e.q] = x;
    if (!r.loops.empty()) q = assemble(r.chain, s, q, held(free));
    set_positions(s, q), r.chain.doMotion(s);
    return std::pair{s.coordinate("qa").q, s.coordinate("qb").q};
  };
  // linear ones follow, and all algorithms know them
  auto r = robot_of(arms("<joint joint1='qa' joint2='qb' polycoef='0.5 -2 0 0 0'/>"));
  CHECK((r.loops.empty() && r.chain.dofs() == 2));
  CHECK(motion(r, 0.3, "qb").first == within(ref + 0.5 - 2 * 0.3, 1e-15));
  // the joint with an actuator leads
  r = robot_of(arms("<joint joint1='qa' joint2='qb' polycoef='0.5 -2'/>", "<actuator><motor joint='qa'/></actuator>"));
  CHECK((r.loops.empty() && r.chain.dofs() == 2));
  CHECK(motion(r, 0.3, "qa").second == within((0.3 - ref - 0.5) / -2, 1e-15));
  // two of them: a closure
  r = robot_of(arms("<joint name='k' joint1='qa' joint2='qb' polycoef='0.5 -2'/>",
                    "<actuator><motor joint='qa'/><motor joint='qb'/></actuator>"));
  CHECK((r.loops == std::vector<std::string>{"k"} && r.chain.dofs() == 3));
  CHECK(motion(r, 0.3, "qb").first == within(ref + 0.5 - 2 * 0.3, 1e-14));
  r = robot_of(arms("<joint name='k' joint1='qb' joint2='qa' polycoef='0.1 1 -0.5 0.25 0.125'/>"));
  CHECK(r.loops.size() == 1);
  const double y = 0.7 - ref;
  CHECK(motion(r, 0.7, "qa").second == within(0.1 + y - y * y / 2 + y * y * y / 4 + y * y * y * y / 8, 1e-14));
  // one joint alone stays where it is
  r = robot_of(arms("<joint joint1='qb' polycoef='0.5'/>"));
  CHECK((r.loops.empty() && r.chain.dofs() == 2));
  auto s = make_state(r.chain);
  const auto at = forward_kinematics(r.chain, s, Eigen::VectorXd(Eigen::Vector2d(ref, 0)), "tip");
  CHECK(at.position.x == within(1 + std::sin(0.5), 1e-15));
  // through a follower
  r = robot_of(
      arms("<joint joint1='qa' joint2='qc' polycoef='0 3'/><joint joint1='qa' joint2='qb' polycoef='0 1 1'/>"));
  CHECK((r.loops.size() == 1 && r.chain.dofs() == 2));
  CHECK(motion(r, 0.2, "qb").first == within(ref + 0.2 + 0.04, 1e-14));
}

TEST_CASE("joints of SDF that close a loop become closures of their kind") {
  using namespace kte::test;
  const auto closed_by = [](const std::string& type, const std::string& rest = "<axis/>") {
    const auto d = from_sdf(model(link_text("a") + link_text("b", "<pose>1 0 0 0 0 0</pose>") + link_text("c") +
                                  joint("j", "revolute", "world", "a") + joint("k", "revolute", "a", "b") +
                                  joint("l", "revolute", "b", "c") + joint("m", type, "a", "c", rest)));
    REQUIRE(d.closures.size() == 1);
    CHECK((d.joints.size() == 3 && d.closures[0].name == "m"));
    CHECK((d.closures[0].link1 == "a" && d.closures[0].link2 == "c"));
    auto r = to_robot(d);
    auto s = make_state(r.chain);
    CHECK(loops(r.chain, s, neutral_configuration(r.chain)).gap < 1e-15);
    return last_type(r);
  };
  CHECK(closed_by("revolute") == "hinge_3D");
  CHECK(closed_by("continuous") == "hinge_3D");
  CHECK(closed_by("ball") == "coincident_points_3D");
  CHECK(closed_by("fixed") == "coincident_frames_3D");
  CHECK(closed_by("prismatic") == "sliding_3D");
  CHECK(closed_by("universal", "<axis><xyz>1 0 0</xyz></axis><axis2><xyz>0 1 0</xyz></axis2>") == "universal_3D");

  // what has forces stays a joint
  const auto sprung = from_sdf(
      model(link_text("a") + link_text("b") + joint("j", "revolute", "world", "a") + joint("k", "revolute", "a", "b") +
            joint("l", "revolute", "world", "b", "<axis><dynamics><damping>1</damping></dynamics></axis>")));
  CHECK((sprung.closures.size() == 1 && sprung.closures[0].name == "k"));
  CHECK_THROWS_MATCHES(
      from_sdf(model(link_text("a") + joint("j", "screw", "world", "a") + joint("k", "screw", "world", "a"))), bad_file,
      says("joint 'k': it closes a loop, which a joint of its type cannot"));
  const auto all = from_sdf(model(
      link_text("a") +
      joint("j", "revolute", "world", "a", "<axis><dynamics><friction>1</friction></dynamics></axis>") +
      joint("k", "revolute", "world", "a",
            "<axis><limit><lower>0</lower><upper>1</upper></limit><dynamics><damping>1</damping></dynamics></axis>")));
  CHECK(has(all.warnings, "joint 'k': it closes a loop: its damping, friction, spring and rotor inertia are left out",
            true));
  CHECK(has(all.not_read, "joint 'k': it closes a loop: its limits are left out"));
}

TEST_CASE("check_robot tells the mobility of closed loops, and whether they can be closed") {
  const auto all = check_robot(load_robot(robot_file("four_bar.urdf")));
  REQUIRE(all.size() == 1);
  CHECK(all[0].text ==
        "closed loops: 5 rows of closures, rank 2, mobility 1; these rows follow from others: 'pin[2]', 'pin[4]', "
        "'pin[5]'");
  const auto texts_of = [](const robot_description& d) { return texts(check_robot(d)); };
  CHECK(texts_of(two_arms(loop_text("distance", " length='1'" + between()))).find("rank 1, mobility 1") !=
        std::string::npos);
  CHECK(texts_of(two_arms(loop_text("distance", " length='9'" + between())))
            .find("the loops do not close: 'l' stays open by 4 m") != std::string::npos);
  CHECK(texts_of(two_arms(loop_text("fixed", between()))).find("stays open") != std::string::npos);
}

TEST_CASE("descriptions hold closures, and MJCF those that it can say") {
  const auto r = load_robot(robot_file("four_bar.sdf"));
  CHECK(record_of(to_robot(describe(r)).chain).elements.size() == record_of(r.chain).elements.size());
  CHECK_THROWS_MATCHES(to_mjcf(r), bad_argument, says("closure 'pin': it closes a loop, which MJCF cannot say"));
  const auto weld =
      robot_of(arms("<weld name='w' body1='a' body2='b' relpose='1 0 0.5 1 0 0 0'/><joint name='p' joint1='qa' "
                    "joint2='qb' polycoef='0 1 2'/>"));
  const auto text = to_mjcf(weld, {.lossy = true});
  const auto again = robot_of(text);
  CHECK(again.loops == weld.loops);
  auto s = make_state(weld.chain), t = make_state(again.chain);
  const Eigen::Vector3d q(0.1, 0.2, 0.3);
  CHECK((loop_jacobian(weld.chain, s, q) - loop_jacobian(again.chain, t, q)).cwiseAbs().maxCoeff() < 1e-15);
  CHECK(loops(weld.chain, s, q).gap == within(loops(again.chain, t, q).gap, 1e-15));
}

}  // namespace loops_test
