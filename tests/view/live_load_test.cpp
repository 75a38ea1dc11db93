#include <list>

#include "view/live_pages.hpp"

namespace live_load_test {

using namespace kte;
using namespace kte::test;

scene scene_of_tracks(int n) {
  scene s = scene_of(pendulum);
  s.tracks = n;
  s.frames.clear();
  for (int k = 0; k < n; ++k) s.frames.push_back({.name = std::to_string(k), .track = k});
  s.joints.clear(), s.links.clear(), s.bodies.clear(), s.forces.clear(), s.model.clear();
  auto& r = s.recordings.front();
  r.positions.assign(3 * static_cast<std::size_t>(n), 0), r.rotations.clear();
  for (int k = 0; k < n; ++k) r.rotations.insert(r.rotations.end(), {32767, 0, 0, 0});
  return s;
}
/// A page without a chain.
struct page_of_tracks : live_server {
  explicit page_of_tracks(int n) : live_server(scene_of_tracks(n), {}) {
    row.poses.resize(12 * static_cast<std::size_t>(n)), row.q = row.v = {0};
    for (std::size_t i = 0; i < row.poses.size(); i += 12) row.poses[i + 3] = row.poses[i + 7] = row.poses[i + 11] = 1;
  }
  void show(double t) { publish(t, row); }
  scene_row row;
};

TEST_CASE("of states that come faster than pages take them, the newest is sent") {
  page_of_tracks page(1);
  open_page client{http_address(page.url())};
  client.event("controls");
  constexpr int n = 20000;
  for (int i = 1; i <= n; ++i) page.show(i);
  int events = 0;
  for (std::string text; text.find("\"t\":20000,") == text.npos; ++events) {
    REQUIRE(events < n / 2);
    text = client.event("state");
    REQUIRE(!text.empty());
  }
}

TEST_CASE("a page that never reads keeps nobody waiting") {
  auto page = std::make_unique<page_of_tracks>(1000);
  const http_address at(page->url());
  open_page deaf(at, 4096), other(at);
  double t = 0;
  for (; t < 30; ++t) {  // more than buffers hold
    page->show(t);
    CHECK_THAT(other.event("state"), contains_text("{\"t\":" + std::to_string(static_cast<int>(t)) + ","));
  }
  for (; t < 5000; ++t) page->show(t);
  std::string text;
  for (int i = 0; i < 100 && text.find("{\"t\":4999,") == text.npos; ++i) text = other.event("state");
  CHECK_THAT(text, contains_text("{\"t\":4999,"));
  page.reset();  // ends, though one page still does not read
  CHECK(other.event("end") == "{}\n\n");
}

TEST_CASE("no more pages than eight") {
  live_page page(pendulum);
  const http_address at(page.url());
  std::list<open_page> all;
  for (int i = 0; i < 8; ++i) all.emplace_back(at).event("controls");
  CHECK(page.pages() == 8);
  CHECK(status_of(at.get("events")) == "503");
  CHECK(status_of(at.post("pause")) == "204");  // buttons still work
  all.pop_front();
  CHECK(comes_true([&] { return page.pages() == 7; }));
  CHECK_THAT(all.emplace_back(at).event("controls"), contains_text("\"paused\":true"));
}

TEST_CASE("connections that say nothing keep nobody out") {
  live_page page(pendulum);
  const http_address at(page.url());
  std::list<http_client> silent;
  for (int i = 0; i < 40; ++i) silent.emplace_back(at.port);
  CHECK(status_of(at.post("pause")) == "204");
}

}  // namespace live_load_test
