#include <kte/io/table_reader.hpp>
#include <kte/view.hpp>

#include "catch.hpp"
#include "chain/models.hpp"
#include "io/scratch.hpp"

namespace mcap_test {

using namespace kte;
using kte::test::contains_text, kte::test::says, kte::test::scratch;

constexpr auto pendulum = models::pendulum.gravity(along_y(-9.81));

TEST_CASE("recordings as MCAP: a table that moves the chain again, and messages of Foxglove") {
  scene_recording rec(pendulum, {.columns = {"q", "tip/position"}});
  auto s = make_state(pendulum);
  for (int i = 0; i < 3; ++i) {
    set_positions(s, std::array{0.5 * i});
    pendulum.doMotion(s);
    rec.row(0.5 * i, s);
  }
  const scratch file(".mcap");
  write_mcap(file.path, rec);
  const auto t = read_table(file.path);
  CHECK(t.names == std::vector<std::string>{"t", "q", "tip/position/x", "tip/position/y"});
  CHECK(t["q"] == std::vector{0.0, 0.5, 1.0});
  const auto again = scene_of(pendulum, t).recordings.at(0);
  CHECK((again.q == rec.contents().recordings[0].q && again.columns.size() == 2));
  const auto text = file.text();
  for (const char* part :
       {"foxglove.FrameTransforms", "foxglove.SceneUpdate", "/tf_static", "/scene/lines",
        R"({"timestamp":{"sec":0,"nsec":500000000},"parent_frame_id":"origin","child_frame_id":"joint")",
        R"("parent_frame_id":"joint","child_frame_id":"tip","translation":{"x":0.5,"y":0,"z":0})",
        R"("frame_id":"tip","id":"tip")", R"("spheres":[{"pose":{"position":{"x":0,"y":0,"z":0})"})
    CHECK_THAT(text, contains_text(part));
}

TEST_CASE("the shapes of a scene as primitives of Foxglove") {
  auto s = scene_of(pendulum);
  for (const char* type : {"box", "sphere", "ellipsoid", "cylinder", "capsule", "plane", "mesh"}) {
    auto& x = s.shapes.emplace_back();
    x.frame = 1, x.type = type, x.size = {1, 2, 3};
  }
  s.shapes.back().mesh = 0;
  s.meshes.push_back({"m", {0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}});
  const scratch file(".mcap");
  write_mcap(file.path, s);
  const auto text = file.text();
  CHECK_THAT(text, contains_text(R"("size":{"x":1,"y":2,"z":3})") && contains_text(R"("size":{"x":2,"y":2,"z":2})") &&
                       contains_text(R"("size":{"x":2,"y":4,"z":6})") &&
                       contains_text(R"("size":{"x":2,"y":2,"z":2},"bottom_scale":1,"top_scale":1)"));
  CHECK_THAT(text, contains_text(
                       R"("points":[{"x":0,"y":0,"z":0},{"x":1,"y":0,"z":0},{"x":0,"y":1,"z":0}],"indices":[0,1,2])"));
  for (const char* cap : {R"("position":{"x":0,"y":0,"z":-1})", R"("position":{"x":0,"y":0,"z":1})"})
    CHECK_THAT(text, contains_text(cap));
}

TEST_CASE("what MCAP cannot hold is refused") {
  const scratch file(".mcap", "before");
  auto s = scene_of(pendulum);
  s.recordings[0].t[0] = -1;
  CHECK_THROWS_MATCHES(write_mcap(file.path, s), bad_argument, says("s, got -1"));
  s.recordings.push_back(s.recordings[0]);
  CHECK_THROWS_MATCHES(write_mcap(file.path, s), bad_argument, says("one recording, and the scene has 2"));
  s = scene_of(pendulum);
  s.coordinates[0].name = "a b";
  CHECK_THROWS_MATCHES(write_mcap(file.path, s), bad_argument, says("the column name 'a b' has a blank"));
  CHECK(file.text() == "before");
}

}  // namespace mcap_test
