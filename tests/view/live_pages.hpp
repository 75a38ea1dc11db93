#pragma once

#include <kte/view/live_page.hpp>

#include <thread>

#include "catch.hpp"
#include "chain/models.hpp"
#include "view/http_client.hpp"

/// Live pages, and clients that have them open.
namespace kte::test {

inline constexpr auto pendulum = models::pendulum.gravity(along_y(-9.81));

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

}  // namespace kte::test
