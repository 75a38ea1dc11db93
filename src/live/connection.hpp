#pragma once

#include <chrono>
#include <functional>
#include <httplib.h>
#include <string>

namespace kte::live {

/// A connection whose request has been read. A peer that takes nothing is given up after a while, and at once when the
/// server ends.
class connection : public httplib::Stream {
 public:
  connection(int socket, std::string request, std::function<bool()> ended)
      : socket_(socket), request_(std::move(request)), ended_(std::move(ended)) {}
  connection(const connection&) = delete;
  ~connection() override;

  bool is_readable() const override { return begin_ < request_.size(); }
  /// Whether the peer is there and takes more.
  bool is_writable() const override;
  ssize_t read(char* to, std::size_t size) override;
  ssize_t write(const char* bytes, std::size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override { ip = "127.0.0.1", port = 0; }
  void get_local_ip_and_port(std::string& ip, int& port) const override { ip = "127.0.0.1", port = 0; }
  socket_t socket() const override { return socket_; }

 private:
  using clock = std::chrono::steady_clock;
  /// Waits for an event of poll; false at the deadline or the end.
  bool wait(short event, clock::time_point deadline) const;

  int socket_;
  std::string request_;
  std::size_t begin_ = 0;  ///< of what was not given yet
  std::function<bool()> ended_;
};

}  // namespace kte::live
