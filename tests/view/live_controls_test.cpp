#include <atomic>

#include "view/live_pages.hpp"

namespace live_controls_test {

using namespace kte;
using namespace kte::test;

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

}  // namespace live_controls_test
