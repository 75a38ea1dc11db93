#include <kte/io/model_file.hpp>
#include <kte/kte.hpp>
#include <kte/robots/check_robot.hpp>
#include <kte/robots/load_robot.hpp>
#include <kte/robots/mjcf_writer.hpp>
#include <kte/robots/motors.hpp>
#include <kte/robots/urdf_writer.hpp>

#include "allocations.hpp"
#include "growth/counted.hpp"
#include "robots/files.hpp"
#include "robots/folder.hpp"

// The operations of readers grow no faster than n log n with a file of n parts.

namespace readers_test {

using namespace kte;
using growth::grows_linearly;
using test::folder;
using test::heavy;
using test::joint_text;

const robot_options touching{.contacts = {.ground = "world"}};

void make(const std::string& text, const std::string& name, const robot_options& o = {}) {
  (void)to_robot(describe_robot(text, name, o), o);
}
/// `part(i)` for i below n, one after another.
std::string each(int n, const std::function<std::string(const std::string&, int)>& part) {
  std::string all;
  for (int i = 0; i < n; ++i) all += part(std::to_string(i), i);
  return all;
}
/// The name of the parent of part i in a chain, a star and a binary tree, for which `root` stands first.
using parent_of = std::string (*)(int);
std::string in_chain(int i) { return i == 0 ? "root" : "l" + std::to_string(i - 1); }
std::string in_star(int) { return "root"; }
std::string in_tree(int i) { return i == 0 ? "root" : "l" + std::to_string((i + 1) / 2 - 1); }
constexpr std::pair<const char*, parent_of> shapes[]{{"chain", in_chain}, {"star", in_star}, {"tree", in_tree}};

std::string urdf_of(int n, parent_of parent, const std::string& type = "continuous") {
  return heavy("root") +
         each(n, [&](const auto& i, int k) { return heavy("l" + i) + joint_text("j" + i, type, parent(k), "l" + i); });
}

TEST_CASE("joints and materials of URDF") {
  for (const auto& [name, parent] : shapes)
    grows_linearly(name, [parent = parent](int n) {
      make(test::urdf(each(n, [](const auto& i,
                                 int) { return "<material name='m" + i + "'><color rgba='1 0 0 1'/></material>"; }) +
                      urdf_of(n, parent) +
                      each(n,
                           [](const auto& i, int) {
                             return "<link name='look" + i +
                                    "'><visual><geometry><sphere radius='1'/></geometry><material "
                                    "name='m" +
                                    i + "'/></visual></link>" + joint_text("f" + i, "fixed", "l" + i, "look" + i);
                           })),
           "r.urdf");
    });
}

TEST_CASE("universal joints, transmissions, frames, frictions and closures of URDF") {
  grows_linearly("universal joints", [](int n) { make(test::urdf(urdf_of(n, in_star, "universal")), "r.urdf"); });
  grows_linearly("followers", [](int n) {
    make(test::urdf(urdf_of(1, in_star) + heavy("root2") + joint_text("k", "fixed", "root", "root2") +
                    each(n,
                         [](const auto& i, int k) {
                           return heavy("f" + i) +
                                  joint_text("g" + i, "continuous", "root", "f" + i,
                                             "<mimic joint='" + (k == 0 ? "j0" : "g" + std::to_string(k - 1)) + "'/>");
                         })),
         "r.urdf");
  });
  grows_linearly("transmissions and motors", [](int n) {
    const auto text = test::urdf(urdf_of(n, in_star) + each(n, [](const auto& i, int) {
                                   return "<transmission name='t" + i + "'><joint name='j" + i +
                                          "'/><actuator name='a" + i + "'/></transmission>";
                                 }));
    auto r = to_robot(describe_robot(text, "r.urdf"));
    add_motors(r);
    REQUIRE(r.motors.size() == static_cast<std::size_t>(n));
  });
  grows_linearly("frames", [](int n) {
    make(test::urdf(
             urdf_of(n, in_star) +
             each(n, [](const auto& i, int) { return "<frame name='x" + i + "' link='l" + i + "' xyz='1 0 0'/>"; })),
         "r.urdf");
  });
  grows_linearly("closures", [](int n) {
    make(test::urdf(urdf_of(2 * n, in_star) + each(n,
                                                   [](const auto& i, int k) {
                                                     return "<kte:loop name='pin" + i + "' type='ball'><link1 link='l" +
                                                            i + "'/><link2 link='l" + std::to_string(k + 1) +
                                                            "'/></kte:loop>";
                                                   })),
         "r.urdf");
  });
  grows_linearly("contacts and their frictions", [](int n) {
    make(test::urdf("<link name='world'/>" +
                    each(n,
                         [](const auto& i, int) {
                           return "<link name='l" + i +
                                  "'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' "
                                  "iyz='0'/></inertial><collision><geometry><sphere radius='1'/></geometry></collision>"
                                  "<collision><geometry><mesh filename='none.stl'/></geometry></collision></link>" +
                                  joint_text("j" + i, "continuous", "world", "l" + i) + "<gazebo reference='l" + i +
                                  "'><mu1>0.5</mu1></gazebo>";
                         })),
         "r.urdf", touching);
  });
}

std::string mjcf(const std::string& world, const std::string& rest = "") {
  return "<mujoco>" + rest + "<worldbody>" + world + "</worldbody></mujoco>";
}
std::string mjcf_body(const std::string& i, const std::string& inside = "") {
  return "<body name='b" + i + "' pos='0 0 1'><joint name='j" + i + "'/><geom name='g" + i + "' size='1'/>" + inside +
         "</body>";
}
std::string mjcf_tree(int i, int n) {
  return i >= n ? "" : mjcf_body(std::to_string(i), mjcf_tree(2 * i + 1, n) + mjcf_tree(2 * i + 2, n));
}
const auto mjcf_star = [](int n) { return each(n, [](const auto& i, int) { return mjcf_body(i); }); };

TEST_CASE("bodies, defaults, materials, meshes and sites of MJCF") {
  grows_linearly("star", [](int n) { make(mjcf(mjcf_star(n)), "a.xml"); });
  grows_linearly("tree", [](int n) { make(mjcf(mjcf_tree(0, n)), "a.xml"); });
  grows_linearly("materials and meshes", [](int n) {
    make(mjcf(each(n,
                   [](const auto& i, int) {
                     return "<body><joint/><geom type='mesh' mesh='m" + i + "' material='p" + i + "'/></body>";
                   }),
              "<asset>" +
                  each(n,
                       [](const auto& i, int) {
                         return "<mesh name='m" + i + "' vertex='0 0 0  1 0 0  0 1 0  0 0 1'/><material name='p" + i +
                                "' rgba='1 0 0 1'/>";
                       }) +
                  "</asset>"),
         "a.xml");
  });
  grows_linearly("classes", [](int n) {
    make(mjcf(each(n, [](const auto& i, int) { return "<body><joint class='c" + i + "'/><geom size='1'/></body>"; }),
              "<default>" +
                  each(n, [](const auto& i,
                             int) { return "<default class='c" + i + "'><joint damping='1'/></default>"; }) +
                  "</default>"),
         "a.xml");
  });
  grows_linearly("sites", [](int n) {
    make(mjcf("<body name='b'><joint/><geom size='1'/>" +
              each(n, [](const auto& i, int) { return "<site name='s" + i + "'/><site name='b'/>"; }) + "</body>"),
         "a.xml");
  });
}

TEST_CASE("constraints, actuators, contacts and keyframes of MJCF") {
  const auto bodies = [](int n, const std::string& rest) { make(mjcf(mjcf_star(n + 1), rest), "a.xml"); };
  grows_linearly("connect without names", [&](int n) {
    bodies(n, "<equality>" + each(n, [](const auto& i, int k) {
                return "<connect body1='b" + i + "' body2='b" + std::to_string(k + 1) + "' anchor='0 0 0'/>";
              }) + "</equality>");
  });
  grows_linearly("connect at sites", [](int n) {
    make(mjcf("<body><joint/><geom size='1'/>" +
                  each(n, [](const auto& i, int) { return "<site name='s" + i + "'/>"; }) +
                  "</body><body><joint/><geom size='1'/>" +
                  each(n, [](const auto& i, int) { return "<site name='t" + i + "'/>"; }) + "</body>",
              "<equality>" +
                  each(n, [](const auto& i,
                             int) { return "<connect name='c" + i + "' site1='s" + i + "' site2='t" + i + "'/>"; }) +
                  "</equality>"),
         "a.xml");
  });
  grows_linearly("coupled joints and actuators", [&](int n) {
    bodies(n,
           "<equality>" +
               each(n, [](const auto& i,
                          int k) { return "<joint joint1='j" + std::to_string(k + 1) + "' joint2='j" + i + "'/>"; }) +
               "</equality><actuator>" + each(n, [](const auto&, int) { return std::string("<motor joint='j0'/>"); }) +
               "</actuator>");
  });
  grows_linearly("pairs and exclusions", [](int n) {
    make(mjcf("<geom name='floor' type='plane' size='1 1 1'/>" + mjcf_star(n),
              "<contact>" +
                  each(n,
                       [](const auto& i, int) {
                         return "<pair geom1='floor' geom2='g" + i + "'/><exclude body1='b" + i + "' body2='b0'/>";
                       }) +
                  "</contact>"),
         "a.xml", touching);
  });
  grows_linearly("bodies that move freely", [](int n) {
    make(
        mjcf(each(n, [](const auto& i, int) { return "<body name='b" + i + "'><freejoint/><geom size='1'/></body>"; })),
        "a.xml", touching);
  });
  grows_linearly("keyframes", [&](int n) {
    bodies(n, "<keyframe><key qpos='" + each(n + 1, [](const auto&, int) { return std::string("0 "); }) +
                  "'/></keyframe>");
  });
}

TEST_CASE("replicate, attach and include of MJCF") {
  const folder at;
  grows_linearly("replicate", [](int n) {
    make(mjcf("<replicate count='" + std::to_string(n) + "' offset='1 0 0'>" + mjcf_body("") + "</replicate>"),
         "a.xml");
  });
  grows_linearly("attach", [&](int n) {
    at.write("m.xml", "<mujoco model='m'><worldbody>" + mjcf_star(n) + "</worldbody></mujoco>");
    const auto path = at.write("a.xml", mjcf("<replicate count='" + std::to_string(n) + "'><attach model='m' body='b" +
                                                 std::to_string(n - 1) + "' prefix='p'/></replicate>",
                                             "<asset><model name='m' file='m.xml'/></asset>"));
    CHECK(load_mjcf(path).links.size() == static_cast<std::size_t>(n + 1));
  });
  grows_linearly(
      "include",
      [&](int n) {
        for (int i = 0; i < n; ++i)
          at.write("i" + std::to_string(i) + ".xml", "<mujoco>" + mjcf_body(std::to_string(i)) + "</mujoco>");
        (void)load_mjcf(
            at.write("a.xml", mjcf(each(n, [](const auto& i, int) { return "<include file='i" + i + ".xml'/>"; }))));
      },
      50);
}

std::string sdf(const std::string& inside) { return "<sdf version='1.9'><model name='m'>" + inside + "</model></sdf>"; }
std::string sdf_joint(const std::string& name, const std::string& parent, const std::string& child,
                      const std::string& type = "revolute", const std::string& rest = "") {
  return "<joint name='" + name + "' type='" + type + "'><parent>" + parent + "</parent><child>" + child +
         "</child><axis><xyz>0 1 0</xyz></axis>" + rest + "</joint>";
}
std::string sdf_of(int n, parent_of parent, const std::string& type = "revolute", const std::string& rest = "") {
  return "<link name='root'/>" + each(n, [&](const auto& i, int k) {
           return "<link name='l" + i + "'><pose relative_to='" + parent(k) + "'>0 0 1 0 0 0</pose></link>" +
                  sdf_joint("j" + i, parent(k), "l" + i, type, rest);
         });
}

TEST_CASE("links, joints and frames of SDF") {
  for (const auto& [name, parent] : shapes)
    grows_linearly(name, [parent = parent](int n) { make(sdf(sdf_of(n, parent)), "m.sdf"); });
  for (const std::string refers : {"attached_to", "relative_to"})
    grows_linearly("chained frames, " + refers, [&](int n) {
      const auto d = describe_robot(
          sdf("<link name='f-1'/>" + each(n,
                                          [&](const auto& i, int k) {
                                            const auto by = " " + refers + "='f" + std::to_string(k - 1) + "'";
                                            const bool in_pose = refers == "relative_to";
                                            return "<frame name='f" + i + "'" + (in_pose ? "" : by) + "><pose" +
                                                   (in_pose ? by : "") + ">0 0 1 0 0 0</pose></frame>";
                                          })),
          "m.sdf");
      REQUIRE(d.frames.size() == static_cast<std::size_t>(n));
      double highest = 0;
      for (const auto& f : d.frames) highest = (std::max)(highest, f.origin.position.z);
      CHECK(highest == n);
    });
  grows_linearly("frames of many links", [](int n) {
    make(sdf(sdf_of(n, in_star) +
             each(n, [](const auto& i, int) { return "<frame name='x" + i + "' attached_to='l" + i + "'/>"; })),
         "m.sdf");
  });
  grows_linearly("joints of two axes",
                 [](int n) { make(sdf(sdf_of(n, in_star, "universal", "<axis2><xyz>1 0 0</xyz></axis2>")), "m.sdf"); });
  grows_linearly("gearboxes", [](int n) {
    make(sdf(sdf_of(2 * n, in_star) + each(n,
                                           [](const auto& i, int k) {
                                             const auto driven = "l" + std::to_string(2 * k + 1);
                                             return sdf_joint("g" + i, "l" + std::to_string(2 * k), driven, "gearbox",
                                                              "<axis2><xyz>0 1 0</xyz></axis2><gearbox_reference_body>"
                                                              "root</gearbox_reference_body>");
                                           })),
         "m.sdf");
  });
  grows_linearly("nested models", [](int n) {
    make(sdf("<link name='root'/>" + each(n,
                                          [](const auto& i, int) {
                                            return "<model name='m" + i +
                                                   "' placement_frame='l'><link name='l'/></model>" +
                                                   sdf_joint("j" + i, "root", "m" + i + "::l");
                                          })),
         "m.sdf");
  });
}

TEST_CASE("models of SDF that stand by their placement frames") {
  const auto model = [](const std::string& name, const std::string& to) {
    return "<model name='" + name + "' placement_frame='l'><pose relative_to='" + to + "'>0 0 2 0 0 0</pose>" +
           "<link name='l'><pose>0 0 1 0 0 0</pose></link></model>";
  };
  grows_linearly("one after another", [&](int n) {
    const auto d = describe_robot(
        sdf("<link name='root'/><frame name='m-1'/>" + each(n,
                                                            [&](const auto& i, int k) {
                                                              return model("m" + i, "m" + std::to_string(k - 1)) +
                                                                     sdf_joint("j" + i, "root", "m" + i + "::l");
                                                            })),
        "m.sdf");
    REQUIRE(d.joints.size() == static_cast<std::size_t>(n));
    CHECK(d.joints.back().child_pose.position.z == 0);
    CHECK(d.joints.back().origin.position.z == n + 1);  // each is 2 above the one before, less the 1 of its link
  });
}

TEST_CASE("includes and models of SDF") {
  const folder at;
  at.write("part.sdf", "<sdf version='1.9'><model name='p'><link name='l'/></model></sdf>");
  grows_linearly("includes", [&](int n) {
    (void)load_sdf(at.write("m.sdf", sdf("<link name='root'/>" + each(n, [](const auto& i, int) {
                                           return "<include><uri>part.sdf</uri><name>p" + i + "</name></include>";
                                         }))));
  });
  grows_linearly("models of a world", [](int n) {
    const auto text = "<sdf version='1.9'><world name='w'>" +
                      each(n, [](const auto& i, int) { return "<model name='m" + i + "'><link name='l'/></model>"; }) +
                      "</world></sdf>";
    CHECK_THROWS_AS(describe_robot(text, "w.sdf"), bad_file);
    (void)describe_robot(text, "w.sdf", {.model = "m" + std::to_string(n - 1)});
  });
}

TEST_CASE("attributes of an element, up to the number that is read") {
  for (const auto& [before, after, name] :
       {std::tuple{"<robot name='r'><link name='b'", "/></robot>", "r.urdf"},
        std::tuple{"<mujoco><worldbody><body name='b'", "/></worldbody></mujoco>", "a.xml"},
        std::tuple{"<sdf version='1.9'><model name='m'><link name='l'", "/></model></sdf>", "m.sdf"}})
    grows_linearly(
        name,
        [before = before, after = after, name = name](int n) {
          make(before + each(n, [](const auto& i, int) { return " a" + i + "='1'"; }) + after, name);
        },
        200);
}

TEST_CASE("writers of robots") {
  grows_linearly("actuators", [](int n) {
    const auto d = describe_robot(mjcf(mjcf_star(n), "<actuator>" +
                                                         each(n,
                                                              [](const auto& i, int k) {
                                                                return "<motor name='m" + i + "' joint='j" + i +
                                                                       "' gear='" + std::to_string(k + 1) + "'/>";
                                                              }) +
                                                         "</actuator>"),
                                  "a.xml");
    const robot_writing lossy{.lossy = true};
    (void)to_mjcf(d, lossy), (void)to_urdf(d, lossy);
  });
  grows_linearly("joints whose children stand elsewhere", [](int n) {
    const auto d =
        describe_robot(sdf("<link name='root'/>" + each(n,
                                                        [](const auto& i, int) {
                                                          return "<link name='l" + i + "'/>" +
                                                                 sdf_joint("j" + i, "root", "l" + i, "revolute",
                                                                           "<pose>0 0 1 0 0 0</pose>");
                                                        })),
                       "m.sdf");
    (void)to_mjcf(d), (void)to_urdf(d);
  });
  grows_linearly(
      "light bodies in each other",
      [](int n) {
        std::string all;
        for (int i = n; i-- > 0;)
          all += "<link name='l" + std::to_string(i) + "'/>" +
                 joint_text("j" + std::to_string(i), i % 2 == 0 ? "continuous" : "fixed", in_chain(i),
                            "l" + std::to_string(i));
        (void)to_mjcf(describe_robot(test::urdf(heavy("root") + all), "r.urdf"), {.lossy = true});
      },
      100);
  grows_linearly("balls with dampers, and weights that are borne, of chains", [](int n) {
    const auto r = to_robot(describe_robot(
        mjcf(each(
            n,
            [](const auto& i, int) {
              return "<body name='b" + i + "' gravcomp='1'><joint name='j" + i +
                     "' type='ball' damping='1' stiffness='2'/><inertial pos='0 0 1' mass='1' diaginertia='1 1 1'/>"
                     "</body>";
            })),
        "a.xml"));
    const auto d = describe(r);
    CHECK(std::count_if(d.links.begin(), d.links.end(), [](const auto& l) { return l.gravity_compensation == 1; }) ==
          n);
    CHECK(d.joints[0].dynamics.stiffness == 2);
  });
}

TEST_CASE("checks of robots, and model files") {
  for (const auto& [name, parent] : shapes) {
    if (parent == in_chain) continue;  // its check at random configurations is of 1000 joints behind each other
    grows_linearly(name, [parent = parent](int n) {
      const auto d = describe_robot(test::urdf(urdf_of(n, parent)), "r.urdf");
      (void)check_robot(d);
    });
  }
  grows_linearly("model files", [](int n) {
    const auto r = to_robot(describe_robot(test::urdf(urdf_of(n, in_tree)), "r.urdf"));
    const auto model = record_of(r.chain);
    CHECK(from_xml(to_xml(model)) == model);
    CHECK(from_json(to_json(model)) == model);
  });
}

}  // namespace readers_test
