#include <kte/view/svg/topology.hpp>

#include <numeric>
#include <random>

#include "catch.hpp"
#include "io/scratch.hpp"
#include "view/svg_document.hpp"
#include "view/svg_scenes.hpp"

namespace svg_topology_test {

using namespace kte;
using test::read_svg;

/// A random tree with this number of joints, with a motor each, a spring from the first to the last body, and a loop.
scene random_tree(int joints, unsigned seed) {
  std::mt19937 random(seed);
  scene s;
  s.title = "tree of " + std::to_string(joints);
  s.frames.push_back({"world", -1, -1});
  for (int j = 0; j < joints; ++j) {
    const int before = std::uniform_int_distribution(j / 2, j)(random);
    const std::string name = "body_" + std::to_string(j) + std::string(random() % 8, 'x');
    s.frames.push_back({name, s.tracks++});
    s.coordinates.push_back({"q" + std::to_string(j), "angle", "rad", j, 1, j, 1});
    s.joints.push_back(
        {"joint_" + std::to_string(j), "revolute_joint_3D", "revolute", before, j + 1, true, {0, 0, 1}, {j}});
    s.bodies.push_back({"", j + 1, 1});
    s.forces.push_back({"", "dc_motor_gen", "motor", {}, {j}});
  }
  s.forces.push_back({"", "spring_3D", "spring", {1, joints}, {}});
  s.joints.push_back({"closure", "revolute_joint_3D", "revolute", joints / 2, joints, true, {0, 0, 1}, {}});
  return s;
}
struct rectangle {
  double left, right, low, high;
};
std::vector<rectangle> boxes(const test::svg_element& root) {
  std::vector<rectangle> all;
  for (const auto* e : root.all("rect"))
    if ((*e)["stroke"] != "")
      all.push_back(
          {e->number("x"), e->number("x") + e->number("width"), e->number("y"), e->number("y") + e->number("height")});
  return all;
}

TEST_CASE("trees are tidy: parents over the middle of their children, nothing over anything") {
  using detail::svg::tidy_tree;
  std::mt19937 random(7);
  for (int round = 0; round < 20; ++round) {
    std::vector<tidy_tree::node> nodes(40);
    std::vector<std::size_t> roots{0};
    for (std::size_t i = 1; i < nodes.size(); ++i) {
      if (i < 3)
        roots.push_back(i);
      else
        nodes[random() % i].children.push_back(i);
      nodes[i].left = 1 + static_cast<double>(random() % 5), nodes[i].right = 1 + static_cast<double>(random() % 9);
    }
    const auto laid = tidy_tree(nodes, roots, 0.5).nodes();
    for (std::size_t i = 0; i < laid.size(); ++i) {
      CHECK(laid[i].x - laid[i].left >= -1e-9);
      const auto& c = laid[i].children;
      if (!c.empty()) CHECK(laid[i].x == within((laid[c.front()].x + laid[c.back()].x) / 2, 1e-9));
      for (const auto k : c) CHECK(laid[k].layer == laid[i].layer + 1);
      for (std::size_t k = 0; k < i; ++k)
        if (laid[k].layer == laid[i].layer)
          CHECK((laid[k].x + laid[k].right + 0.5 <= laid[i].x - laid[i].left + 1e-9 ||
                 laid[i].x + laid[i].right + 0.5 <= laid[k].x - laid[k].left + 1e-9));
    }
  }
}

TEST_CASE("a topology has a box for what moves as one, a letter for each joint, arcs for what is beside the tree") {
  const auto root = read_svg(topology_picture(test::double_pendulum()));
  CHECK(boxes(root).size() == 3);
  const auto texts = root.texts("text");
  for (const char* x : {"ground", "upper", "rod", "R", "q1", "q2", "driving_actuator_gen", "spring_2D", "damper_2D"})
    CHECK(std::find(texts.begin(), texts.end(), x) != texts.end());
  std::size_t arcs = 0;
  for (const auto* p : root.all("path")) arcs += (*p)["stroke-dasharray"] != "";
  CHECK(arcs == 2);
  CHECK(root.children[1].text ==
        "upper on ground by q1 (revolute). rod on upper by q2 (revolute). spring_2D between ground and upper. "
        "damper_2D between ground and rod. ");
}

TEST_CASE("letters of joints are those of the theory of mechanisms") {
  const auto texts = read_svg(topology_picture(test::all_joints())).texts("text");
  std::string letters;
  for (const auto& t : texts)
    if (t.size() == 1) letters += t;
  CHECK(letters == "RPHCUSE=?F");
}

TEST_CASE("thirty joints are laid out such that no boxes overlap, within the picture") {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const auto s = random_tree(30, seed);
    const auto root = read_svg(topology_picture(s));
    const auto all = boxes(root);
    REQUIRE(all.size() == 31);
    const double width = std::stod(root["width"]), height = std::stod(root["height"]);
    for (std::size_t i = 0; i < all.size(); ++i) {
      CHECK(all[i].left >= 0);
      CHECK(all[i].right <= width);
      CHECK(all[i].high <= height);
      for (std::size_t k = 0; k < i; ++k)
        CHECK((all[i].left >= all[k].right || all[k].left >= all[i].right || all[i].low >= all[k].high ||
               all[k].low >= all[i].high));
    }
    CHECK(topology_picture(s).find(">closure<") != std::string::npos);
  }
}

TEST_CASE("a topology is made to fit a width, of any names, of nothing at all") {
  CHECK(read_svg(topology_picture(random_tree(30, 1), {.width = 170}))["width"] == "170mm");
  CHECK(read_svg(topology_picture({})).texts("text") == std::vector<std::string>{"ground"});
  auto s = random_tree(3, 1);
  s.title = "<&>", s.frames[1].name = std::string(10000, 'n'), s.joints[1].name = "\"<\x01\xFF>", s.frames[2].name = "";
  const auto text = topology_picture(s);
  CHECK(read_svg(text).children[0].text == "<&>");
  CHECK(text.size() < 40000);
  CHECK(test::message_of<bad_argument>([&] { (void)topology_picture(s, {.width = -1}); }) ==
        "kte: the topology needs letters of 1 to 100 points and a width of 0 to 5000 mm");
  s.joints[0].after = 99;
  CHECK(test::message_of<bad_argument>([&] { (void)topology_picture(s); }) ==
        "kte: a part of a scene is on a frame that does not exist");
  const test::scratch file(".svg");
  write_topology(file.path, test::double_pendulum());
  CHECK(file.text() == topology_picture(test::double_pendulum()));
}

}  // namespace svg_topology_test
