#pragma once

#include <arpa/inet.h>
#include <chrono>
#include <netinet/in.h>
#include <string>
#include <sys/socket.h>
#include <unistd.h>

#include "catch.hpp"

/// A client that sends what it is told, byte for byte.
namespace kte::test {

class http_client {
 public:
  /// receive_buffer, bytes; 0: as usual. Reads give up after 10 s.
  explicit http_client(int port, const char* address = "127.0.0.1", int receive_buffer = 0)
      : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    REQUIRE(socket_ >= 0);
    const timeval patience{10, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    if (receive_buffer > 0) ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    sockaddr_in to{};
    to.sin_family = AF_INET, to.sin_port = htons(static_cast<std::uint16_t>(port));
    ::inet_pton(AF_INET, address, &to.sin_addr);
    connected_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0;
  }
  http_client(const http_client&) = delete;
  ~http_client() { ::close(socket_); }

  bool connected() const { return connected_; }
  /// False where the server takes no more.
  bool send(std::string_view text) {
    while (!text.empty()) {
      const auto n = ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL);
      if (n <= 0) return false;
      text.remove_prefix(static_cast<std::size_t>(n));
    }
    return true;
  }
  /// The received text up to and including `end`; without `end`, everything until the end or for 20 s.
  std::string read_to(std::string_view end = {}) {
    const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    for (;;) {
      const auto at = end.empty() ? received_.npos : received_.find(end);
      if (at != received_.npos) {
        const auto text = received_.substr(0, at + end.size());
        received_.erase(0, text.size());
        return text;
      }
      char part[1 << 14];
      const auto n = ::recv(socket_, part, sizeof part, 0);
      if (n <= 0 || std::chrono::steady_clock::now() > patience) return std::exchange(received_, {});
      received_.append(part, static_cast<std::size_t>(n));
    }
  }

 private:
  int socket_;
  bool connected_ = false;
  std::string received_;
};

/// An address "http://127.0.0.1:PORT/TOKEN/" in parts.
struct http_address {
  int port;
  std::string host, path;

  explicit http_address(const std::string& url) {
    const auto colon = url.rfind(':'), slash = url.find('/', colon);
    host = url.substr(7, slash - 7), path = url.substr(slash), port = std::stoi(url.substr(colon + 1));
  }
  std::string text(const std::string& method, const std::string& what, const std::string& headers = {}) const {
    return method + ' ' + path + what + " HTTP/1.1\r\nHost: " + host + "\r\n" + headers + "\r\n";
  }
  /// The answer to a request.
  std::string ask(const std::string& request) const {
    http_client c(port);
    REQUIRE(c.connected());
    c.send(request);
    return c.read_to();
  }
  std::string get(const std::string& what) const { return ask(text("GET", what)); }
  std::string post(const std::string& what) const { return ask(text("POST", what)); }
};

/// "HTTP/1.1 403 ..." as "403".
inline std::string status_of(const std::string& answer) {
  return answer.substr(0, 9) == "HTTP/1.1 " ? answer.substr(9, 3) : answer;
}

}  // namespace kte::test
