#include <kte/view/svg/moving_picture.hpp>
#include <kte/view/svg/picture.hpp>

#include "catch.hpp"
#include "io/scratch.hpp"
#include "view/svg_document.hpp"
#include "view/svg_scenes.hpp"

namespace svg_picture_test {

using namespace kte;
using test::message_of;
using test::read_svg;
using test::svg_element;

/// The numbers of a text in their order, whatever stands between them.
std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> all;
  const char* p = text.c_str();
  while (*p != 0) {
    char* end{};
    const double x = std::strtod(p, &end);
    if (end == p) {
      ++p;
      continue;
    }
    all.push_back(x), p = end;
  }
  return all;
}
/// The numbers of the path "Mx yldx dy" of a line.
struct straight {
  double x, y, dx, dy;
  explicit straight(const std::string& d) {
    const auto n = numbers_in(d);
    REQUIRE(n.size() == 4);
    x = n[0], y = n[1], dx = n[2], dy = n[3];
  }
};
std::vector<const svg_element*> named(const svg_element& root, const std::string& name) {
  std::vector<const svg_element*> found;
  for (const char* tag : {"path", "circle"})
    for (const auto* e : root.all(tag))
      if (!e->children.empty() && e->children[0].text == name) found.push_back(e);
  return found;
}
/// mm for a metre, from the scale bar and its label.
double scale_of(const svg_element& root) {
  const auto text = root.all("text").back()->text;
  const auto bar = numbers_in((*root.all("path").back())["d"]);
  const double metres = std::stod(text) * (text.ends_with(" mm") ? 1e-3 : text.ends_with(" km") ? 1e3 : 1);
  REQUIRE(bar.size() == 8);
  return bar[4] / metres;
}

TEST_CASE("a mechanism at several times has a group for each, the last one darkest, at the poses of that time") {
  const auto s = test::double_pendulum();
  const auto root = read_svg(picture(s, {.times = {0, 0.5, 2}, .trails = {"tip"}, .labels = {"tip"}}));
  CHECK(root["width"] == "85mm");
  CHECK(root.children[0].text == "double pendulum");
  CHECK(root.children[1].text ==
        "At 3 times from 0 to 2 s. 2 bodies, 2 joints. Not drawn: driving_actuator_gen 'motor'.");
  const double scale = scale_of(root);
  std::vector<const svg_element*> groups;
  for (const auto* g : root.all("g"))
    if (g->children[0].text.starts_with("t = ")) groups.push_back(g);
  REQUIRE(groups.size() == 3);
  CHECK(groups[0]->number("opacity") == 0.2);
  CHECK(groups[1]->number("opacity") == 0.6);
  CHECK((*groups[2])["opacity"].empty());
  const double times[]{0, 0.5, 2};
  for (std::size_t i = 0; i < 3; ++i) {
    const double t = times[i], a = -1.5 + 0.7 * t, b = a + 0.9 * t;
    const auto links = named(*groups[i], "rigid_link_2D");
    REQUIRE(links.size() == 2);
    const straight upper((*links[0])["d"]), lower((*links[1])["d"]);
    CHECK(upper.dx == within(scale * std::cos(a), 0.015));
    CHECK(upper.dy == within(-scale * std::sin(a), 0.015));
    CHECK(lower.x == within(upper.x + upper.dx, 0.015));
    CHECK(lower.dx == within(0.8 * scale * std::cos(b), 0.015));
    CHECK(lower.dy == within(-0.8 * scale * std::sin(b), 0.015));
  }
  CHECK(named(root, "path of tip").size() == 1);
  CHECK(root.texts("text")[0] == "tip");
}

TEST_CASE("springs, dampers, joints, bodies and the ground have symbols, which may be left out") {
  const auto s = test::double_pendulum();
  const auto root = read_svg(picture(s));
  CHECK(named(root, "spring_2D").size() == 1);
  CHECK(named(root, "damper_2D").size() == 4);
  CHECK(named(root, "q1 (revolute_joint_2D)").size() == 1);
  CHECK(named(root, "1.5 kg").size() == 1);      // a point
  CHECK(named(root, "rod (1 kg)").size() == 2);  // its outline, and the line to its centre
  const auto grounds = [](const svg_element& r) {
    for (const auto* g : r.all("g"))
      if (g->children[0].text == "ground") return g->all("path").size();
    return std::size_t{0};
  };
  CHECK(grounds(root) == 2 * 8);  // base and wall
  const auto bare = read_svg(picture(s, {.bodies = false, .joints = false, .ground = false, .scale_bar = false}));
  CHECK(grounds(bare) == 0);
  CHECK(bare.all("path").size() == 2 + 1 + 4);
  CHECK(bare.all("circle").empty());
  CHECK(bare.all("text").empty());
}

