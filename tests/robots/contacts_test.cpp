#include <kte/contacts.hpp>
#include <kte/elements/joint_damping.hpp>
#include <kte/elements/joint_stiffness.hpp>
#include <kte/models/runtime_dynamics_model.hpp>
#include <kte/robots/check_robot.hpp>
#include <kte/robots/load_robot.hpp>

#include "catch.hpp"
#include "elements/laws.hpp"
#include "robots/files.hpp"
#include "robots/folder.hpp"
#include "robots/sdf_texts.hpp"

// Contacts of collision shapes with the ground, from files.

namespace contacts_test {

using namespace kte;
using namespace kte::test;

robot_options on(const std::string& ground = "world") {
  robot_options o;
  o.contacts.ground = ground;
  return o;
}
robot_options floating() {
  auto o = on();
  o.floating_base = true;
  return o;
}
robot read(const std::string& text, const robot_options& o) { return to_robot(describe_robot(text, "r.xml", o), o); }
std::string text_of(const std::vector<robot_note>& notes) {
  std::string all;
  for (const auto& n : notes) all += n.text + (n.changes_motion ? " (!)\n" : "\n");
  return all;
}

constexpr const char* names[]{"FL", "FR", "HL", "HR"};
constexpr double reach[4][2]{{0.2, 0.1}, {0.2, -0.1}, {-0.2, 0.1}, {-0.2, -0.1}};

std::string place(int k, const char* z) {
  return detail::number(reach[k][0]) + " " + detail::number(reach[k][1]) + " " + z;
}
/// A quadruped of 2 kg with legs of 0.1 kg and spherical feet of 0.016 m at -0.3 m, in each format.
std::string quadruped_urdf(const std::string& in_foot = "") {
  std::string t =
      "<link name='trunk'><inertial><mass value='2'/><inertia ixx='.02' ixy='0' ixz='0' iyy='.03' iyz='0' "
      "izz='.04'/></inertial></link>";
  for (int k = 0; k < 4; ++k) {
    const std::string n = names[k];
    t += "<link name='" + n +
         "_leg'><inertial><origin xyz='0 0 -.15'/><mass value='.1'/><inertia ixx='.001' ixy='0' ixz='0' iyy='.001' "
         "iyz='0' izz='.0001'/></inertial></link><link name='" +
         n + "_foot'><collision><geometry><sphere radius='.016'/></geometry></collision>" + in_foot +
         "</link><joint name='" + n + "' type='revolute'><parent link='trunk'/><child link='" + n +
         "_leg'/><origin xyz='" + place(k, "0") +
         "'/><axis xyz='0 1 0'/><limit lower='-3' upper='3' effort='9' velocity='9'/></joint><joint name='" + n +
         "_ankle' type='fixed'><parent link='" + n + "_leg'/><child link='" + n +
         "_foot'/><origin xyz='0 0 -.3'/></joint>";
  }
  return "<robot name='quadruped'>" + t + "</robot>";
}
std::string quadruped_mjcf(const std::string& in_world = "") {
  std::string t =
      "<body name='trunk' pos='0 0 .316'><freejoint name='floating_base'/><inertial pos='0 0 0' mass='2' "
      "diaginertia='.02 .03 .04'/>";
  for (int k = 0; k < 4; ++k) {
    const std::string n = names[k];
    t += "<body name='" + n + "_leg' pos='" + place(k, "0") + "'><joint name='" + n +
         "' axis='0 1 0'/><inertial pos='0 0 -.15' mass='.1' diaginertia='.001 .001 .0001'/><geom name='" + n +
         "_foot' size='.016' pos='0 0 -.3' friction='.7'/></body>";
  }
  return "<mujoco model='quadruped'><worldbody>" + in_world + t + "</body></worldbody></mujoco>";
}
std::string quadruped_sdf(const std::string& surface = "") {
  const auto body = [](const char* mass, const char* x, const char* y, const char* z) {
    return std::string("<mass>") + mass + "</mass><inertia><ixx>" + x + "</ixx><iyy>" + y + "</iyy><izz>" + z +
           "</izz></inertia></inertial>";
  };
  std::string t = "<link name='trunk'><inertial>" + body("2", ".02", ".03", ".04") + "</link>";
  for (int k = 0; k < 4; ++k) {
    const std::string n = names[k];
    t += "<link name='" + n + "_leg'><pose>" + place(k, "0") + " 0 0 0</pose><inertial><pose>0 0 -.15 0 0 0</pose>" +
         body(".1", ".001", ".001", ".0001") + "<collision name='" + n +
         "_foot'><pose>0 0 -.3 0 0 0</pose><geometry><sphere><radius>.016</radius></sphere></geometry>" + surface +
         "</collision></link>" +
         joint(n, "revolute", "trunk", n + "_leg",
               "<axis><xyz>0 1 0</xyz><limit><lower>-3</lower><upper>3</upper></limit></axis>");
  }
  return model(t);
}
double weight(const robot& r) {
  double mass = 0;
  for (const auto& e : record_of(r.chain).elements)
    for (const auto& p : e.parameters)
      if (p.name == "mass") mass += p.values[0];
  return 9.81 * mass;
}

TEST_CASE("a quadruped stands on its feet, from each format") {
  const auto urdf_robot = read(quadruped_urdf(), floating()), sdf_robot = read(quadruped_sdf(), floating());
  const auto mjcf_robot = read(quadruped_mjcf(), on());
  CHECK(urdf_robot.contacts ==
        std::vector<std::string>{"FL_foot.contact", "FR_foot.contact", "HL_foot.contact", "HR_foot.contact"});
  CHECK(mjcf_robot.contacts == std::vector<std::string>{"FL_foot", "FR_foot", "HL_foot", "HR_foot"});
  CHECK(sdf_robot.contacts == mjcf_robot.contacts);
  std::vector<Eigen::VectorXd> accelerations;
  for (const auto* r : {&urdf_robot, &sdf_robot, &mjcf_robot}) {
    INFO(r->name << ": " << text_of(r->warnings));
    REQUIRE(r->configurations.size() == 1);
    const auto& c = r->configurations[0];
    CHECK(c.name == (r == &mjcf_robot ? "reference" : "standing"));
    CHECK(c.q[2] == within(0.316, 1e-15));
    auto s = make_state(r->chain);
    const Eigen::VectorXd q = Eigen::Map<const Eigen::VectorXd>(c.q.data(), r->chain.nq());
    Eigen::VectorXd v = Eigen::VectorXd::Zero(r->chain.dofs()), tau = v;
    v[0] = 0.1;
    const auto& sliding = contact_dynamics(r->chain, s, q, v, tau);
    accelerations.push_back(sliding.a);
    const auto& f = s.contact(r->contacts[0]).force;
    CHECK(f.x == within((r == &mjcf_robot ? -0.7 : -1.0) * f.z, 1e-12));
  }
  CHECK((accelerations[0] - accelerations[1]).norm() < 1e-9);
}

TEST_CASE("a quadruped that is dropped comes to rest on its feet") {
  auto o = floating();
  o.contacts.friction = 0.7;
  auto r = read(quadruped_urdf(), o);
  for (const std::string name : names) r.chain << joint_stiffness_gen(name, 20.0, 0.0) << joint_damping_gen(name, 1.0);
  const manipulator_dynamics_model model(r.chain);
  Eigen::VectorXd q = Eigen::Map<const Eigen::VectorXd>(r.configurations[0].q.data(), r.chain.nq());
  q[2] += 0.05;
  moreau_jean solver(std::cref(model), 0.0, model.make_x(q, Eigen::VectorXd::Zero(10)), 2e-3);
  solver.integrate(1.0);
  CHECK(model.velocities_of(solver.state()).norm() < 1e-3);
  CHECK(model.positions_of(solver.state())[2] == within(0.316, 0.01));
  double up = 0;
  for (const auto& name : r.contacts) up += solver.contact(name).force.z;
  CHECK(up == within(weight(r), 0.01 * weight(r)));
}

TEST_CASE("friction and restitution are those of the options, or of the file") {
  const auto law = [](const robot& r, int k = 0) {
    std::pair<double, double> found;
    for (const auto& e : record_of(r.chain).elements)
      if (e.type == "sphere_contact_3D" && k-- == 0)
        for (const auto& p : e.parameters) {
          if (p.name == "friction") found.first = p.values[0];
          if (p.name == "restitution") found.second = p.values[0];
        }
    return found;
  };
  using pair = std::pair<double, double>;
  const std::string bullet =
      "<contact><lateral_friction value='.4'/><restitution value='.5'/><stiffness value='3'/></contact>";
  CHECK(law(read(quadruped_urdf(), floating())) == pair(1, 0));
  const auto r = read(quadruped_urdf(bullet), floating());
  CHECK(law(r) == pair(0.4, 0.5));
  CHECK(text_of(r.warnings) ==
        holding("link 'FL_foot': <contact>: of the properties of contacts these are not read: stiffness (!)"));
  auto o = floating();
  o.contacts.friction = 0.2, o.contacts.restitution = 0.1;
  CHECK(law(read(quadruped_urdf(bullet), o)) == pair(0.2, 0.1));
  auto gazebo = quadruped_urdf();
  gazebo.insert(gazebo.find("</robot>"), "<gazebo reference='FL_foot'><mu1>.3</mu1><mu2>.3</mu2></gazebo>");
  CHECK(law(read(gazebo, floating())) == pair(0.3, 0));
  CHECK(law(read(gazebo, floating()), 1) == pair(1, 0));
  const auto surface = read(quadruped_sdf("<surface><friction><ode><mu>.6</mu><mu2>.6</mu2><slip1>1</slip1></ode>"
                                          "</friction><bounce><restitution_coefficient>.2</restitution_coefficient>"
                                          "</bounce><contact><ode><kp>1</kp></ode></contact></surface>"),
                            floating());
  CHECK(law(surface) == pair(0.6, 0.2));
  CHECK(text_of(surface.warnings) == holding("these are not read: contact/ode, slip1 (!)"));
  CHECK(read(quadruped_sdf("<surface><contact><collide_bitmask>0x00</collide_bitmask></contact></surface>"), floating())
            .contacts.empty());

  const auto mjcf = [&](const std::string& plane, const std::string& foot) {
    auto t = quadruped_mjcf("<geom name='floor' type='plane' size='1 1 1' " + plane + "/>");
    t.replace(t.find("friction='.7'"), 13, foot);
    return read(t, on());
  };
  CHECK(law(mjcf("friction='.9'", "friction='.7'")).first == 0.9);
  CHECK(law(mjcf("friction='.5'", "friction='.7'")).first == 0.7);
  CHECK(law(mjcf("friction='.5' priority='1'", "friction='.7'")).first == 0.5);
  CHECK(law(mjcf("condim='1'", "condim='1'")).first == 0);
  CHECK(law(mjcf("condim='3'", "condim='1'")).first == 1);
  CHECK(text_of(mjcf("solref='.01 1' condim='6'", "margin='.1'").warnings) ==
        holding("these are not read: condim above 3, margin, solref (!)"));
}

TEST_CASE("whole numbers of contacts are such, and fit into their type") {
  const auto foot = [](const std::string& attributes) {
    auto t = quadruped_mjcf("<geom name='floor' type='plane' size='1 1 1'/>");
    t.replace(t.find("friction='.7'"), 13, attributes);
    return [t] { (void)read(t, on()); };
  };
  const auto refused = [&](const std::string& attributes, const std::string& why) {
    CHECK_THROWS_MATCHES(foot(attributes)(), bad_file, test::says("geom 'FL_foot': " + why));
  };
  const std::string of_int = "must be a whole number from -2147483648 to 2147483647, got ";
  refused("priority='1e300'", "priority " + of_int + "1.0000000000000001e+300");
  refused("priority='0.5'", "priority " + of_int + "0.5");
  refused("group='-1e10'", "group " + of_int + "-10000000000");
  refused("group='2.5'", "group " + of_int + "2.5");
  refused("contype='1.5'", "contype must be a whole number from -2147483648 to 4294967295, got 1.5");
  refused("conaffinity='5e9'", "conaffinity must be a whole number from -2147483648 to 4294967295, got 5000000000");
  refused("condim='1e300'", "condim must be a whole number from 1 to 6, got 1.0000000000000001e+300");
  refused("condim='2'", "condim must be 1, 3, 4 or 6, got 2");
  CHECK_NOTHROW(foot("priority='-3' condim='4' contype='4294967295' conaffinity='-1' group='-2'")());

  const auto mask = [](const std::string& bits) {
    return [=] {
      (void)read(quadruped_sdf("<surface><contact><collide_bitmask>" + bits + "</collide_bitmask></contact></surface>"),
                 floating());
    };
  };
  for (const std::string bits : {"all", "-1", "1.5", "1e300", "0x", "4294967296", "3 4"})
    CHECK_THROWS_MATCHES(mask(bits)(), bad_file,
                         test::says("<collide_bitmask>: '" + bits + "' is not a whole number of 32 bits"));
  for (const std::string bits : {"", " 7 ", "0xFFFFFFFF", "65535"}) CHECK_NOTHROW(mask(bits)());
}

TEST_CASE("planes of MJCF are the ground, with types, exclusions and pairs") {
  const auto box = [](const std::string& floor, const std::string& geom, const std::string& rest = "") {
    return read(
        "<mujoco><worldbody>" + floor +
            "<body name='crate' pos='0 0 1'><freejoint name='pose'/><geom name='box' type='box' size='.3 .2 .1' "
            "mass='2' " +
            geom + "/></body></worldbody>" + rest + "</mujoco>",
        on());
  };
  const std::string floor = "<geom name='floor' type='plane' size='5 5 .1'/>";
  const auto r = box(floor, "");
  CHECK(r.contacts.size() == 8);
  CHECK(r.contacts[2] == "box/corner 3");
  auto s = make_state(r.chain);
  r.chain.doMotion(s);
  CHECK(near(s.contact("box/corner 3").point, vec3<>{-0.3, 0.2, -0.1}, 1e-15));

  const auto tilted = box("<geom name='floor' type='plane' size='0 0 1' pos='0 0 -1' euler='0 90 0'/>", "");
  auto t = make_state(tilted.chain);
  tilted.chain.doMotion(t);
  CHECK(t.contact("box/corner 2").gap == within(0.3, 1e-15));  // z of the plane is x of the world
  CHECK(t.contact("box/corner 1").gap == within(-0.3, 1e-15));

  const auto two = box(floor + "<geom name='wall' type='plane' size='1 1 1' pos='-1 0 0' euler='0 90 0'/>", "");
  CHECK(two.contacts.size() == 16);
  CHECK(two.contacts[8] == "box/wall/corner 1");
  CHECK(box(floor, "contype='2' conaffinity='2'").contacts.empty());
  CHECK(box(floor, "contype='2' conaffinity='1'").contacts.size() == 8);
  CHECK(box(floor, "", "<contact><exclude body1='world' body2='crate'/></contact>").contacts.empty());
  const auto pair = box(floor, "contype='0' conaffinity='0'",
                        "<contact><pair geom1='box' geom2='floor' friction='.3 .3 .1 .1 .1'/></contact>");
  CHECK(pair.contacts.size() == 8);
  const auto off = box(floor, "", "<option><flag contact='disable'/></option>");
  CHECK(off.contacts.empty());
  CHECK(text_of(off.warnings) == holding("the robot has no contacts: no shape that moves can touch the ground\n"));
  CHECK(
      text_of(box(floor, "", "<contact><pair geom1='box' geom2='other'/></contact>").warnings) ==
      holding("the contact of 'box' and 'other' is not one of a moving body with the ground: it is not modelled (!)"));
}

TEST_CASE("height fields of MJCF are the ground") {
  const folder at;
  const std::string heights("\3\0\0\0\2\0\0\0\0\0\0\0\0\0\0\0\0\0\200\77\0\0\200\77\0\0\0\100\0\0\0\100", 32);
  at.write("hill.bin", heights);  // 3 rows of 2: 0 0, 1 1, 2 2
  const auto ball = [&](const std::string& hfield, const std::string& geom = "size='.1'") {
    return load_robot(at.write("a.xml", "<mujoco><asset><hfield name='h' size='1 2 .8 .1' " + hfield +
                                            "/></asset><worldbody><geom name='hill' type='hfield' hfield='h' pos='0 0 "
                                            "1'/><body name='b'><freejoint name='pose'/><geom name='ball' mass='1' " +
                                            geom + "/></body></worldbody></mujoco>"),
                      on());
  };
  for (const auto* hfield : {"file='hill.bin'", "nrow='3' ncol='2' elevation='9 9 8 8 7 7'"}) {
    const auto r = ball(hfield);  // a slope of 0.8 over 4 m along y
    auto s = make_state(r.chain);
    s.pose_3D("pose").position = {0.3, 0.5, 2};
    r.chain.doMotion(s);
    CHECK(s.contact("ball").gap == within((2 - 1.5) / std::hypot(1, 0.2) - 0.1, 1e-12));
  }
  CHECK(text_of(ball("file='hill.png'").warnings) ==
        holding("geom 'hill': its height field is not read: 'hill.png' is an image (!)"));
  const auto c = ball("file='hill.bin'", "type='cylinder' size='.1 .2'");
  CHECK(c.contacts.size() == 16);
  CHECK(text_of(c.warnings) ==
        holding("contacts of 'b': the rims of cylinders touch height fields by 8 points each (!)"));
}

TEST_CASE("height maps of SDF and fields of MJCF that are not read are named with their line") {
  const auto line_of = [](const std::vector<robot_note>& notes, const std::string& text, bool moves) {
    for (const auto& n : notes)
      if (n.text.find(text) != n.text.npos && n.changes_motion == moves) return n.line;
    return -1;
  };
  const std::string map =
      "<collision name='hill'>\n<geometry>\n<heightmap><uri>a.png</uri></heightmap></geometry></collision>";
  const auto ball =
      link_text("ball", "<collision name='ball'><geometry><sphere><radius>.1</radius></sphere></geometry></collision>");
  const auto own = model(joint("fixed", "fixed", "world", "ground", "") + link_text("ground", map) + ball);
  const auto other = sdf("<world name='w'><model name='terrain'><static>true</static><link name='l'>" + map +
                         "</link></model><model name='m'>" + ball + "</model></world>");
  const std::string of_sdf = "<heightmap>: not read: the ground does not have this surface, but a plane";
  for (const auto& [text, o] : {std::pair{own, on()}, std::pair{other, floating()}}) {
    CHECK(line_of(read(text, o).warnings, "collision 'hill': " + of_sdf, true) == 3);
    CHECK(line_of(check_robot(describe_robot(text, "r.sdf", o), o), of_sdf, true) == 3);
    auto strict = o;
    strict.strict = true;
    CHECK_THROWS_WITH(read(text, strict), Catch::Matchers::Contains("3: collision 'hill': " + of_sdf));
  }
  const auto untouched = read(own, {});
  CHECK(line_of(untouched.not_read, "<heightmap>: not read", false) == 3);
  CHECK(line_of(untouched.warnings, "heightmap", true) == -1);

  const std::string mjcf =
      "<mujoco><asset>\n<hfield name='h' size='1 2 .8 .1' file='hill.png'/></asset><worldbody>\n<geom name='hill' "
      "type='hfield' hfield='h'/><body name='b'><freejoint/><geom size='.1'/></body></worldbody></mujoco>";
  const std::string of_mjcf = "geom 'hill': its height field is not read: 'hill.png' is an image";
  CHECK(line_of(read(mjcf, on()).warnings, of_mjcf, true) == 3);
  CHECK(line_of(check_robot(describe_robot(mjcf, "r.xml", on()), on()), of_mjcf, true) == 3);
  CHECK(line_of(read(mjcf, {}).not_read, "geom 'hill': its hfield is not read", false) == 3);
}

TEST_CASE("capsules, cylinders and other shapes touch, or are named") {
  const auto of = [](const std::string& geometry, robot_options o = floating()) {
    return read(
        "<robot name='r'><link name='can'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' "
        "iyz='0' izz='1'/></inertial><collision><origin xyz='0 .1 0' rpy='1.5707963267948966 0 "
        "0'/><geometry>" +
            geometry + "</geometry></collision></link></robot>",
        o);
  };
  const auto capsule = of("<capsule radius='.05' length='.4'/>");
  CHECK(capsule.contacts == std::vector<std::string>{"can.contact/end 1", "can.contact/end 2"});
  CHECK(capsule.configurations[0].q[2] == within(0.05, 1e-15));

  const std::string cylinder = "<cylinder radius='.05' length='.4'/>";
  const auto rims = of(cylinder);
  CHECK(rims.contacts == std::vector<std::string>{"can.contact/rim 1", "can.contact/rim 2"});
  auto s = make_state(rims.chain);
  Eigen::VectorXd q = Eigen::Map<const Eigen::VectorXd>(rims.configurations[0].q.data(), 7), v(6), tau(6);
  tau.setZero(), v << 0.1, 0, 0, 0, 2, 0;  // it rolls
  const auto& rolls = contact_dynamics(rims.chain, s, q, v, tau);
  Eigen::VectorXd turns = Eigen::VectorXd::Zero(6);
  turns[2] = 0.2;  // v is constant in the world, and in axes of the body that turn
  CHECK((rolls.a - turns).norm() < 1e-9);
  CHECK(rolls.force("can.contact/rim 1").z + rolls.force("can.contact/rim 2").z == within(9.81, 1e-9));

  auto points = floating();
  points.contacts.rim_points = 6;
  const auto corners = of(cylinder, points);
  CHECK(corners.contacts.size() == 12);
  CHECK(corners.contacts[7] == "can.contact/rim 2 point 2");

  CHECK(text_of(of("<drake:ellipsoid a='1' b='1' c='1'/>").warnings) ==
        holding("contacts of 'can': ellipsoids are not supported (!)"));
  auto soft = floating();
  soft.contacts.friction = 0.5, soft.contacts.compliant = {.stiffness = 1e5};
  const auto c = of(cylinder, soft);
  CHECK(c.contacts.empty());
  int contacts = 0;
  for (const auto& e : record_of(c.chain).elements) contacts += e.type == "compliant_disc_contact_3D";
  CHECK(contacts == 2);
}

TEST_CASE("feet of meshes touch by their lowest vertices") {
  const folder at;
  at.write("meshes/foot.obj",
           "v -1 -2 0\nv 1 -2 0\nv 1 2 0\nv -1 2 0\nv 0 0 0\nv 0 0 3\nf 1 2 6\nf 2 3 6\nf 3 4 6\nf 4 1 6\n");
  const auto leg = [&](const std::string& mesh) {
    return load_robot(
        at.write(
            "leg.urdf",
            urdf("<link name='body'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' "
                 "izz='1'/></inertial><collision><geometry><mesh filename='" +
                 mesh + "'/></geometry></collision></link>" + heavy("leg") +
                 "<link name='foot'><collision><origin xyz='0 0 -1'/><geometry><mesh filename='" + mesh +
                 "' scale='.1 .1 .1'/></geometry></collision></link>" +
                 joint_text("knee", "revolute", "body", "leg", "<axis xyz='0 1 0'/><limit effort='1' velocity='1'/>") +
                 joint_text("ankle", "fixed", "leg", "foot", ""))),
        floating());
  };
  const auto r = leg("package://robot/meshes/foot.obj");
  CHECK(r.contacts.size() == 4);
  CHECK(r.contacts[3] == "foot.contact/point 4");
  CHECK(r.configurations[0].q[2] == 1);
  CHECK(
      text_of(r.warnings) ==
      (holding("contacts of 'body': meshes are not supported, except for feet (!)") &&
       holding("contacts of 'foot': it touches by the lowest vertices of its mesh in the neutral configuration (!)")));
  auto s = make_state(r.chain);
  r.chain.doMotion(s);
  double x = 0, y = 0;
  for (const auto& name : r.contacts) x += std::abs(s.contact(name).point.x), y += std::abs(s.contact(name).point.y);
  CHECK((x == within(0.4, 1e-15) && y == within(0.8, 1e-15)));  // the corners, and not the middle

  const auto missing = leg("package://robot/meshes/no.stl");
  CHECK(missing.contacts.empty());
  CHECK(text_of(missing.warnings) == holding("contacts of 'foot': without contact, because the mesh is not found (!)"));
  at.write("meshes/foot.dae", "<COLLADA/>");
  CHECK(text_of(leg("meshes/foot.dae").warnings) == holding("a mesh must be an .stl, .obj or .msh file (!)"));
}

TEST_CASE("bad options of contacts are refused by name") {
  const auto why = [](const robot_options& o) { return complaint([&] { read(quadruped_urdf(), o); }); };
  CHECK(why(on("floor")) ==
        "kte: the robot 'quadruped' has no link or frame 'floor' for the ground (robot_options::contacts): its base is "
        "'trunk', or 'world' with robot_options::floating_base");
  auto o = floating();
  o.contacts.rim_points = 2;
  CHECK(why(o) == "kte: robot_options::contacts: rim_points must be 0 or from 3 to 64, got 2");
  o = floating(), o.contacts.friction = -1;
  CHECK(why(o) ==
        "kte: sphere_contact_3D (frame1 'world', frame2 'FL_foot', contact 'FL_foot.contact'): friction must be finite "
        "and not negative, got -1");
  o = floating(), o.contacts.compliant = {.stiffness = 1e5, .friction = 0.5};
  CHECK(why(o) == "kte: robot_options::contacts: the friction of compliant contacts is `friction`, beside `compliant`");
  o = floating(), o.contacts.compliant = {.stiffness = 1e5}, o.contacts.restitution = 0;
  CHECK(why(o) ==
        "kte: robot_options::contacts: compliant contacts have no coefficient of restitution: they have a dissipation");
}

}  // namespace contacts_test
