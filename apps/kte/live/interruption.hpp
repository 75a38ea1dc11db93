#pragma once

#include <atomic>
#include <csignal>
#include <functional>
#include <pthread.h>
#include <thread>

namespace kte_tool {

/// Calls a function at SIGINT (Ctrl-C) and SIGTERM, in its own thread. To be made before other threads, which then do
/// not get these signals.
class interruption {
 public:
  interruption() {
    sigemptyset(&signals_), sigaddset(&signals_, SIGINT), sigaddset(&signals_, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &signals_, &before_);
  }
  interruption(const interruption&) = delete;
  ~interruption() {
    ended_ = true;
    if (thread_.joinable()) thread_.join();
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  void calls(std::function<void()> f) {
    thread_ = std::thread([this, f = std::move(f)] {
      const timespec a_while{0, 50'000'000};
      while (!ended_)
        if (sigtimedwait(&signals_, nullptr, &a_while) > 0) f();
    });
  }

 private:
  sigset_t signals_{}, before_{};
  std::atomic<bool> ended_ = false;
  std::thread thread_;
};

}  // namespace kte_tool