TEST_CASE("the outline of a body is that of its ellipsoid, from any direction") {
  auto s = test::all_joints();
  s.bodies.resize(1);
  s.bodies[0].ellipsoid = {0.3, 0.2, 0.1}, s.bodies[0].centre = {}, s.frames[2].place = scene::at_origin;
  for (auto& r : s.recordings[0].rotations) r = 0;
  for (std::size_t i = 0; i < s.recordings[0].rotations.size(); i += 4) s.recordings[0].rotations[i] = 32767;
  const auto half_sizes = [&](const std::array<double, 3>& from) {
    const auto root = read_svg(picture(s, {.width = 170, .look_from = from}));
    const auto n = numbers_in((*named(root, "revolute (1 kg)").at(0))["d"]);
    double x = 0, y = 0, right = 0, high = 0, left = 0, low = 0;
    for (std::size_t i = 2; i + 5 < n.size(); i += 6) {  // ends of curves: where they are, steps later
      x += n[i + 4], y += n[i + 5];
      right = (std::max)(right, x), left = (std::min)(left, x), high = (std::max)(high, y), low = (std::min)(low, y);
    }
    const double scale = scale_of(root);
    return std::array{(right - left) / 2 / scale, (high - low) / 2 / scale};
  };
  const auto front = half_sizes({0, -1, 0}), side = half_sizes({1, 0, 0}), above = half_sizes({0, 0, 1});
  CHECK(front[0] == within(0.3, 2e-3));
  CHECK(front[1] == within(0.1, 2e-3));
  CHECK(side[0] == within(0.2, 2e-3));
  CHECK(side[1] == within(0.1, 2e-3));
  CHECK((std::max)(above[0], above[1]) == within(0.3, 2e-3));
  CHECK((std::min)(above[0], above[1]) == within(0.2, 2e-3));
}

TEST_CASE("joints of every kind are drawn in space, from every direction") {
  const auto s = test::all_joints();
  for (const std::array<double, 3> from :
       {std::array{1.0, -2.0, 0.8}, {0.0, 0.0, 1.0}, {0.3, 0.8, 0.52}, {0.0, 0.0, 0.0}, {1e-200, 0.0, 0.0}}) {
    const auto root = read_svg(picture(s, {.width = 170, .look_from = from}));
    for (const auto& j : s.joints) {
      const auto found = named(root, j.name + " (" + j.type + ")").size();
      CAPTURE(j.kind);
      CHECK((j.kind == "free" ? found == 0 : found > 0));
    }
    for (const auto* p : root.all("path")) CHECK((*p)["d"].find("nan") == std::string::npos);
  }
  auto turned = s;
  turned.gravity = {-9.81, 0, 0};
  CHECK(picture(turned) != picture(s));
}

TEST_CASE("what does not fit is refused by name") {
  const auto s = test::double_pendulum();
  CHECK(message_of<unknown_name>([&] { (void)picture(s, {.trails = {"tpi"}}); }) ==
        "kte: the picture has no frame 'tpi', did you mean 'tip'?");
  CHECK(message_of<unknown_name>([&] { (void)picture(s, {.labels = {"hand"}}); }) ==
        "kte: the picture has no frame 'hand': there are 'base', 'upper', 'elbow', 'lower', 'tip', 'wall'");
  CHECK(message_of<bad_argument>([&] {
          (void)picture(s, {.times = {0, 2.5}});
        }) == "kte: a picture at 2.5 s of a recording from 0 to 2 s");
  CHECK(message_of<bad_argument>([&] { (void)picture(s, {.times = {std::nan("")}}); }) != "");
  CHECK(message_of<bad_argument>([&] { (void)picture(s, {.times = {1}, .every = 1}); }) ==
        "kte: a picture has either `times` or `every`, not both");
  CHECK(message_of<bad_argument>([&] { (void)picture(s, {.every = 1e-9}); }) ==
        "kte: a picture every 1e-09 s has more than 1000 positions of the mechanism");
  CHECK(message_of<bad_argument>([&] { (void)picture(s, {.every = -1}); }) != "");
  CHECK(message_of<bad_argument>([&] { (void)picture(s, {.from = 3}); }) ==
        "kte: the recording of the picture is from 0 to 2 s, and none of it between 3 and inf");
  CHECK(message_of<bad_argument>([&] { (void)picture(s, {.recording = 1}); }) ==
        "kte: a picture of recording 1 of a scene that has 1");
  CHECK(message_of<bad_argument>([&] { (void)picture(s, {.width = 1}); }) != "");
  CHECK(message_of<bad_argument>([&] { (void)picture(s, {.most_height = 5}); }) != "");
  CHECK(message_of<bad_argument>([&] { (void)picture(s, {.palest = 2}); }) != "");
  CHECK(message_of<bad_argument>([] { (void)picture({}); }) == "kte: a picture of recording 0 of a scene that has 0");
  auto cut = s;
  cut.recordings[0].positions.pop_back();
  CHECK(message_of<bad_argument>([&] { (void)picture(cut); }) ==
        "kte: a recording of a scene needs a pose of each track at each time");
  auto wrong = s;
  wrong.frames[2].parent = 7;
  CHECK(message_of<bad_argument>([&] { (void)picture(wrong); }) ==
        "kte: the frame 'elbow' of a scene has a track or a parent that is not there");
  wrong = s, wrong.links[0].to = 9;
  CHECK(message_of<bad_argument>([&] { (void)picture(wrong); }) ==
        "kte: a part of a scene is on a frame that does not exist");
}

