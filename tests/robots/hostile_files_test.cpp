#include <kte/contacts.hpp>
#include <kte/robots/load_robot.hpp>
#include <kte/robots/mjcf_reader.hpp>
#include <kte/robots/sdf_reader.hpp>
#include <kte/robots/urdf_reader.hpp>

#include "allocation_count.hpp"
#include "allocations.hpp"
#include "catch.hpp"
#include "robots/files.hpp"
#include "robots/folder.hpp"

// Small files that would take much memory, stack or time, or make readers look where nothing is: each is refused by
// name.

namespace hostile_files_test {

using namespace kte;
using test::folder;
using test::says;

robot_options touching() {
  robot_options o;
  o.contacts.ground = "world";
  return o;
}
/// 90 elements within each other.
std::string nested(const std::string& element, const std::string& inside) {
  std::string text = inside;
  for (int i = 0; i < 90; ++i)
    text = "<" + element + " name='n" + std::to_string(i) + "'>" + text + "</" + element + ">";
  return text;
}
void refuses(const std::string& text, const std::string& name, const std::string& why) {
  CHECK_THROWS_MATCHES(to_robot(describe_robot(text, name, touching()), touching()), bad_file, says(why));
}

TEST_CASE("sizes of height fields are whole numbers from 2, and those of their data") {
  const auto field = [](const std::string& rest) {
    return "<mujoco><asset><hfield name='h' size='1 1 1 1' " + rest +
           "/></asset><worldbody><geom type='hfield' hfield='h'/><body><geom size='1'/><freejoint/></body></worldbody>"
           "</mujoco>";
  };
  const auto refuses_field = [&](const std::string& rest, const std::string& why) {
    refuses(field(rest), "a.xml", why);
  };
  refuses_field("nrow='1.3333333333333333' ncol='3' elevation='0 0 0 1'",
                "nrow must be a whole number from 2 to 1000000, got 1.33");
  refuses_field("nrow='8' ncol='0.5' elevation='0 0 0 1'", "ncol must be a whole number from 2 to 1000000, got 0.5");
  refuses_field("nrow='-2' ncol='-2' elevation='0 0 0 1'", "nrow must be a whole number from 2 to 1000000, got -2");
  refuses_field("nrow='1e300' ncol='1e300' elevation='0 0 0 1'",
                "nrow must be a whole number from 2 to 1000000, got 1");
  refuses_field("nrow='2' ncol='3' elevation='0 0 0 1'", "elevation must have nrow ncol numbers");
  refuses_field("ncol='2' elevation='0 0 0 1'", "has no nrow");
  refuses_field("nrow='1' ncol='2'", "nrow must be a whole number from 2 to 1000000, got 1");

  // A field without data is level, whatever its size.
  const auto level = to_robot(describe_robot(field("nrow='100000' ncol='100000'"), "a.xml", touching()), touching());
  auto s = make_state(level.chain);
  level.chain.doMotion(s);
  CHECK(s.contact(level.contacts.at(0)).gap == -1);
}

TEST_CASE("contacts with one height field share its numbers") {
  constexpr std::size_t n = 200;
  const height_grid grid({0, 0, 1, 1, n}, std::vector<double>(n * n, 0.0));
  CHECK(allocations::during([&] { const height_grid copy = grid; }) == 0);

  const auto bytes_of = [&](int balls) {
    std::string text = "<mujoco><asset><hfield name='h' size='1 1 1 1' nrow='200' ncol='200' elevation='";
    for (std::size_t i = 0; i < n * n; ++i) text += "0 ";
    text += "'/></asset><worldbody><geom type='hfield' hfield='h'/><body><freejoint/>";
    for (int i = 0; i < balls; ++i) text += "<geom size='1' pos='" + std::to_string(i) + " 0 0'/>";
    text += "</body></worldbody></mujoco>";
    return allocations::bytes_during([&] { (void)to_robot(describe_robot(text, "a.xml", touching()), touching()); });
  };
  CHECK(bytes_of(20) - bytes_of(1) < 19 * static_cast<long long>(8 * n * n) / 2);  // of 19 further grids
}

TEST_CASE("shapes fitted to a mesh that is not there are refused") {
  for (const std::string type : {"sphere", "capsule", "ellipsoid", "cylinder", "box", "mesh"})
    for (const std::string rest : {"", "mass='1'", "density='10'"})
      refuses("<mujoco><worldbody><body><joint/><geom type='" + type + "' mesh='nope' " + rest +
                  "/></body></worldbody></mujoco>",
              "a.xml", "there is no mesh 'nope' among the assets");
}

TEST_CASE("included files of MJCF do not nest without end") {
  const folder at;
  std::string deep;
  for (int i = 0; i < 12; ++i)
    at.write("f" + std::to_string(i) + ".xml",
             "<mujoco>" + nested("frame", "<include file='f" + std::to_string(i + 1) + ".xml'/>") + "</mujoco>");
  at.write("f12.xml", "<mujoco/>");
  const auto path = at.write("a.xml", "<mujoco><worldbody><body><include file='f0.xml'/></body></worldbody></mujoco>");
  CHECK_THROWS_MATCHES(load_robot(path), bad_file, says("elements nest deeper than 500"));
}

TEST_CASE("included files of SDF do not multiply without end") {
  const folder at;
  const auto model = [](const std::string& inside) {
    return "<sdf version='1.9'><model name='m'><link name='l'/>" + inside + "</model></sdf>";
  };
  std::string links;
  for (int i = 0; i < 4000; ++i) links += "<link name='l" + std::to_string(i) + "'/>";
  at.write("leaf.sdf", model(links));
  std::string leaves;
  for (int i = 0; i < 80; ++i)
    leaves += "<include><name>c" + std::to_string(i) + "</name><uri>leaf.sdf</uri></include>";
  CHECK_THROWS_MATCHES(load_sdf(at.write("r.sdf", model(leaves))), bad_file,
                       says("included files have more than 300000 elements together"));

  for (int i = 0; i < 12; ++i)
    at.write("n" + std::to_string(i) + ".sdf",
             model(nested("model", "<include><uri>n" + std::to_string(i + 1) + ".sdf</uri></include>")));
  at.write("n12.sdf", model(""));
  CHECK_THROWS_MATCHES(load_sdf(at.write("s.sdf", model("<include><uri>n0.sdf</uri></include>"))), bad_file,
                       says("models nest deeper than 500"));
}

TEST_CASE("elements with thousands of attributes are refused before they are parsed") {
  std::string many;
  for (int i = 0; i < 1001; ++i) many += " a" + std::to_string(i) + "='<>=='";
  const std::string fine = "<robot name='r'><!-- " + many + " --><link name='b'";
  refuses("<robot name='r'>\n<link name='b'" + many + "/></robot>", "r.urdf",
          "r.urdf:2: an element has more than 1000 attributes");
  refuses("<mujoco>\n\n<worldbody" + many + "/></mujoco>", "a.xml",
          "a.xml:3: an element has more than 1000 attributes");
  CHECK(describe_robot(fine + "/></robot>", "r.urdf").links.size() == 1);
}

}  // namespace hostile_files_test
