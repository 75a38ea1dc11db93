#include "connection.hpp"

#include <cerrno>
#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace kte::live {

namespace {
constexpr std::chrono::milliseconds look_again{50};
constexpr std::chrono::seconds patience{4};  // with a peer that takes nothing
}  // namespace

connection::~connection() {
  ::shutdown(socket_, SHUT_RDWR);
  ::close(socket_);
}

bool connection::wait(short event, clock::time_point deadline) const {
  for (;;) {
    pollfd p{socket_, event, 0};
    const int n = ::poll(&p, 1, static_cast<int>(look_again.count()));
    if (n > 0) return (p.revents & event) != 0;
    if (ended_() || (n < 0 && errno != EINTR) || clock::now() > deadline) return false;
  }
}

bool connection::is_writable() const {
  char byte;
  const bool closed = ::recv(socket_, &byte, 1, MSG_PEEK | MSG_DONTWAIT) == 0;
  return !closed && wait(POLLOUT, clock::now() + patience);
}

ssize_t connection::read(char* to, std::size_t size) {
  const auto n = std::min(size, request_.size() - begin_);
  std::copy_n(request_.data() + begin_, n, to);
  begin_ += n;
  return static_cast<ssize_t>(n);
}

ssize_t connection::write(const char* bytes, std::size_t size) {
  for (;;) {
    if (!wait(POLLOUT, clock::now() + patience)) return -1;
    const auto n = ::send(socket_, bytes, size, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (n >= 0 || (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR)) return n;
  }
}

}  // namespace kte::live
