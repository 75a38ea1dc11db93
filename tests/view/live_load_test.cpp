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

double seconds_of(const auto& f) {
  const auto start = std::chrono::steady_clock::now();
  f();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

TEST_CASE("connections without a whole request keep nobody out") {
  live_page page(pendulum);
  const http_address at(page.url());
  std::list<http_client> half;
  for (int i = 0; i < 200; ++i) {
    half.emplace_back(at.port).send(i % 2 == 0 ? "" : "POST /no_token/pause HTTP/1.1\r\nHost: " + at.host + "\r\n");
    if (i % 50 == 49) CHECK(seconds_of([&] { CHECK(status_of(at.post("pause")) == "204"); }) < 1);
  }
  CHECK(seconds_of([&] { CHECK_THAT(at.get(""), contains_text("kte-live")); }) < 2);
}
TEST_CASE("a body that is announced and does not come keeps nobody out") {
  live_page page(pendulum);
  const http_address at(page.url());
  std::list<http_client> half;
  for (int i = 0; i < 100; ++i)
    half.emplace_back(at.port).send("POST /no_token/pause HTTP/1.1\r\nHost: " + at.host +
                                    "\r\nContent-Length: 100\r\n\r\n");
  CHECK(seconds_of([&] { CHECK(status_of(at.post("pause")) == "204"); }) < 1);
}
TEST_CASE("a request that comes byte by byte is cut off after a while, and one of two parts is not") {
  live_page page(pendulum);
  const http_address at(page.url());
  http_client slow(at.port), parted(at.port);
  const auto request = at.text("POST", "pause");
  REQUIRE(parted.send(std::string_view(request).substr(0, 10)));
  int sent = 0;
  CHECK(seconds_of([&] {
          while (sent < 100 && slow.send("G")) ++sent, std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }) < 5);
  CHECK(sent >= 10);
  CHECK(slow.read_to().empty());
  CHECK(parted.read_to().empty());
  http_client late(at.port);
  late.send(std::string_view(request).substr(0, 10)), std::this_thread::sleep_for(std::chrono::milliseconds(300));
  late.send(std::string_view(request).substr(10));
  CHECK(status_of(late.read_to()) == "204");
}

}  // namespace live_load_test
