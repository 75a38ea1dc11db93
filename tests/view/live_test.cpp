#include <atomic>

#include "view/live_pages.hpp"

namespace live_test {

using namespace kte;
using namespace kte::test;

TEST_CASE("a live page is the page with its scene, and asks for states") {
  live_page page(pendulum, {.title = "Swing <1>"});
  const http_address at(page.url());
  CHECK(page.url() == "http://127.0.0.1:" + std::to_string(at.port) + at.path);
  CHECK(at.path.size() == 34);
  const auto text = at.get("");
  CHECK(status_of(text) == "200");
  CHECK_THAT(text, contains_text(R"(<script type="application/json" id="kte-live">)"));
  CHECK_THAT(text, contains_text(R"("title":"Swing \u003c1>")"));
  CHECK_THAT(text, contains_text(R"("model":"{\"kte_model\":)"));
  CHECK_THAT(text, contains_text("Content-Security-Policy: default-src 'none'; "));
  CHECK_THAT(text, contains_text("connect-src 'self'; form-action 'none'; base-uri 'none'; frame-ancestors 'none'"));
  CHECK(text.find("Access-Control-") == text.npos);
  CHECK(live_page(pendulum).url().substr(22) != page.url().substr(22));
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
  // joint and tip at 7 numbers each, q, v, and the columns q, q/v, tip/velocity/x and y: in base64 of float32
  const auto state = client.event("state");
  CHECK_THAT(state, contains_text(R"({"t":1.5,"rows":0,"numbers":")"));
  const auto begin = state.find("numbers") + 10;
  const auto numbers = 7 * static_cast<std::size_t>(scene_of(pendulum).tracks) + 6;
  CHECK(state.find('"', begin) - begin == (4 * numbers + 2) / 3 * 4);
  CHECK_THAT(state, contains_text(R"(,"pull":null})"));
  CHECK_THROWS_MATCHES(live_page(pendulum, {.columns = {"tup/velocity"}}), unknown_name, says("tup"));
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

TEST_CASE("options of live pages that is invalid") {
  live_page page(pendulum);
  const int port = http_address(page.url()).port;
  CHECK_THROWS_MATCHES(live_page(pendulum, {.port = port}), bad_argument,
                       says("cannot listen at port " + std::to_string(port)));
  CHECK_THROWS_AS(live_page(pendulum, {.port = -1}), bad_argument);
  CHECK_THROWS_AS(live_page(pendulum, {.port = 65536}), bad_argument);
  CHECK_THROWS_AS(live_page(pendulum, {.speed = 0}), bad_argument);
}

TEST_CASE("states of another chain are refused") {
  runtime_chain a, b;
  a << revolute_joint_2D("q", "base", "joint");
  b << revolute_joint_2D("q", "base", "joint");
  live_page page(a);
  auto s = a.make_state();
  page.show(0, s);
  CHECK_THROWS_MATCHES(page.show(0, b.make_state()), bad_argument, says("another chain"));
}

}  // namespace live_test
