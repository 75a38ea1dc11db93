#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <httplib.h>

namespace kte::live {

/// A connection for one request, which is short and comes soon, else it is cut off. A peer that takes nothing is given
/// up after a while, and at once when the server ends.
class connection : public httplib::Stream {
 public:
  connection(int socket, std::function<bool()> ended) : socket_(socket), ended_(std::move(ended)) {}
  connection(const connection&) = delete;
  ~connection() override;

  bool is_readable() const override;
  /// Whether the peer is there and takes more.
  bool is_writable() const override;
  ssize_t read(char* to, std::size_t size) override;
  ssize_t write(const char* bytes, std::size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override { ip = "127.0.0.1", port = 0; }
  void get_local_ip_and_port(std::string& ip, int& port) const override { ip = "127.0.0.1", port = 0; }
  socket_t socket() const override { return socket_; }

  static constexpr std::size_t longest_request = 1 << 14;  ///< bytes, with its headers

 private:
  using clock = std::chrono::steady_clock;
  /// Waits for an event of poll; false at the deadline or the end.
  bool wait(short event, clock::time_point deadline) const;

  int socket_;
  std::function<bool()> ended_;
  clock::time_point read_until_ = clock::now() + std::chrono::seconds(4);
  std::array<char, 2048> buffer_{};
  std::size_t begin_ = 0, end_ = 0, total_ = 0;
};

}  // namespace kte::live
