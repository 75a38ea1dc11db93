#include <kte/robots/load_robot.hpp>

#include <fstream>

#include "catch.hpp"

namespace sdf_include_test {

using namespace kte;
using test::says;
namespace fs = std::filesystem;

/// A folder of files, removed in the end.
struct folder {
  folder() : path(fs::temp_directory_path() / ("kte_sdf_include_" + std::to_string(counter++))) {
    fs::remove_all(path), fs::create_directories(path);
  }
  ~folder() { fs::remove_all(path); }
  folder(const folder&) = delete;
  folder& operator=(const folder&) = delete;
  std::string write(const std::string& name, const std::string& text) const {
    fs::create_directories((path / name).parent_path());
    std::ofstream(path / name) << text;
    return (path / name).string();
  }
  fs::path path;
  static inline int counter = 0;
};

std::string sdf(const std::string& inside, const std::string& version = "1.11") {
  return "<sdf version='" + version + "'>" + inside + "</sdf>";
}
std::string model(const std::string& inside) { return sdf("<model name='m'>" + inside + "</model>"); }
std::string include(const std::string& uri, const std::string& rest = "") {
  return "<include><uri>" + uri + "</uri>" + rest + "</include>";
}
std::string joint(const std::string& name, const std::string& parent, const std::string& child) {
  return "<joint name='" + name + "' type='fixed'><parent>" + parent + "</parent><child>" + child + "</child></joint>";
}
bool has(const std::vector<robot_note>& notes, const std::string& text, bool moves = false) {
  for (const auto& n : notes)
    if (n.text.find(text) != std::string::npos && n.changes_motion == moves) return true;
  return false;
}
const std::string arm =
    "<model name='arm'><pose>9 0 0 0 0 0</pose><link name='a'/><link name='b'><pose>0 0 1 0 0 0</pose>"
    "</link><joint name='j' type='revolute'><parent>a</parent><child>b</child><axis><xyz>0 1 0</xyz></axis>"
    "</joint></model>";

TEST_CASE("included models stand where the include says") {
  const folder f;
  f.write("models/arm/model.config",
          "<model><sdf version='1.4'>old.sdf</sdf><sdf version='1.11'>new.sdf</sdf><sdf "
          "version='1.99'>far.sdf</sdf></model>");
  f.write("models/arm/new.sdf", sdf(arm));
  f.write("models/arm/old.sdf", "<sdf");
  f.write("models/plain/model.sdf", sdf(arm));
  f.write("models/lamp/model.sdf", sdf("<light name='sun'/>"));
  const auto read = [&](const std::string& inside) { return load_sdf(f.write("robots/r/r.sdf", model(inside))); };
  const std::string base = "<link name='base'/>";
  auto d = read(base + include("model://arm", "<name>left</name><pose relative_to='base'>0 2 0 0 0 0</pose>") +
                joint("k", "base", "left::a"));
  CHECK((d.links[1].name == "left::a" && d.links[2].name == "left::b" && d.joints[0].name == "left::j"));
  CHECK(d.links[1].file == (f.path / "models/arm/new.sdf").string());
  CHECK(d.joints[1].origin.position == vec3<>{0, 2, 0});
  CHECK((!d.warnings.empty() && d.warnings[1].file == d.links[1].file));
  d = read(base + include("model://plain") + joint("k", "base", "arm::a"));
  CHECK(d.joints[1].origin.position == vec3<>{9, 0, 0});
  CHECK(read(base + include(" ../../models/plain/model.sdf ") + joint("k", "base", "arm")).joints.size() == 2);
  CHECK(read(base + include("file://" + (f.path / "models/plain/model.sdf").string()) + joint("k", "base", "arm"))
            .joints.size() == 2);
  d = read(base + include("model://arm", "<placement_frame>b</placement_frame><pose>0 0 5 0 0 0</pose>") +
           joint("k", "base", "arm::b"));
  CHECK(d.joints[1].origin.position == vec3<>{0, 0, 5});
  d = read(base + include("model://arm", "<static>1</static>") + joint("k", "base", "arm::a"));
  CHECK(std::none_of(d.joints.begin(), d.joints.end(),
                     [](const auto& j) { return j.is == robot_joint::kind::revolute; }));
  d = read(base + include("model://lamp") + include("model://arm", "<plugin name='drive' filename='joint'/>") +
           joint("k", "base", "arm::a"));
  CHECK(has(d.not_read, "light 'sun': not read"));
  CHECK(has(d.warnings, "plugins that act on joints are not read: 'drive'", true));
}

TEST_CASE("what is merged has the names of the model around it, and its own place") {
  const folder f;
  f.write("arm/model.sdf", sdf(arm));
  const auto d =
      load_sdf(f.write("r.sdf", model("<link name='base'/><include merge='true'><uri>arm</uri><pose>0 3 0 0 0 0</pose>"
                                      "</include>" +
                                      joint("k", "base", "b"))));
  CHECK((d.links[1].name == "a" && d.links[2].name == "b" && d.joints[0].name == "j"));
  CHECK(d.joints[1].origin.position == vec3<>{0, 3, 1});
}

TEST_CASE("older files that are included keep their meaning") {
  const folder f;
  const std::string turned = "<pose>0 0 0 1.5707963267948966 0 0</pose>";
  f.write("old/model.sdf", sdf("<model name='old'><link name='a'/><link name='b'>" + turned +
                                   "</link><joint name='j' type='revolute'>"
                                   "<parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz></axis></joint></model>",
                               "1.4"));
  const auto d = load_sdf(f.write("r.sdf", model(include("old", turned))));
  CHECK(d.joints[0].axis == vec3<>{0, 1, 0});
}

TEST_CASE("worlds with included models") {
  const folder f;
  f.write("arm/model.sdf", sdf(arm));
  f.write("floor/model.sdf", sdf("<model name='floor'><static>true</static><link name='l'/></model>"));
  const auto world = [&](const std::string& inside) {
    return f.write("w.sdf", sdf("<world name='w'>" + inside + "</world>"));
  };
  auto path = world(include("model://floor") + include("model://arm", "<name>robot</name>") + include("model://sun"));
  CHECK(kte::models(path) == std::vector<std::string>{"floor", "robot", "sun"});
  auto r = load_robot(path);
  CHECK((r.name == "robot" && r.chain.dofs() == 1));
  CHECK(has(r.warnings, "model 'sun', which is not the robot, cannot be read: kte: " + path +
                            ":1: world 'w': <uri>: 'model://sun' is "
                            "not found"));
  CHECK(load_robot(path, {.model = "floor"}).chain.dofs() == 0);
  CHECK_THROWS_MATCHES(load_robot(path, {.model = "sun"}), bad_file, says("'model://sun' is not found"));
  path = world(include("https://example.org/models/Sun") + include("model://arm"));
  CHECK(load_robot(path).chain.dofs() == 1);
  CHECK_THROWS_MATCHES(load_robot(path, {.model = "Sun"}), bad_file, says("is not on this machine"));
  CHECK(kte::models(f.write("a.urdf", "<robot name='u'><link name='a'/></robot>")) == std::vector<std::string>{"u"});
}

TEST_CASE("a world may include a URDF") {
  const folder f;
  f.write("arm/model.sdf",
          "<robot name='arm'><link name='base'/><link name='tip'><inertial><mass value='2'/><inertia ixx='1' iyy='1' "
          "izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link><joint name='j' type='continuous'><parent link='base'/>"
          "<child link='tip'/></joint></robot>");
  const auto read = [&](const std::string& inside, const robot_options& o = {}) {
    return load_robot(f.write("w.sdf", sdf("<world name='w'><gravity>0 0 -3</gravity>" + include("arm", inside) +
                                           "<model name='floor'><static>1</static><link "
                                           "name='l'/></model></world>")),
                      o);
  };
  auto r = read("<name>mine</name>");
  CHECK((r.name == "mine" && r.chain.dofs() == 1 && r.chain.gravity() == vec3<>{0, 0, -3}));
  CHECK(read("", {.model = "arm"}).chain.dofs() == 1);
  CHECK(has(read("<pose>1 0 0 0 0 0</pose>").warnings, "its pose in the world is not read: it is a URDF", true));
}

TEST_CASE("includes that cannot be had are refused by name") {
  const folder f, elsewhere;
  elsewhere.write("hand/model.sdf", sdf("<model name='hand'><link name='h'/></model>"));
  const auto read = [&](const std::string& inside, const robot_options& o = {}) {
    return load_sdf(f.write("r.sdf", model(inside)), o);
  };
  const auto refused = [&](const std::string& inside, const std::string& why) {
    CHECK_THROWS_MATCHES(read(inside), bad_file, says(why));
  };
  refused(include("model://hand"), "<uri>: 'model://hand' is not found, neither in the folders around");
  CHECK(read(include("model://hand"), {.search_path = {elsewhere.path.string()}}).links[0].name == "hand::h");
  refused(include("https://example.org/hand"), "<uri>: 'https://example.org/hand' is not on this machine: fetch it");
  f.write("empty/x.txt", "");
  refused(include("empty"), "'empty' is not found");
  f.write("urdf/model.sdf", "<robot/>");
  refused(include("urdf"), "'urdf' is a URDF: only a world or the file itself may include one");
  f.write("html/model.sdf", "<html/>");
  refused(include("html"), "'html' is not a file in SDF: it begins with <html>");
  f.write("two/model.sdf", sdf("<model name='a'/><model name='b'/>"));
  refused(include("two"), "has several models: a file to include has one");
  f.write("none/model.sdf", sdf("<world name='a'/>"));
  refused(include("none"), "has no model beside its worlds");
  refused(include("r.sdf"), "'r.sdf' includes itself, directly or through other files");
  f.write("x/model.sdf", model(include("y")));
  f.write("y/model.sdf", model(include("x")));
  refused(include("x"), "'x' includes itself, directly or through other files");
  f.write("leaf/model.sdf", sdf("<model name='leaf'><placement_frame/><link name='l'/></model>"));
  refused(include("leaf", "<placement_frame>l</placement_frame>"), "<placement_frame>: needs a <pose>");
  for (int i = 0; i < 40; ++i) {
    const auto next = "c" + std::to_string(i + 1) + ".sdf";
    f.write("c" + std::to_string(i) + ".sdf", model(include(next)));
  }
  refused(include("c0.sdf"), "files that include each other go deeper than 32");
  std::string twice = include("leaf", "<name>a</name>");
  for (int i = 0; i < 11; ++i) {
    const auto name = "d" + std::to_string(i) + ".sdf";
    f.write(name, model(twice));
    twice = include(name, "<name>a</name>") + include(name, "<name>b</name>");
  }
  refused(twice, "more than 1000 files are included");
}

}  // namespace sdf_include_test
