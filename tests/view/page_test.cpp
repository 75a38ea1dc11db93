#include <kte/view.hpp>

#include "../src/view/page_resource.hpp"
#include "catch.hpp"
#include "chain/models.hpp"
#include "io/scratch.hpp"

namespace page_test {

using namespace kte;
using kte::test::contains_text, kte::test::says, kte::test::scratch, kte::test::scratch_folder;

constexpr auto pendulum = models::pendulum.gravity(along_y(-9.81));

std::string page_around(const std::string& scene) {
  std::string page(view::page_resource());
  const std::string place = "<script type=\"application/json\" id=\"kte-scene\">";
  const auto at = page.find(place + "null</script>");
  REQUIRE(at != page.npos);
  return page.replace(at + place.size(), 4, scene);
}
std::string count(const std::string& text, const std::string& part) {
  int n = 0;
  for (auto at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++n;
  return std::to_string(n);
}

TEST_CASE("a page is the resource with the scene in its place") {
  const scratch file(".html");
  write_page(file.path, pendulum, {.title = "A pendulum"});
  auto s = scene_of(pendulum);
  s.title = "A pendulum";
  CHECK(file.text() == page_around(to_json(s)));
}

TEST_CASE("the title of a page is that of the options, of the scene, or of the file") {
  const scratch_folder folder;
  const auto path = folder.path / "our swing.html";
  const auto text = [&] {
    std::ifstream in(path);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  auto s = scene_of(pendulum);
  write_page(path, s);
  CHECK_THAT(text(), contains_text(R"("title":"our swing",)"));
  s.title = "Swing";
  write_page(path, s);
  CHECK_THAT(text(), contains_text(R"("title":"Swing",)"));
  write_page(path, s, {.title = "Titled"});
  CHECK_THAT(text(), contains_text(R"("title":"Titled",)"));
  CHECK(folder.entries() == 1);
}

TEST_CASE("pages of recordings, of tables, and of several over each other") {
  const scratch file(".html");
  scene_recording fast(pendulum, {.name = "fast"}), slow(pendulum, {.name = "slow"});
  auto s = make_state(pendulum);
  fast.row(0, s), slow.row(0, s), slow.row(1, s);
  write_page(file.path, fast);
  CHECK_THAT(file.text(), contains_text(R"("name":"fast","count":1,)"));
  write_page(file.path, pendulum, slow);
  CHECK_THAT(file.text(), contains_text(R"("name":"slow","count":2,)"));
  write_page(file.path, {fast, slow}, {.title = "Both"});
  CHECK_THAT(file.text(), contains_text(R"("name":"fast","count":1,)") && contains_text(R"("name":"slow","count":2,)"));
  const table numbers{{"t", "q"}, {{0, 1, 2}, {0, 1, 2}}};
  write_page(file.path, pendulum, numbers);
  CHECK_THAT(file.text(), contains_text(R"("count":3,)"));
  write_page(file.path, pendulum, {{"model", numbers}, {"measured", numbers}}, {.title = "Compared"});
  CHECK_THAT(file.text(),
             contains_text(R"("name":"model","count":3,)") && contains_text(R"("name":"measured","count":3,)"));
  runtime_chain other;
  other << revolute_joint_2D("q", "base", "arm");
  const scene_recording of_other(other);
  CHECK_THROWS_MATCHES(write_page(file.path, {fast, of_other}), bad_argument,
                       says("recording 2 has other frames or coordinates than the first"));
}

TEST_CASE("hostile names stay in their texts") {
  runtime_chain c;
  const std::string odd[]{"</script><b>", "'\"\\", "\xE2\x80\xA8", "\x01\x7F", "\xFF\xC0\x80", std::string(10000, 'x')};
  std::string base = "base";
  for (const auto& name : odd) {
    c << rigid_link_2D(base, name, along_x(0.1));
    base = name;
  }
  const scratch file(".html");
  write_page(file.path, c);
  const auto text = file.text();
  CHECK(count(text, "</script>") == count(std::string(view::page_resource()), "</script>"));
  CHECK_THAT(text, contains_text(R"("name":"\u003c/script>\u003cb>")"));
  CHECK_THAT(text, contains_text(R"("name":"'\"\\")"));
  CHECK_THAT(text, contains_text(R"("name":"\u2028")"));
  CHECK_THAT(text, contains_text(R"("name":"\u0001\u007f")"));
  CHECK_THAT(text, contains_text("\"name\":\"\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\""));
}

TEST_CASE("a page that cannot be written leaves what was there") {
  const scratch file(".html", "before");
  auto s = scene_of(pendulum);
  s.frames[2].parent = 2;
  CHECK_THROWS_MATCHES(write_page(file.path, s), bad_argument, says("frame 'tip': its parent is 2, and there are 2"));
  CHECK(file.text() == "before");
  CHECK_THROWS_MATCHES(write_page("/no/such/folder/a.html", pendulum), bad_file, says("'/no/such/folder/a.html'"));
}

TEST_CASE("long recordings are thinned out, and keep their last row") {
  const scratch file(".html");
  scene_recording rec(pendulum, {.columns = {"q"}});
  auto s = make_state(pendulum);
  for (int i = 0; i <= 10000; ++i) rec.row(0.001 * i, s);
  write_page(file.path, rec);
  CHECK_THAT(file.text(), contains_text(R"("count":10001,)"));
  write_page(file.path, rec, {.recording_bytes = 100000});
  CHECK(std::filesystem::file_size(file.path) < 110000 + view::page_resource().size());
  CHECK_THAT(file.text(), contains_text("of the 10001 rows of the recording one in 9 is in the page"));
  CHECK_THAT(file.text(), contains_text(R"("count":1113,)"));
}

TEST_CASE("scenes whose parts do not fit are refused by name") {
  const auto good = scene_of(pendulum);
  const auto refused = [&good](const std::string& why, const auto& change) {
    auto s = good;
    change(s);
    INFO(why);
    CHECK_THROWS_MATCHES(to_json(s), bad_argument, says(why));
  };
  refused("its dimension is 4", [](scene& s) { s.dimension = 4; });
  refused("frame 'joint': its track is 7, and there are 2", [](scene& s) { s.frames[1].track = 7; });
  refused("joint 'q': its frame is -1", [](scene& s) { s.joints[0].after = -1; });
  refused("joint 'q': its coordinate is 3", [](scene& s) { s.joints[0].coordinates = {3}; });
  refused("a rigid_link_2D: its frame is 9", [](scene& s) { s.links[0].to = 9; });
  refused("body 'tip': its frame is 5", [](scene& s) { s.bodies[0].frame = 5; });
  refused("a shape: its mesh is 0, and there are 0",
          [](scene& s) { s.shapes.emplace_back().frame = 0, s.shapes[0].mesh = 0; });
  refused("mesh 'm' has no vertex 1", [](scene& s) { s.meshes.push_back({"m", {0, 0, 0}, {0, 0, 1}}); });
  refused("it has no recording", [](scene& s) { s.recordings.clear(); });
  refused("recording '' has no rows", [](scene& s) { s.recordings[0] = {}; });
  refused("has not a pose for each row and track", [](scene& s) { s.recordings[0].positions.pop_back(); });
  refused("has not all coordinates", [](scene& s) { s.recordings[0].q.push_back(0); });
  refused("has not all velocities", [](scene& s) { s.recordings[0].v.push_back(0); });
  refused("has not all signals", [](scene& s) {
    s.recordings[0] = scene_of(pendulum, table{{"t", "q"}, {{0, 1}, {0, 0}}}).recordings[0];
    s.recordings[0].signals = {1};
  });
  refused("what is pulled is 7", [](scene& s) { s.pulls = {7}; });
  refused("column 'c' has not a number for each row", [](scene& s) {
    s.recordings[0].columns.push_back({"c", "", {}});
  });
}

}  // namespace page_test
