#include "request_heads.hpp"

#include <kte/errors.hpp>

#include <algorithm>
#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>
#include <vector>

namespace kte::live {

request_heads::request_heads(std::function<void(int, std::string)> take) : take_(std::move(take)) {
  if (::pipe(wake_) != 0) detail::raise<bad_argument>("kte: a live page cannot open a pipe: too many files are open");
  for (const int end : wake_) ::fcntl(end, F_SETFD, FD_CLOEXEC), ::fcntl(end, F_SETFL, O_NONBLOCK);
  thread_ = std::thread([this] { work(); });
}

request_heads::~request_heads() {
  {
    const std::lock_guard l(mutex_);
    ended_ = true;
  }
  [[maybe_unused]] const auto told = ::write(wake_[1], "", 1);
  thread_.join();
  waiting_.splice(waiting_.end(), arrived_);
  while (!waiting_.empty()) close(waiting_.begin());
  for (const int end : wake_) ::close(end);
}

void request_heads::add(int socket) {
  {
    const std::lock_guard l(mutex_);
    arrived_.push_back({socket, clock::now() + patience});
  }
  [[maybe_unused]] const auto told = ::write(wake_[1], "", 1);
}

void request_heads::work() {
  while (take_arrivals()) wait_for_news();
}

bool request_heads::take_arrivals() {
  const std::lock_guard l(mutex_);
  waiting_.splice(waiting_.end(), arrived_);
  return !ended_;
}

void request_heads::wait_for_news() {
  std::vector<pollfd> polled{{wake_[0], POLLIN, 0}};
  for (const auto& c : waiting_) polled.push_back({c.socket, POLLIN, 0});
  int milliseconds = -1;
  if (!waiting_.empty()) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(waiting_.front().deadline - clock::now()).count();
    milliseconds = static_cast<int>(std::max<decltype(left)>(left, 0));
  }
  if (::poll(polled.data(), static_cast<nfds_t>(polled.size()), milliseconds) > 0) {
    char bytes[256];
    if (polled[0].revents != 0)
      while (::read(wake_[0], bytes, sizeof bytes) > 0) {
      }
    std::size_t i = 1;
    for (auto at = waiting_.begin(); at != waiting_.end();) {
      const auto next = std::next(at);
      if (polled[i++].revents != 0) read(at);
      at = next;
    }
  }
  while (!waiting_.empty() && (waiting_.size() > most || clock::now() >= waiting_.front().deadline))
    close(waiting_.begin());
}

void request_heads::read(places::iterator at) {
  char bytes[4096];
  const auto n = ::recv(at->socket, bytes, sizeof bytes, MSG_DONTWAIT);
  if (n < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)) return;
  if (n <= 0) return close(at);
  at->text.append(bytes, static_cast<std::size_t>(n));
  if (at->text.find("\r\n\r\n") != at->text.npos) {
    take_(at->socket, std::move(at->text));
    waiting_.erase(at);
  } else if (at->text.size() > longest) {
    close(at);
  }
}

void request_heads::close(places::iterator at) {
  ::shutdown(at->socket, SHUT_RDWR);
  ::close(at->socket);
  waiting_.erase(at);
}

}  // namespace kte::live
