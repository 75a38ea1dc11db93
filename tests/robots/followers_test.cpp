#include <kte/dynamics/inverse_dynamics.hpp>

#include "robots/files.hpp"
#include "robots/mjcf_texts.hpp"
#include "robots/sdf_texts.hpp"

namespace followers_test {

using namespace kte;
using test::has, test::says, test::sdf, test::mjcf_texts::heavy, test::mjcf_texts::mjcf, test::mjcf_texts::robot_of;

TEST_CASE("the range of a follower limits the joint that it follows") {
  const auto of = [](const std::string& limit, const std::string& mimic, const std::string& more = "") {
    return to_robot(from_urdf(test::urdf(
        "<link name='a'/><link name='b'/><link name='c'/>" +
        test::joint_text("lead", "continuous", "a", "b", "<limit effort='1' velocity='3'/>") +
        test::joint_text("rack", "prismatic", "a", "c",
                         "<limit effort='10' velocity='0.02' " + limit + "/><mimic joint='lead' " + mimic + "/>") +
        more)));
  };
  auto r = of("lower='0' upper='0.05'", "multiplier='0.01'");
  CHECK((r.limits.lower[0] == 0 && r.limits.upper[0] == within(5, 1e-15) && r.limits.rate[0] == 2));
  r = of("lower='0' upper='0.05'", "multiplier='-0.5' offset='0.1'");  // 0 <= 0.1 - q/2 <= 0.05
  CHECK((r.limits.lower[0] == within(0.1, 1e-16) && r.limits.upper[0] == within(0.2, 1e-16)));
  // a follower of the follower, with q = -2 q_rack + 1: 0.99 <= q gives q_rack <= 0.005
  const std::string second =
      "<link name='d'/>" +
      test::joint_text("second", "prismatic", "a", "d",
                       "<limit effort='1' velocity='9' lower='0.99' upper='9'/>"
                       "<safety_controller soft_lower_limit='0.992' soft_upper_limit='8' k_velocity='1'/>"
                       "<mimic joint='rack' multiplier='-2' offset='1'/>");
  r = of("lower='0' upper='0.05'", "multiplier='0.01'", second);
  CHECK((r.limits.lower[0] == 0 && r.limits.upper[0] == within(0.5, 1e-14)));
  CHECK(r.soft_limits.upper[0] == within(0.4, 1e-14));
  r = of("lower='0' upper='0.05'", "multiplier='0'");  // a follower that does not move
  CHECK(r.limits.upper[0] == robot_joint::none);

  // q_rack - 1 = 0.01 (q_lead - 2) in MJCF, where ref shifts the coordinates
  r = robot_of(
      mjcf("<body><joint name='lead' ref='2'/>" + heavy +
               "</body><body><joint name='rack' type='slide' ref='1' "
               "range='1 1.05'/>" +
               heavy + "</body>",
           "<compiler angle='radian'/><equality><joint joint1='rack' joint2='lead' polycoef='0 0.01'/></equality>"));
  CHECK((r.limits.lower[0] == within(2, 1e-14) && r.limits.upper[0] == within(7, 1e-13)));
}

TEST_CASE("a joint that follows one that is not in the file moves freely") {
  const auto d = from_urdf(test::urdf(
      "<link name='a'/><link name='b'/>" +
      test::joint_text("j", "prismatic", "a", "b", "<limit effort='1' velocity='1'/><mimic joint='lost'/>")));
  CHECK_FALSE(d.joints[0].mimic);
  CHECK(has(d.warnings, "joint 'j': it follows joint 'lost', which is not in the file: it moves freely", true));
}

TEST_CASE("springdamper of coupled joints, by the figures of MuJoCo 2.2.2") {
  const auto text = [](const char* first, const char* second) {
    return mjcf("<body><joint name='p' " + std::string(first) +
                    "/><inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/></body><body><joint name='q' " + second +
                    "/><inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/></body>",
                "<option gravity='0 0 0'/><equality><joint joint1='q' joint2='p' polycoef='0 1'/></equality>");
  };
  for (const auto& r : {robot_of(text("springdamper='0.5 1'", "")), robot_of(text("", "springdamper='0.5 1'"))}) {
    auto s = r.chain.make_state();
    CHECK(inverse_dynamics(r.chain, s, std::vector{1.0}, std::vector{0.0}, std::vector{0.0})[0] == within(4, 1e-14));
    CHECK(inverse_dynamics(r.chain, s, std::vector{0.0}, std::vector{1.0}, std::vector{0.0})[0] == within(4, 1e-14));
  }
}

TEST_CASE("a gearbox of SDF couples the joints of its links with the reference body") {
  using test::joint, test::link_text, test::model;
  const auto read = [](const std::string& first, const std::string& second, const std::string& axes,
                       const std::string& ratio = "<gearbox_ratio>3</gearbox_ratio>",
                       const std::string& reference = "a") {
    return from_sdf(model(link_text("a") + link_text("b") + link_text("c") +
                          joint("gears", "gearbox", "b", "c",
                                axes + ratio + "<gearbox_reference_body>" + reference + "</gearbox_reference_body>") +
                          first + second));
  };
  const std::string x = "<axis><xyz>1 0 0</xyz></axis>", x2 = "<axis2><xyz>1 0 0</xyz></axis2>",
                    back = "<axis><xyz>-1 0 0</xyz></axis>";
  const auto first = joint("i", "revolute", "a", "b", x);
  // the angle of c in a is -3 times that of b
  auto d = read(first, joint("j", "revolute", "a", "c", x), x + x2);
  REQUIRE((d.joints.size() == 2 && d.joints[1].mimic));
  CHECK((d.joints[1].mimic->joint == "i" && d.joints[1].mimic->ratio == -3));
  CHECK(to_robot(d).chain.dofs() == 1);
  CHECK(read(first, joint("j", "revolute", "a", "c", back), x + x2).joints[1].mimic->ratio == 3);
  CHECK(
      read(first, joint("j", "revolute", "a", "c", x), x + "<axis2><xyz>-1 0 0</xyz></axis2>").joints[1].mimic->ratio ==
      3);
  CHECK(read(first, joint("j", "revolute", "c", "a", x), x + x2).joints[1].mimic->ratio == 3);  // a turns in c
  CHECK(read(first, joint("j", "revolute", "a", "c", x), x + x2, "").joints[1].mimic->ratio == -1);
  const auto refused = [&](const std::string& second, const std::string& axes, const std::string& why,
                           const std::string& reference = "a") {
    CHECK_THROWS_MATCHES(read(first, second, axes, "", reference), bad_file, says("joint 'gears': " + why));
  };
  const auto j = joint("j", "revolute", "a", "c", x);
  refused(j, x, "has no <axis2>");
  refused(j, x + "<axis2><xyz>0 1 0</xyz></axis2>", "its axis2 is not that of joint 'j'");
  refused(joint("j", "prismatic", "a", "c", x), x + x2,
          "there is no revolute joint between its reference body 'a' and its child 'c'");
  refused(j, x + x2, "there is no frame 'd'", "d");
}

}  // namespace followers_test
