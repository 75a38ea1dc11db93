#pragma once

#include <chrono>
#include <functional>
#include <list>
#include <mutex>
#include <string>
#include <thread>

namespace kte::live {

/// Reads the heads of requests, their request line and headers, of all new connections in one thread: connections that
/// say nothing, or not all, occupy no other. A head comes within `patience`. Of more connections than `most` the oldest
/// is closed.
class request_heads {
 public:
  /// take(socket, text) gets each connection whose head is complete, with all that was read of it, and owns the socket.
  explicit request_heads(std::function<void(int, std::string)> take);
  ~request_heads();
  request_heads(const request_heads&) = delete;

  /// Takes over a new connection; never waits.
  void add(int socket);

  static constexpr std::chrono::milliseconds patience{1500};
  static constexpr std::size_t most = 64;
  static constexpr std::size_t longest = 1 << 14;  ///< bytes; connections with longer heads are closed

 private:
  using clock = std::chrono::steady_clock;
  struct connection_to_read {
    int socket;
    clock::time_point deadline;
    std::string text{};
  };
  using places = std::list<connection_to_read>;

  void work();
  /// Takes over new connections; false at the end.
  bool take_arrivals();
  void wait_for_news();
  /// Reads what is there, and hands over or closes what is complete, ended or too long.
  void read(places::iterator at);
  void close(places::iterator at);

  std::function<void(int, std::string)> take_;
  int wake_[2];  ///< a pipe: bytes say that there is news
  std::mutex mutex_;
  places arrived_;
  bool ended_ = false;
  places waiting_;  ///< the oldest first; of the thread
  std::thread thread_;
};

}  // namespace kte::live
