#pragma once

#include <httplib.h>
#include <thread>

#include "messages.hpp"
#include "request_heads.hpp"
#include "token.hpp"
#include "worker_threads.hpp"

namespace kte::live {

/// Serves a page and its session at 127.0.0.1.
///
///   GET  TOKEN/                          the page
///   GET  TOKEN/events                    server-sent events
///   GET  TOKEN/recording.csv             what was recorded
///   POST TOKEN/pause, run, step, reset, record, keep
///   POST TOKEN/slider?index=I&value=X, speed?value=X
///   POST TOKEN/pull?frame=I&x=X&y=Y&z=Z&to_x=X&to_y=Y&to_z=Z, release
class server : private httplib::Server {
 public:
  /// columns: names of t and of what is recorded. Throws `bad_argument` where it cannot listen.
  server(session& s, std::string page, std::vector<std::string> columns, int port);
  ~server() override;

  const std::string& url() const { return url_; }

 private:
  bool process_and_close_socket(socket_t socket) override;
  void process(int socket, std::string head);
  void answer(const httplib::Request& in, httplib::Response& out);
  /// Why a request is refused; empty if it is not.
  std::string refusal(const httplib::Request& in) const;
  void get(const std::string& what, httplib::Response& out);
  void post(const std::string& what, const httplib::Request& in, httplib::Response& out);
  /// Whether its numbers are there and within their limits.
  bool set_numbers(const std::string& what, const httplib::Request& in);
  void send_events(httplib::Response& out);
  void send_recording(httplib::Response& out);

  session& session_;
  const std::string page_, token_ = random_token();
  const std::vector<std::string> columns_;
  std::string url_;
  std::vector<std::string> hosts_;  ///< that are this server
  worker_threads workers_;
  request_heads heads_{[this](int socket, std::string head) {
    workers_.enqueue([this, socket, head = std::move(head)]() mutable { process(socket, std::move(head)); });
  }};
  std::thread thread_;
};

}  // namespace kte::live
