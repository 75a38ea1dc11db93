#include <kte/view/live_page.hpp>

#include <atomic>
#include <list>
#include <thread>

#include "catch.hpp"
#include "chain/models.hpp"
#include "view/http_client.hpp"

using namespace kte;
using kte::test::contains_text, kte::test::http_address, kte::test::http_client, kte::test::says, kte::test::status_of;

namespace {
constexpr auto pendulum = models::pendulum.gravity(along_y(-9.81));

/// Waits for what other threads do, but not for ever.
template <class Condition>
bool comes_true(const Condition& c) {
  for (int i = 0; i < 10000; ++i) {
    if (c()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

/// A page that is open.
struct open_page : http_client {
  explicit open_page(const http_address& at, int receive_buffer = 0)
      : http_client(at.port, "127.0.0.1", receive_buffer) {
    send(at.text("GET", "events"));
  }
  /// The next event of a kind.
  std::string event(const std::string& kind) {
    read_to("event: " + kind + "\ndata: ");
    return read_to("\n\n");
  }
};

/// A program that counts its steps.
struct stepping_program {
  explicit stepping_program(live_server& p) : page(p), thread([this] { run(); }) {}
  ~stepping_program() {
    page.stop();
    thread.join();
  }
  void run() {
    for (double t = 0; page.wait(t); t += 1e-3) {
      if (page.reset()) t = 0, ++resets;
      ++steps;
    }
  }
  live_server& page;
  std::atomic<int> steps{0}, resets{0};
  std::thread thread;
};

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
  explicit page_of_tracks(int n) : live_server(scene_of_tracks(n), {}), poses(12 * static_cast<std::size_t>(n)) {
    for (std::size_t i = 0; i < poses.size(); i += 12) poses[i + 3] = poses[i + 7] = poses[i + 11] = 1;
  }
  void show(double t) { publish(t, poses, std::array{0.0}, {}); }
  std::vector<double> poses;
};
}  // namespace

TEST_CASE("a live page is the page with its scene, and asks for states") {
  live_page page(pendulum, {.title = "Swing <1>"});
  const http_address at(page.url());
  CHECK(page.url() == "http://127.0.0.1:" + std::to_string(at.port) + at.path);
  CHECK(at.path.size() == 34);
  const auto text = at.get("");
  CHECK(status_of(text) == "200");
  CHECK_THAT(text, contains_text(R"(<script type="application/json" id="kte-live">)"));
  CHECK_THAT(text, contains_text(R"("title":"Swing \u003c1>")"));
  CHECK_THAT(text, contains_text(R"("model":null)"));
  CHECK_THAT(text, contains_text("Content-Security-Policy: default-src 'none'; "));
  CHECK_THAT(text, contains_text("connect-src 'self'; form-action 'none'; base-uri 'none'; frame-ancestors 'none'"));
  CHECK(text.find("Access-Control-") == text.npos);
  CHECK(live_page(pendulum).url().substr(22) != page.url().substr(22));
}

TEST_CASE("who does not know the token is refused") {
  live_page page(pendulum);
  const http_address at(page.url());
  auto wrong = at;
  for (const auto& path : {std::string("/"), std::string("/events"), at.path.substr(0, 33), at.path.substr(0, 32) + "/",
                           at.path.substr(0, 33) + "0/", '/' + std::string(32, '0') + '/', '/' + at.path}) {
    INFO(path);
    wrong.path = path;
    CHECK(status_of(wrong.get("")) == "403");
    CHECK(status_of(wrong.post("pause")) == "403");
  }
  for (std::size_t i = 1; i < 33; ++i) {
    wrong.path = at.path;
    wrong.path[i] = wrong.path[i] == '0' ? '1' : '0';
    CHECK(status_of(wrong.get("")) == "403");
  }
  CHECK(!page.paused());
  CHECK(status_of(at.get("")) == "200");
}

TEST_CASE("other hosts and pages of others are refused") {
  live_page page(pendulum);
  const http_address at(page.url());
  const auto port = std::to_string(at.port);
  auto other = at;
  for (const std::string& host :
       {std::string("evil.example:" + port), std::string("127.0.0.1"), "127.0.0.1:" + std::to_string(at.port + 1),
        "127.0.0.2:" + port, "localhost.evil.example:" + port, std::string()}) {
    INFO(host);
    other.host = host;
    CHECK(status_of(other.get("")) == "403");
    CHECK(status_of(other.post("pause")) == "403");
  }
  CHECK(status_of(at.ask("POST " + at.path + "pause HTTP/1.1\r\n\r\n")) == "403");
  CHECK(status_of(at.ask(at.text("POST", "pause", "Host: evil.example\r\n"))) == "403");
  for (const std::string& origin :
       {std::string("http://evil.example"), std::string("null"), "https://127.0.0.1:" + port,
        std::string("http://127.0.0.1"), "http://127.0.0.1:" + port + ".evil.example"}) {
    INFO(origin);
    CHECK(status_of(at.ask(at.text("POST", "pause", "Origin: " + origin + "\r\n"))) == "403");
    CHECK(status_of(at.ask(at.text("GET", "", "Origin: " + origin + "\r\n"))) == "403");
  }
  CHECK(!page.paused());
  CHECK(status_of(at.ask(at.text("POST", "pause", "Origin: http://127.0.0.1:" + port + "\r\n"))) == "204");
  CHECK(page.paused());
  other.host = "localhost:" + port;
  CHECK(status_of(other.post("run")) == "204");
  CHECK(!page.paused());
}

TEST_CASE("it listens at 127.0.0.1 alone") {
  live_page page(pendulum);
  const http_address at(page.url());
  CHECK(http_client(at.port).connected());
  CHECK(!http_client(at.port, "127.0.0.2").connected());
}

TEST_CASE("GET changes nothing, and other methods are refused") {
  live_page page(pendulum);
  page.slider("gain", 0, 1, 0.5);
  const http_address at(page.url());
  for (const char* const what : {"pause", "step", "reset", "record", "slider?index=0&value=1", "speed?value=2"}) {
    INFO(what);
    CHECK(status_of(at.get(what)) == "404");
    for (const char* const method : {"HEAD", "PUT", "DELETE", "OPTIONS", "PATCH"})
      CHECK(status_of(at.ask(at.text(method, what))) == "405");
  }
  CHECK(!page.paused());
  CHECK(!page.reset());
  CHECK(page.value("gain") == 0.5);
  CHECK(page.speed() == 1);
  CHECK(status_of(at.post("nothing")) == "404");
}

TEST_CASE("long requests are cut off") {
  live_page page(pendulum);
  const http_address at(page.url());
  const std::string a_lot(1 << 20, 'a');
  CHECK(status_of(at.get(a_lot.substr(0, 10000))) == "414");
  std::string headers;
  for (int i = 0; i < 100000; ++i) headers += "A: b\r\n";
  CHECK(status_of(at.ask(at.text("GET", "", headers))) != "200");
  CHECK(status_of(at.ask(at.text("GET", "", "A: " + a_lot + "\r\n"))) != "200");
  at.ask(at.text("POST", "pause", "Content-Length: 1048576\r\n") + a_lot);  // the body is not read
  CHECK(status_of(at.get("")) == "200");
}

TEST_CASE("states come as events") {
  live_page page(pendulum, {.columns = {"tip/velocity"}});
  auto s = make_state(pendulum);
  const http_address at(page.url());
  open_page client(at);
  CHECK(client.event("controls") ==
        R"({"paused":false,"recording":false,"full":false,"speed":1,"message":"","sliders":[]})"
        "\n\n");
  pendulum.doMotion(s);
  page.show(1.5, s);
  // joint and tip at 7 numbers each, q, and the columns q, q/v, tip/velocity/x and y: in base64 of float32
  const auto state = client.event("state");
  CHECK_THAT(state, contains_text(R"({"t":1.5,"rows":0,"numbers":")"));
  const auto begin = state.find("numbers") + 10;
  const auto numbers = 7 * static_cast<std::size_t>(scene_of(pendulum).tracks) + 5;
  CHECK(state.find('"', begin) - begin == (4 * numbers + 2) / 3 * 4);
  CHECK_THROWS_MATCHES(live_page(pendulum, {.columns = {"tup/velocity"}}), unknown_name, says("tup"));
}

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

TEST_CASE("sliders") {
  live_page page(pendulum);
  const http_address at(page.url());
  open_page client(at);
  client.event("controls");
  page.slider("gain", -1, 2, 0.5, "N m");
  CHECK_THAT(client.event("controls"),
             contains_text(R"({"name":"gain","unit":"N m","lower":-1,"upper":2,"value":0.5})"));
  CHECK(page.value("gain") == 0.5);
  CHECK(status_of(at.post("slider?index=0&value=-0.25")) == "204");
  CHECK(page.value("gain") == -0.25);
  CHECK_THAT(client.event("controls"), contains_text("\"value\":-0.25"));
  for (const char* const bad :
       {"slider?index=0&value=2.1", "slider?index=0&value=nan", "slider?index=0&value=1x",
        "slider?index=0&value=", "slider?index=0", "slider?value=1", "slider?index=1&value=1",
        "slider?index=-1&value=1", "slider?index=0&value=1&value=2", "speed?value=0", "speed?value=inf"}) {
    INFO(bad);
    CHECK(status_of(at.post(bad)) == "400");
  }
  CHECK(page.value("gain") == -0.25);
  CHECK_THROWS_MATCHES(page.value("gein"), unknown_name, says("kte: the page has no slider 'gein'"));
  CHECK_THROWS_MATCHES(page.slider("gain", 0, 1, 0), bad_argument, says("a slider 'gain' already"));
  CHECK_THROWS_AS(page.slider("a", 1, 1, 1), bad_argument);
  CHECK_THROWS_AS(page.slider("a", 0, 1, 2), bad_argument);
  CHECK_THROWS_AS(page.slider("a", 0, INFINITY, 2), bad_argument);
  CHECK_THROWS_AS(page.slider("a", 0, 1, NAN), bad_argument);
}

TEST_CASE("names in events are text") {
  live_page page(pendulum);
  open_page client{http_address(page.url())};
  client.event("controls");
  page.slider("</script>\n\nevent: end\ndata: \"\xff\xE2\x80\xA8", 0, 1, 0);
  CHECK_THAT(client.event("controls"), contains_text(R"("name":"\u003c/script>\u000a\u000aevent: end\u000adata: \")"
                                                     "\xEF\xBF\xBD"
                                                     R"(\u2028")"));
}

TEST_CASE("sentences for the page") {
  live_page page(pendulum);
  const http_address at(page.url());
  open_page client(at);
  client.event("controls");
  page.say("the \"motor\" is hot\n");
  CHECK_THAT(client.event("controls"), contains_text(R"("message":"the \"motor\" is hot\u000a")"));
  at.post("reset");
  CHECK_THAT(client.event("controls"), contains_text(R"("message":"")"));
}

TEST_CASE("pause, step, run, reset") {
  live_page page(pendulum, {.paused = true});
  const http_address at(page.url());
  stepping_program program(page);
  for (int i = 1; i <= 3; ++i) {
    CHECK(status_of(at.post("step")) == "204");
    REQUIRE(comes_true([&] { return program.steps == i; }));
  }
  at.post("reset");
  REQUIRE(comes_true([&] { return program.resets == 1; }));
  CHECK(page.paused());
  at.post("run");
  REQUIRE(comes_true([&] { return program.steps > 20; }));
  CHECK(!page.paused());
  at.post("step");  // of a program that runs: pauses
  CHECK(page.paused());
}

TEST_CASE("the clock of the page: speed, late programs, times before") {
  live_page page(pendulum, {.speed = 1000});
  CHECK(page.wait(0));
  CHECK(page.wait(1));
  CHECK(page.wait(1e-3));
  CHECK(page.wait(0.5));
  CHECK(status_of(http_address(page.url()).post("speed?value=0.001")) == "204");
  CHECK(page.speed() == 1e-3);
  std::thread other([&] { page.stop(); });
  CHECK(!page.wait(1000));
  other.join();
  CHECK(!page.wait(0));
  CHECK(!page.wait_for_page());
  CHECK_THROWS_AS(page.wait(NAN), bad_argument);
}

TEST_CASE("what was shown is recorded") {
  live_page page(pendulum, {.columns = {"tip/velocity"}, .recording_bytes = 3 * 5 * sizeof(double)});
  auto s = make_state(pendulum);
  const http_address at(page.url());
  page.show(0, s);
  at.post("record");
  page.show(1, s), page.show(2, s);
  at.post("keep");
  page.show(3, s);
  const auto csv = at.get("recording.csv");
  CHECK_THAT(csv, contains_text("Content-Disposition: attachment"));
  CHECK_THAT(csv, contains_text("tip/velocity/x,tip/velocity/y\n1.0,"));
  CHECK_THAT(csv, contains_text("\n2.0,"));
  CHECK(csv.find("\n3.0,") == csv.npos);
  open_page client(at);
  CHECK_THAT(client.event("controls"), contains_text("\"full\":false"));
  at.post("record");
  for (double t = 4; t < 9; ++t) page.show(t, s);
  CHECK_THAT(open_page(at).event("controls"), contains_text(R"("recording":false,"full":true)"));
  const auto full = at.get("recording.csv");
  CHECK_THAT(full, contains_text("\n6.0,"));
  CHECK(full.find("\n7.0,") == full.npos);
  CHECK(full.find("\n1.0,") == full.npos);
}

TEST_CASE("programs wait for a page, and pages hear of the end") {
  auto page = std::make_unique<live_page<std::remove_const_t<decltype(pendulum)>>>(pendulum);
  const http_address at(page->url());
  std::atomic<bool> came = false;
  std::thread program([&] { came = page->wait_for_page(); });
  open_page client(at);
  program.join();
  CHECK(came);
  client.event("controls");
  page.reset();
  CHECK(client.event("end") == "{}\n\n");
  CHECK(!http_client(at.port).connected());
}

TEST_CASE("options of live pages that make no sense") {
  live_page page(pendulum);
  const int port = http_address(page.url()).port;
  CHECK_THROWS_MATCHES(live_page(pendulum, {.port = port}), bad_argument,
                       says("cannot listen at port " + std::to_string(port)));
  CHECK_THROWS_AS(live_page(pendulum, {.port = -1}), bad_argument);
  CHECK_THROWS_AS(live_page(pendulum, {.port = 65536}), bad_argument);
  CHECK_THROWS_AS(live_page(pendulum, {.speed = 0}), bad_argument);
}

TEST_CASE("states of another chain are refused") {
  kte_map_chain a, b;
  a << revolute_joint_2D("q", "base", "joint");
  b << revolute_joint_2D("q", "base", "joint");
  live_page page(a);
  auto s = a.make_state();
  page.show(0, s);
  CHECK_THROWS_MATCHES(page.show(0, b.make_state()), bad_argument, says("another chain"));
}