TEST_CASE("scenes of no extent, of no parts, and of great and small sizes are drawn") {
  scene s;
  s.recordings.emplace_back();
  s.recordings[0].t = {0};
  CHECK(read_svg(picture(s)).all("svg").size() == 1);
  for (const double size : {1e-9, 1e-3, 1.0, 1e3, 1e12}) {
    auto big = test::double_pendulum();
    for (auto& f : big.frames)
      for (std::size_t i = 0; i < 3; ++i) f.place[i] *= size;
    for (auto& x : big.recordings[0].positions) x *= static_cast<float>(size);
    big.bodies.clear(), big.size *= size;
    const auto root = read_svg(picture(big));
    CHECK(std::stod(root["height"]) == within(std::stod(read_svg(picture(test::double_pendulum()))["height"]), 6));
  }
  CHECK(read_svg(picture(test::double_pendulum(), {.most_height = 40}))["height"] == "40mm");
}

TEST_CASE("hostile names of frames and elements do no harm") {
  const std::string bad = "</title><script>\"&\x01\xFF";
  auto s = test::double_pendulum();
  s.title = bad, s.frames[4].name = bad, s.joints[0].name = bad, s.bodies[1].name = bad, s.links[0].type = bad,
  s.forces[2].name = bad;
  for (const auto& text : {picture(s, {.trails = {bad}, .labels = {bad}}), moving_picture(s, {.trails = {bad}})})
    CHECK(read_svg(text).all("script").empty());
}

TEST_CASE("a moving picture has the positions of all times, and fades where its end is not its beginning") {
  auto s = test::double_pendulum();
  const auto text = moving_picture(s, {.trails = {"tip"}, .rate = 10});
  const auto root = read_svg(text);
  CHECK(text.find("<script") == std::string::npos);
  CHECK(root.children[1].text.starts_with("Moving for 2 s, again and again. "));
  const double scale = scale_of(read_svg(picture(s, {.times = {0}, .trails = {"tip"}})));
  CHECK(scale > 0);
  const auto links = named(root, "rigid_link_2D");
  REQUIRE(links.size() == 2);
  const auto* animation = links[0]->all("animate").at(0);
  CHECK((*animation)["attributeName"] == "d");
  CHECK((*animation)["dur"] == "2s");
  CHECK((*animation)["repeatCount"] == "indefinite");
  std::vector<straight> at;
  std::string values = (*animation)["values"] + ";";
  for (std::size_t i = 0; i < values.size(); i = values.find(';', i) + 1)
    at.emplace_back(values.substr(i, values.find(';', i) - i));
  REQUIRE(at.size() == 21);
  const double length = std::hypot(at[0].dx, at[0].dy);
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double a = -1.5 + 0.07 * static_cast<double>(i);
    CHECK(at[i].dx == within(length * std::cos(a), 0.02));
    CHECK(at[i].dy == within(-length * std::sin(a), 0.02));
  }
  const auto fades = [](const svg_element& r) {
    for (const auto* a : r.all("animate"))
      if ((*a)["attributeName"] == "opacity") return true;
    return false;
  };
  CHECK(fades(root));
  auto& r = s.recordings[0];  // there and back
  for (std::size_t i = r.t.size() - 1; i-- > 0;) {
    r.t.push_back(4 - r.t[i]);
    for (std::size_t k = 0; k < 6; ++k) r.positions.push_back(r.positions[6 * i + k]);
    for (std::size_t k = 0; k < 8; ++k) r.rotations.push_back(r.rotations[8 * i + k]);
  }
  CHECK_FALSE(fades(read_svg(moving_picture(s))));
  CHECK(read_svg(moving_picture(s, {.speed = 0.5})).children[1].text.starts_with("Moving for 8 s"));
  CHECK(read_svg(moving_picture(s, {.from = 1, .to = 2})).children[1].text.starts_with("Moving for 1 s"));
}

TEST_CASE("a moving picture of one time, or of chosen times, is refused") {
  CHECK(message_of<bad_argument>([] { (void)moving_picture(test::all_joints()); }) ==
        "kte: a moving picture needs a recording of some duration");
  const auto s = test::double_pendulum();
  CHECK(message_of<bad_argument>([&] { (void)moving_picture(s, {.every = 1}); }) ==
        "kte: a moving picture shows all times: .from and .to say which, not .times or .every");
  CHECK(message_of<bad_argument>([&] { (void)moving_picture(s, {.rate = 0}); }) != "");
  CHECK(message_of<bad_argument>([&] { (void)moving_picture(s, {.rate = 1e9}); }) != "");
}

TEST_CASE("pictures are written into files") {
  const auto s = test::double_pendulum();
  const test::scratch file(".svg");
  write_picture(file.path, s, {.every = 1});
  CHECK(file.text() == picture(s, {.every = 1}));
  write_moving_picture(file.path, s);
  CHECK(file.text() == moving_picture(s));
}

}  // namespace svg_picture_test
