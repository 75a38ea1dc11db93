#include <kte/robots/load_robot.hpp>

#include "catch.hpp"
#include "robots/files.hpp"
#include "robots/mjcf_texts.hpp"

// What of MJCF is not modelled, and what is rare in it: done, warned of or refused.

namespace mjcf_warnings_test {

using namespace kte;
using namespace kte::test::mjcf_texts;
using test::says;

TEST_CASE("what moves differently is warned of first, or refused") {
  const auto text = mjcf(
      "<body name='b'><joint name='j' axis='0 0 2'/><inertial pos='0 0 0' quat='1 0 0 0' mass='1' "
      "diaginertia='1 1 3'/><geom size='1' friction='1'/><geom size='1' contype='0' conaffinity='0' "
      "friction='2'/><plugin plugin='p'/></body>",
      "<option viscosity='0.1' wind='1 0 0'/><equality><connect name='loop' body1='b' anchor='0 0 0'/><weld "
      "body1='b' active='false'/></equality><tendon><fixed name='t' stiffness='3'><joint joint='j' "
      "coef='1'/></fixed><spatial name='u'/></tendon><actuator><motor joint='j'/><general joint='j' "
      "gainprm='1'/><position name='p1' joint='j' kp='1'/><position name='p2' joint='j' kp='1'/><position "
      "name='p3' joint='j'/><position name='p4' joint='j'/><position name='p0' joint='j' dampratio='1'/><muscle "
      "name='m' joint='j'/></actuator><deformable><flex name='f'/>"
      "</deformable>");
  const auto r = robot_of(text);
  CHECK(texts(r.warnings) ==
        "body 'b': <plugin>: plugins are not modelled\n"
        "<option>: the drag of its viscosity is not modelled\n"
        "fixed 't': its stiffness is not modelled\n"
        "flex 'f': flexible bodies are not modelled\n"
        "muscle 'm': its law is not modelled, as of others of <muscle>: 'm'\n"
        "position 'p0': its law is not modelled, as of others of <position>: 'p0'\n"
        "body 'b': first <geom>: contact is not modelled: friction, solref and others of 1 element\n"
        "position 'p1': the chain has its force, and that of any <position>, by kte::add_motors alone: 'p1', 'p2', "
        "'p3' and 1 more\n"
        "link 'b': the inertia is not physically realizable: its principal moment 3 is above 1 + 1 by 1 kg m^2; it is "
        "taken as "
        "published\n");
  CHECK((r.warnings[0].changes_motion && !r.warnings.back().changes_motion));
  CHECK_THROWS_MATCHES(robot_of(text, strict), bad_file,
                       says("kte: the robot '' would move differently from that of its file:\n  a.xml:2: "));
  CHECK(robot_of(mjcf("<body><joint/>" + heavy + "</body>"), strict).chain.dofs() == 1);
}

TEST_CASE("what MuJoCo does with rare combinations is done, or said") {
  const auto first = [](const std::string& inside, const std::string& before = "") {
    return from_mjcf(mjcf("<body name='b'><joint name='j'/>" + inside + "</body>", before));
  };
  const std::string own = "<inertial pos='1 2 3' mass='2' diaginertia='1 1 1'/>";
  CHECK(first(own, "<compiler inertiafromgeom='true'/>").links[1].inertial->mass == 2);  // no geom counts
  CHECK(
      first(own + "<geom size='.1' mass='5' group='3'/>", "<compiler inertiafromgeom='true' inertiagrouprange='0 1'/>")
          .links[1]
          .inertial->mass == 2);
  CHECK(first(own + "<geom size='.1' mass='5'/>", "<compiler inertiafromgeom='true'/>").links[1].inertial->mass == 5);
  // of the class and the element the form counts that comes first: euler, zaxis, xyaxes, axisangle, quat
  const auto turned =
      first("<geom type='box' size='1 2 3' axisangle='0 0 1 90'/><geom type='box' size='1 2 3' quat='1 0 0 0'/>",
            "<default><geom quat='1 1 0 0'/></default>");
  CHECK(turned.links[1].visuals[0].origin.rotation.x.y == -1);
  const auto by_class =
      first("<geom type='box' size='1 2 3' quat='1 1 0 0'/>", "<default><geom euler='0 0 90'/></default>");
  CHECK(by_class.links[1].visuals[0].origin.rotation.x.y == -1);
  CHECK(first("<geom type='capsule' size='.05'/>", "<default><geom size='.1 .2 .3'/></default>")
            .links[1]
            .visuals[0]
            .size == vec3<>{0.05, 0.4, 0});
  CHECK(first("<geom class='' size='1'/>").links.size() == 2);
  const auto warned = [&](const std::string& inside, const std::string& before) {
    return texts(first(inside, before).warnings);
  };
  CHECK(warned("<geom quat='0 0 0 0' size='1'/>", "") ==
        "body 'b': <geom>: a quaternion of length 0 is taken as no rotation\n");
  CHECK(warned("", "<default><tendon stiffness='1'/></default><tendon><spatial name='t'/></tendon>") ==
        "spatial 't': its stiffness is not modelled\n");
  CHECK(warned("", "<tendon><fixed name='t' stiffness='' damping='0 2'/></tendon>") ==
        "fixed 't': its damping is not modelled\n");
  const std::string loop = "<equality><weld body1='b'/></equality>";
  CHECK(warned("", "<default><equality active='false'/></default>" + loop).empty());
  CHECK(warned("", "<option><flag constraint='disable'/></option>" + loop).empty());
  CHECK(warned("<geom size='1' friction='2'/>", "<option><flag contact='disable'/></option>").empty());
  CHECK(warned(own, "<compiler fusestatic='true' settotalmass='1'/>").starts_with("<compiler>: fusestatic changes"));
  CHECK(warned("<geom size='1' contype='0' conaffinity='0'/>", "<compiler discardvisual='true'/>") ==
        "body 'b': <geom>: its mass counts, whatever discardvisual says\n");
  CHECK(warned("", "<compiler boundmass='1'/>") == "body 'b': it has no mass, and the least one at its origin\n");
  const auto dynamics = [&](const std::string& flag) {
    return first("<joint name='k' springdamper='1 2'/>" + own, "<option><flag " + flag + "='disable'/></option>");
  };
  CHECK(dynamics("spring").joints[1].dynamics.damping_ratio == robot_joint::none);
  CHECK(texts(dynamics("damper").warnings) == "joint 'k': springdamper without dampers is not modelled\n");
  CHECK(dynamics("passive").joints[1].dynamics == robot_joint_dynamics{});

  const auto refused = [&](const std::string& inside, const std::string& before, const std::string& why) {
    CHECK_THROWS_MATCHES(first(inside, before), bad_file, says(why));
  };
  refused("", "<compiler angle='Degree'/>", "angle 'Degree' is none of degree, radian");
  refused("", "<compiler inertiafromgeom='True'/>", "inertiafromgeom 'True' is none of auto, true, false");
  refused("", "<option><flag gravity='disabled'/></option>", "gravity 'disabled' is none of enable, disable");
  refused("<joint limited='True' range='0 1'/>", "", "limited 'True' is none of auto, true, false");
  refused("<geom size='-1'/>", "", "its size must not be negative, got -1");
  refused("<geom fromto='0 0 0 1 0 0' size='1'/>", "", "fromto is only for capsules");
  refused("<geom type='capsule' fromto='0 0 0 1 0 0'/>", "", "has no size");
  refused("<geom size='1e200'/>", "", "its mass is not finite");
  refused("<replicate count='1000000'/>", "", "more than 300000 elements");
}

}  // namespace mjcf_warnings_test
