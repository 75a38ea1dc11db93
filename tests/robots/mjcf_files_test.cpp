#include <kte/robots/load_robot.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include "catch.hpp"
#include "robots/files.hpp"
#include "robots/folder.hpp"

namespace mjcf_files_test {

using namespace kte;
using test::folder, test::says;

/// A body of MJCF with one hinge.
std::string hinged(const std::string& name, const std::string& inside = "") {
  return "<body name='" + name + "'><joint name='" + name + "'/><inertial pos='0 0 1' mass='2' diaginertia='1 1 1'/>" +
         inside + "</body>";
}
std::string mjcf(const std::string& inside) { return "<mujoco>" + inside + "</mujoco>"; }
/// A cube of edge 2 in millimetres, as OBJ.
const std::string cube =
    "v 0 0 0\nv 2000 0 0\nv 2000 2000 0\nv 0 2000 0\nv 0 0 2000\nv 2000 0 2000\nv 2000 2000 2000\nv 0 2000 2000\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 4 1 5 8\n";

TEST_CASE("files of MJCF that are included stand where they are included") {
  const folder f;
  f.write("parts/settings.xml",
          "<mujocoinclude><compiler angle='radian'/><default><joint damping='3'/></default></mujocoinclude>");
  f.write("parts/arm.xml", "<mujoco>" + hinged("upper", "<include file='hand.xml'/>") + "</mujoco>");
  f.write("parts/hand.xml", "<mujoco>\n<geom name='palm' type='sphere' size='0.1'/>\n" + hinged("hand") + "</mujoco>");
  f.write("motors.xml", mjcf("<actuator><motor name='m' joint='hand' gear='7'/></actuator>"));
  const auto file =
      f.write("robot.xml", mjcf("<include file='parts\\settings.xml'/><worldbody>" + hinged("base") +
                                "<include file='parts/arm.xml'/></worldbody><include file='motors.xml'/>"));
  const auto d = load_mjcf(file);
  REQUIRE(d.joints.size() == 3);
  CHECK((d.joints[0].name == "base" && d.joints[1].name == "upper" && d.joints[2].name == "hand"));
  CHECK(d.joints[2].parent == "upper");
  CHECK(d.joints[2].dynamics.damping == 3);
  CHECK((d.actuators.size() == 1 && d.actuators[0].gear == 7));
  CHECK(d.joints[2].line == 3);
  CHECK(d.joints[2].file == (f.path / "parts" / "hand.xml").string());
  CHECK(d.joints[0].file.empty());
  CHECK(load_robot(file).chain.dofs() == 3);
  CHECK(describe_robot(mjcf("<include file='motors.xml'/><worldbody>" + hinged("hand") + "</worldbody>"), file.string())
            .actuators.size() == 1);
}

TEST_CASE("meshes of an included file are found beside it") {
  const folder f;
  const auto mass = [&](const std::string& compiler, const std::string& file) {
    f.write("parts/arm.xml", "<mujoco><asset><mesh name='m' file='" + file +
                                 "'/></asset><worldbody><body><joint/><geom type='mesh' mesh='m' "
                                 "density='1e-9'/></body></worldbody></mujoco>");
    return load_mjcf(f.write("robot.xml", mjcf(compiler + "<include file='parts/arm.xml'/>"))).links[1].inertial->mass;
  };
  f.write("parts/beside.obj", cube), f.write("parts/meshes/below.obj", cube), f.write("meshes/parts/main.obj", cube);
  CHECK(mass("", "beside.obj") == within(8, 1e-14));
  CHECK(mass("", "parts/beside.obj") == within(8, 1e-14));
  CHECK(mass("<compiler meshdir='parts/meshes'/>", "below.obj") == within(8, 1e-14));
  CHECK(mass("<compiler meshdir='meshes'/>", "below.obj") == within(8, 1e-14));
  CHECK(mass("<compiler meshdir='meshes'/>", "main.obj") == within(8, 1e-14));
  CHECK_THROWS_MATCHES(mass("", "lost.obj"), bad_file, says("there is no file '"));
}

TEST_CASE("includes that cannot be read are refused by file and line") {
  const folder f;
  const auto refused = [&](const std::string& text, const std::string& why) {
    const auto file = f.write("robot.xml", text);
    CHECK_THROWS_MATCHES(load_mjcf(file), bad_file, says(why));
  };
  refused("<mujoco>\n<include file='none.xml'/></mujoco>", "robot.xml:2: <include>: there is no file 'none.xml'");
  refused("<mujoco><include/></mujoco>", "<include>: has no file");
  refused("<mujoco><include file='robot.xml'/></mujoco>", "'robot.xml' is included already");
  refused(mjcf("<include file='.'/>"), "there is no file '.'");
  refused(mjcf("<include file='" + std::string(5000, 'x') + "'/>"), "there is no file 'xxx");
  f.write("a.xml", mjcf("<include file='b.xml'/>"));
  f.write("b.xml", "<mujoco>\n\n<include file='a.xml'/></mujoco>");
  refused(mjcf("<include file='a.xml'/>"), "b.xml:3: <include>: the file 'a.xml' is included already");
  f.write("bad.xml", "<mujoco>\n<worldbody></mujoco>");
  refused(mjcf("<include file='bad.xml'/>"), "bad.xml:2: this is not valid XML");
  f.write("wrong.xml", "<mujoco>\n<worldbody><body><joint axis='0 0 0'/></body></worldbody></mujoco>");
  refused(mjcf("<include file='wrong.xml'/>"), "wrong.xml:2: <joint>: the axis has length 0");
}

TEST_CASE("models that others attach keep their own settings") {
  const folder f;
  f.write("hand.xml",
          "<mujoco model='Hand'><compiler angle='radian'/><default><joint damping='2'/></default>"
          "<asset><mesh name='cube' file='cube.obj' scale='0.001 0.001 0.001'/></asset><worldbody>" +
              hinged("palm",
                     "<body name='finger'><joint name='bend' range='0 1'/><geom type='mesh' "
                     "mesh='cube'/><site name='tip'/></body>") +
              hinged("other") +
              "</worldbody><actuator><position name='p' joint='bend' kp='3'/><motor joint='other'/></actuator>"
              "</mujoco>");
  f.write("cube.obj", cube);
  const auto file = f.write(
      "robot.xml",
      mjcf("<asset><model file='hand.xml'/><model name='again' file='hand.xml'/></asset><worldbody>" +
           hinged("arm",
                  "<frame pos='1 0 0' childclass='mine'><attach model='Hand' body='palm' prefix='left_'/></frame>"
                  "<attach model='again' body='palm' prefix='right_'/>") +
           "<frame name='stand'>" + hinged("pole") + "</frame><attach frame='stand' prefix='second_'/>" +
           "<attach model='Hand' prefix='whole_'/></worldbody><default><default class='mine'/></default>"));
  const auto d = load_mjcf(file);
  std::string names;
  for (const auto& j : d.joints) names += j.name + " ";
  CHECK(names == "arm left_palm left_bend right_palm right_bend pole second_pole whole_palm whole_bend whole_other ");
  CHECK(d.joints[0].dynamics.damping == 0);
  CHECK((d.joints[1].dynamics.damping == 2 && d.joints[1].origin.position == vec3<>{1, 0, 0}));
  CHECK(d.joints[2].upper == 1);
  for (const auto& l : d.links)
    if (l.name.ends_with("finger")) CHECK(l.inertial->mass == within(8000, 1e-11));
  CHECK(d.frames.size() == 3);
  REQUIRE(d.actuators.size() == 4);
  std::string driven;
  for (const auto& a : d.actuators) driven += a.name + ":" + a.joint + " ";
  CHECK(driven == "whole_p:whole_bend :whole_other left_p:left_bend right_p:right_bend ");

  const auto refused = [&](const std::string& inside, const std::string& why) {
    CHECK_THROWS_MATCHES(load_mjcf(f.write("bad.xml", inside)), bad_file, says(why));
  };
  refused(mjcf("<worldbody><attach model='none'/></worldbody>"), "<attach>: there is no model 'none' among the assets");
  refused(mjcf("<asset><model name='h' file='hand.xml'/></asset><worldbody><attach model='h' body='b'/></worldbody>"),
          "there is no body 'b' to attach");
  refused(mjcf("<asset><model name='h' file='none.xml'/></asset><worldbody><attach model='h'/></worldbody>"),
          "model 'h': there is no file 'none.xml'");
  refused(mjcf("<worldbody><frame name='f'><attach frame='f'/></frame></worldbody>"), "more than 32 deep");
  refused(mjcf("<worldbody><body name='b'><attach body='b'/></body></worldbody>"), "bodies nest deeper than");
}

TEST_CASE("a body of a mesh is read where its mass matters, and only there") {
  const folder f;
  f.write("meshes/cube.obj", cube);
  const auto read = [&](const std::string& geom, const std::string& compiler = "",
                        const std::string& body = "<joint/>") {
    return load_mjcf(
        f.write("robot.xml", mjcf("<compiler meshdir='meshes' " + compiler +
                                  "/><asset><mesh file='cube.obj' scale='.001 .001 .001'/>"
                                  "<mesh name='lost' file='lost.stl'/><mesh name='twin' vertex='0 0 0 1 0 0 "
                                  "0 1 0 0 0 1' inertia='exact'/></asset><worldbody><body name='b'>" +
                                  body + geom + "</body></worldbody>")));
  };
  const auto body = *read("<geom type='mesh' mesh='cube' density='10' pos='0 0 1'/>").links[1].inertial;
  CHECK(body.mass == within(80, 1e-13));
  CHECK(body.com.x == within(1, 1e-15));
  CHECK(body.com.z == within(2, 1e-15));
  CHECK(body.inertia.xx == within(80.0 * 2 / 3, 1e-13));  // m (2^2 + 2^2)/12
  CHECK(read("<geom type='mesh' mesh='cube' mass='3'/>").links[1].inertial->inertia.yy == within(2, 1e-15));
  CHECK(read("<geom type='mesh' mesh='twin' mass='3'/>").links[1].inertial->com.x == within(0.25, 1e-16));  // its hull
  const auto ball = read("<geom type='sphere' mesh='cube' density='1'/>");  // (1 + 1 + 1)/3 as its radius
  CHECK(ball.links[1].inertial->mass == within(4 * 3.141592653589793 / 3, 1e-14));
  CHECK(ball.links[1].visuals[0].origin.position.x == within(1, 1e-15));

  CHECK_THROWS_MATCHES(read("<geom type='mesh' mesh='lost'/>"), bad_file,
                       says("its mass is that of a mesh, and there is "));
  CHECK_THROWS_MATCHES(read("<geom type='mesh' mesh='no'/>"), bad_file, says("there is no mesh 'no' among the assets"));
  CHECK_FALSE(read("<geom type='mesh' mesh='lost' mass='0'/>").links[1].inertial);
  CHECK_FALSE(read("<geom type='mesh' mesh='lost' density='0'/>").links[1].inertial);
  CHECK_FALSE(read("<geom type='mesh' mesh='lost'/>", "", "").links[1].inertial);  // stands on the world
  const auto shell = *read("<geom type='mesh' mesh='cube' shellinertia='true'/>").links[1].inertial;
  CHECK(shell.mass == within(24000, 1e-11));  // of six faces
  CHECK(read("<geom type='mesh' mesh='cube'/><geom type='mesh' mesh='cube' pos='9 0 0'/>").links[1].inertial->mass ==
        within(16000, 1e-11));
  CHECK_THROWS_AS(read("<geom type='mesh' mesh='lost'/>", "settotalmass='1'", ""), bad_file);
  CHECK(read("<geom type='mesh' mesh='lost' group='3'/>", "inertiagrouprange='0 2'").links.size() == 2);
  const std::string own = "<joint/><inertial pos='0 0 0' mass='5' diaginertia='1 1 1'/>";
  CHECK(read("<geom type='mesh' mesh='lost'/>", "", own).links[1].inertial->mass == 5);
  CHECK_THROWS_AS(read("<geom type='mesh' mesh='lost'/>", "inertiafromgeom='true'", own), bad_file);
  CHECK(read("<geom type='mesh' mesh='cube'/>", "", own).links[1].visuals[0].mesh ==
        (f.path / "meshes" / "cube.obj").generic_string());
}

}  // namespace mjcf_files_test
