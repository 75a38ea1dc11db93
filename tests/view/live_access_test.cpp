#include "view/live_pages.hpp"

namespace live_access_test {

using namespace kte;
using namespace kte::test;

TEST_CASE("requests without the token are refused") {
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

}  // namespace live_access_test
